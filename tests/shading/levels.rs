//! The level of each channel of every shader of plain colours, dithered or not, on every kind of target: of faces in view against the corners' levels,
//! weighted by areas in exact integers, and of faces that planes cut against `support::oracle::cut_faces`.

use crate::scene::{
    corners, draw, flat, gouraud, lit, random_colour, random_lights, random_triangle, shaded, with_triangle,
    Colour, Own, SIZE,
};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use pinhole::shading::{Barycentric, Varying};
use pinhole::{prelude::*, shading::SpanShader};
use std::sync::LazyLock;
use support::bridge::pair::{CameraBits, ONE};
use support::oracle::chain::{self, fx3};
use support::oracle::coverage::{centre, edge};
use support::oracle::cut_faces::{pieces, Corner};
use support::oracle::rng::Rng;
use support::oracle::shade::{bayer, Depths, Lit};
use support::oracle::target::Screen;

type V3 = [f64; 3];

/// How a shader rounds the exact level of a channel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rounding {
    /// To the nearest level.
    Level,
    /// Light is rounded to one of 256 entries, and each entry to its nearest level.
    Entry,
    /// To the level that the pattern of 8 × 8 thresholds selects.
    Pattern,
}

/// The error of a gradient over a triangle, in levels.
const GRADIENT: f64 = 1.0 / 512.0;
/// The rounding of a corner's colour, in levels.
pub(crate) const CORNER: f64 = 1.0 / 65_536.0;

/// The rank of a pixel in Bayer's pattern.
pub(crate) fn rank(at: Point) -> i128 {
    static PATTERN: LazyLock<Vec<Vec<i128>>> = LazyLock::new(|| bayer(8));
    PATTERN[at.y.rem_euclid(8) as usize][at.x.rem_euclid(8) as usize]
}

impl Rounding {
    /// How far a level is from the exact one, in shares of the bound: the documented rounding, and `slack` levels. A pattern has no
    /// distances: the level is right or wrong.
    pub(crate) fn share(self, level: i128, exact: f64, max: i128, slack: f64, at: Point) -> f64 {
        let level = level as f64;
        match self {
            Self::Level => (level - exact).abs() / (0.5 + slack),
            Self::Entry => (level - exact).abs() / (0.5 + (0.5 + slack) * max as f64 / 255.0),
            Self::Pattern => {
                let sum = exact + (2 * rank(at) + 1) as f64 / 128.0;
                let wanted = (sum - slack).floor()..=(sum + slack).floor();
                f64::from(u8::from(!wanted.contains(&level))) * 2.0
            }
        }
    }
}

/// Red, green and blue of 0 … 255.
fn channels(colour: Lit) -> V3 {
    colour.rgb.map(|c| f64::from(c) * f64::from(colour.level) / 256.0)
}

/// The levels of a target; greys by the luma of Rec. 601 with weights 77, 150 and 29 of 256.
pub(crate) fn levels(depths: Depths, channels: V3) -> Vec<f64> {
    let [r, g, b] = channels;
    match *depths.0 {
        [max] => vec![(77.0 * r + 150.0 * g + 29.0 * b) / 256.0 * max as f64 / 255.0],
        ref all => all.iter().zip(channels).map(|(&max, channel)| channel * max as f64 / 255.0).collect(),
    }
}

/// Lit colour and emission, at most full.
fn sum(colour: Lit, emission: [u8; 3]) -> V3 {
    let lit = channels(colour);
    [0, 1, 2].map(|i| (lit[i] + f64::from(emission[i])).min(255.0))
}

/// The pixels of a picture and their levels, and the levels of the target.
struct Levels {
    depths: Depths,
    pixels: Vec<(Point, Vec<i128>)>,
}

impl Levels {
    fn new<C: Colour>(picture: &Screen<C>) -> Self {
        Self {
            depths: C::DEPTHS,
            pixels: picture.drawn().map(|(at, colour)| (at, colour.levels())).collect(),
        }
    }
}

/// A triangle in view, and the largest share of the bound that each shader met.
struct Face<'a> {
    instance: &'a MeshInstance<'a, Scalar>,
    worst: &'a mut [f64; 9],
}

impl Face<'_> {
    /// Draws with a shader, and compares.
    fn draw<C: Colour, I: SpanShader<C, Ink = C>>(
        &mut self,
        (number, shader): (usize, I),
        exact: [V3; 3],
        rounding: Rounding,
        slack: f64,
    ) -> Screen<C> {
        let picture = draw::<C, _>(self.instance, shader);
        self.check(number, &Levels::new(&picture), exact, rounding, slack);
        picture
    }

    /// Compares each pixel with the levels of the gradients of the corners.
    fn check(&mut self, shader: usize, picture: &Levels, exact: [V3; 3], rounding: Rounding, slack: f64) {
        let t @ [a, b, c] = corners(self.instance);
        let whole = edge(a, b, c) as f64;
        for &(at, ref found) in &picture.pixels {
            let p = centre(at.x.into(), at.y.into());
            let weights = [edge(p, b, c), edge(a, p, c), edge(a, b, p)].map(|area| area as f64 / whole);
            let mixed = [0, 1, 2].map(|i| (0..3).map(|k| weights[k] * exact[k][i]).sum());
            let exact_levels = levels(picture.depths, mixed);
            for ((level, exact), &max) in found.iter().zip(exact_levels).zip(picture.depths.0) {
                let share = rounding.share(*level, exact, max, slack, at);
                assert!(share <= 1.0, "shader {shader}: {level} for {exact} at {at:?}: {t:?} {mixed:?}");
                self.worst[shader] = self.worst[shader].max(share);
            }
        }
    }
}

/// Random triangles in the colours of each shader: the level of every pixel, and equal pixels whatever the shader. Light and tables go
/// the way of colours to the levels of a target: `with_light` compares them, too.
fn faces<C: Colour>(cases: usize, with_light: Option<fn(&mut Face<'_>, &mut Rng) -> usize>) {
    let mut rng = Rng::new(0x60);
    let (mut worst, mut windings) = ([0.0f64; 9], [0, 0]);
    for _ in 0..cases {
        let t = random_triangle(&mut rng);
        windings[usize::from(edge(t[0], t[1], t[2]) > 0)] += 1;
        let (colours, emission) = ([(); 3].map(|()| random_colour(&mut rng)), random_colour(&mut rng).rgb);
        let [r, g, b] = emission;
        with_triangle(t, |instance| {
            let mut face = Face { instance, worst: &mut worst };
            let (smooth, even) = (colours.map(channels), [channels(colours[0]); 3]);
            let flat_picture = face.draw::<C, _>((3, flat(colours[0])), even, Rounding::Level, CORNER);
            let smooth_picture = face.draw::<C, _>((0, gouraud(colours)), smooth, Rounding::Level, GRADIENT);
            assert_eq!(flat_picture.counts, smooth_picture.counts);
            let (glowing, sum) = (flat(colours[0]).emitting(Rgb888::new(r, g, b)), sum(colours[0], emission));
            face.draw::<C, _>((4, glowing), [sum; 3], Rounding::Level, CORNER);
            face.draw::<C, _>((6, Dithered(gouraud(colours))), smooth, Rounding::Pattern, GRADIENT);
            face.draw::<C, _>((8, Dithered(flat(colours[0]))), even, Rounding::Pattern, CORNER);
            // Three equal corners give the colour of a flat face in every pixel, to the last bit.
            assert_eq!(draw::<C, _>(instance, gouraud([colours[0]; 3])), flat_picture);
            if let Some(check) = with_light {
                assert_eq!(check(&mut face, &mut rng), smooth_picture.drawn().count());
            }
        });
    }
    println!("{}: {worst:.5?} of the bound", core::any::type_name::<C>());
    assert!(windings.iter().all(|&n| n > cases / 3), "{windings:?}");
    // Most of each bound is met.
    let of_light = f64::from(u8::from(with_light.is_some()));
    for (share, least) in
        worst.into_iter().zip([0.499, 0.499 * of_light, 0.49 * of_light, 0.4, 0.4, 0.25 * of_light])
    {
        assert!(share >= least / (0.5 + GRADIENT), "{worst:?}");
    }
}

/// Corners that differ in their light: smooth, with emission, dithered, and by a table. Returns the number of pixels.
fn light<C: Colour>(face: &mut Face<'_>, rng: &mut Rng) -> usize {
    let (lights, emission) = (random_lights(rng), random_colour(rng).rgb);
    let (exact, [r, g, b]) = (lights.map(channels), emission);
    let picture = face.draw::<C, _>((1, lit(lights)), exact, Rounding::Level, GRADIENT);
    let (glowing, sums) =
        (lit(lights).emitting(Rgb888::new(r, g, b)), lights.map(|light| sum(light, emission)));
    face.draw::<C, _>((2, glowing), sums, Rounding::Level, GRADIENT);
    face.draw::<C, _>((5, shaded(lights)), exact, Rounding::Entry, GRADIENT);
    face.draw::<C, _>((7, Dithered(lit(lights))), exact, Rounding::Pattern, GRADIENT);
    picture.drawn().count()
}

#[test]
fn pixels_have_the_levels_of_the_gradients_of_their_corners() {
    faces::<Rgb565>(1000, Some(light::<Rgb565>));
    faces::<Own>(1000, Some(light::<Own>));
    faces::<Gray8>(700, Some(light::<Gray8>));
    faces::<Rgb888>(700, None);
    faces::<Gray4>(700, None);
    faces::<Gray2>(700, None);
    faces::<BinaryColor>(700, None);
}

/// With a field of view of 90 degrees.
fn camera(far: i32) -> CameraBits {
    CameraBits::perspective(1 << 30, SIZE, ONE, far)
}

/// The planes that a random face crosses.
#[derive(Clone, Copy, Debug)]
enum Planes {
    Near,
    Far,
    GuardBand,
}

impl Planes {
    fn camera(self) -> CameraBits {
        camera(if matches!(self, Self::Far) { 4 * ONE } else { 100 * ONE })
    }

    fn random_face(self, rng: &mut Rng) -> [[i32; 3]; 3] {
        let near = i64::from(ONE);
        let mut corner = |outside: bool| {
            let mut at = [rng.int(-5 << 16, 5 << 16), rng.int(-5 << 16, 5 << 16), -rng.int(near, 8 << 16)];
            match self {
                Self::Near if outside => at[2] = rng.int(1 - near, 4 << 16),
                Self::Near => {}
                Self::Far if outside => at[2] = -rng.int(4 << 16, 12 << 16),
                Self::Far => at[2] = -rng.int(near, 4 << 16),
                // 90 degrees on 48 pixels: 24 pixels for a slope of 1, so a slope of 342 leaves the guard band.
                Self::GuardBand if outside => {
                    at[2] = -rng.int(near, 2 << 16);
                    at[rng.below(2)] = rng.int(700 << 16, 3000 << 16) * [1, -1][rng.below(2)];
                }
                Self::GuardBand => {}
            }
            at.map(|c| c as i32)
        };
        let mut face = [corner(false), corner(true), corner(false)];
        // A third of the faces have one corner inside.
        let two = corner(true);
        if rng.one_in(3) {
            face[0] = two;
        }
        face.rotate_left(rng.below(3));
        face
    }

    /// The pixels of a face.
    fn draw<C: Colour, I: SpanShader<C, Ink = C>>(self, face: [[i32; 3]; 3], shader: I) -> Screen<C> {
        let vertices = face.map(|v| v.map(Scalar::from_bits));
        let mesh = Mesh::from_fixed(&vertices, &[[0, 1, 2]]).expect("a mesh");
        let camera = self.camera().library().with_far_clip(matches!(self, Self::Far));
        draw(&camera.place(&mesh, &Affine::identity()), shader)
    }

    /// Every pixel that is surely inside one triangle of the clipped polygon has the colour of the oracle, within the documented bound
    /// and the change that the snap of the corners explains. Returns the number of such pixels.
    fn check(self, face: [[i32; 3]; 3], colours: [Lit; 3], picture: &Levels, rounding: Rounding) -> usize {
        let exact = self.camera().exact();
        let corners: [Corner; 3] = [0, 1, 2].map(|i| {
            let clip = exact.clip(&chain::IDENTITY, fx3(face[i]));
            let all = clip.into_iter().chain(levels(picture.depths, channels(colours[i]))).chain([0.0; 2]);
            all.take(7).collect::<Vec<_>>().try_into().expect("seven")
        });
        let (pieces, whole) = pieces(&exact, &corners, matches!(self, Self::Far));
        assert!(!whole, "{self:?} do not cut {face:?}");
        let mut seen = 0;
        for piece in &pieces {
            for &(at, ref found) in &picture.pixels {
                let centre = (f64::from(at.x) + 0.5, f64::from(at.y) + 0.5);
                if piece.inside(centre) < 1.0 / 64.0 {
                    continue;
                }
                seen += 1;
                for (channel, (&level, &max)) in found.iter().zip(picture.depths.0).enumerate() {
                    let exact = piece.level(channel, centre);
                    // Cut corners are off by as much as gradients; a corner on the screen by 1/256 pixel.
                    let slack = 2.0 * GRADIENT + piece.change(channel, 1.0 / 256.0);
                    let slack = match rounding {
                        // The change is in levels, not in entries.
                        Rounding::Entry => slack * 255.0 / max as f64,
                        _ => slack,
                    };
                    let share = rounding.share(level, exact, max, slack, at);
                    assert!(
                        share <= 1.0,
                        "{self:?}: level {level} for {exact} ± {slack} at {at:?}: {face:?} {colours:?}"
                    );
                }
            }
        }
        seen
    }
}

fn cut_faces<C: Colour>(planes: Planes, cases: usize) {
    let (mut rng, mut seen) = (Rng::new(0x90), [0; 5]);
    for _ in 0..cases {
        let faces = [(); 5].map(|()| planes.random_face(&mut rng));
        let colours = [(); 2].map(|()| [(); 3].map(|()| random_colour(&mut rng)));
        let lights = [(); 3].map(|()| random_lights(&mut rng));
        let draw = [
            (Levels::new(&planes.draw::<C, _>(faces[0], gouraud(colours[0]))), colours[0], Rounding::Level),
            (Levels::new(&planes.draw::<C, _>(faces[1], lit(lights[0]))), lights[0], Rounding::Level),
            (Levels::new(&planes.draw::<C, _>(faces[2], shaded(lights[1]))), lights[1], Rounding::Entry),
            (
                Levels::new(&planes.draw::<C, _>(faces[3], Dithered(gouraud(colours[1])))),
                colours[1],
                Rounding::Pattern,
            ),
            (
                Levels::new(&planes.draw::<C, _>(faces[4], Dithered(lit(lights[2])))),
                lights[2],
                Rounding::Pattern,
            ),
        ];
        for (i, (picture, colours, rounding)) in draw.into_iter().enumerate() {
            seen[i] += planes.check(faces[i], colours, &picture, rounding);
        }
    }
    println!("{planes:?}: {seen:?} pixels");
    assert!(seen.iter().all(|&pixels| pixels > 100 * cases), "{planes:?}: {seen:?} pixels of {cases} faces");
}

/// A cut corner has the colour that its point of the face has in space, and over each triangle of the clipped polygon colours are
/// linear on the screen.
#[test]
fn cut_faces_have_the_colours_of_the_oracle() {
    for planes in [Planes::Near, Planes::Far, Planes::GuardBand] {
        cut_faces::<Rgb565>(planes, 300);
        cut_faces::<Own>(planes, 300);
    }
}

/// Barycentric weights after up to six cuts: the first two are off by half a unit for each cut, the third by one unit.
#[test]
fn barycentric_weights_follow_the_cuts_and_sum_to_one() {
    let mut rng = Rng::new(0x94);
    let mut largest = [0f64; 2];
    for _ in 0..50_000 {
        let whole = [0, 1, 2].map(|corner| [0, 1, 2].map(|i| f64::from(u8::from(i == corner))));
        let mut points: Vec<(Barycentric, V3)> = (0..3).map(|i| (Barycentric::of(i), whole[i])).collect();
        for cut in 1..=6 {
            let [(a, p), (b, q)] = [0; 2].map(|_| points[rng.below(points.len())]);
            let t = match rng.below(4) {
                0 => rng.int(0, 9),
                1 => (1 << 31) - rng.int(1, 9),
                _ => rng.int(0, (1 << 31) - 1),
            };
            let exact: V3 = core::array::from_fn(|i| p[i] + (q[i] - p[i]) * t as f64 / f64::from(1u32 << 31));
            let weights = a.towards(&b, t).weights();
            assert_eq!(weights.iter().sum::<i32>(), 1 << 30);
            assert!(weights.iter().all(|w| (-6..=(1 << 30) + 6).contains(w)), "{weights:?}");
            for (i, (weight, exact)) in weights.into_iter().zip(exact).enumerate() {
                let off = (f64::from(weight) - exact * f64::from(1 << 30)).abs() / f64::from(cut);
                largest[i / 2] = largest[i / 2].max(off);
            }
            points.push((a.towards(&b, t), exact));
        }
    }
    println!("off by {largest:?} for each cut");
    assert!(largest[0] <= 0.501 && largest[1] <= 1.001, "{largest:?}");
    assert!(largest[0] > 0.4 && largest[1] > 0.6, "{largest:?}");
}

/// Rounded as `embedded-graphics` rounds.
fn nearest<C: Color + From<Rgb888> + core::fmt::Debug>(colour: Rgb888) {
    let picture =
        with_triangle([(0, 0), (0, 9000), (9000, 0)], |face| draw::<C, _>(face, Flat::from(colour)));
    assert!(picture.drawn().count() > 500);
    assert!(picture.drawn().all(|(_, drawn)| drawn == C::from(colour)), "{colour:?}: {:?}", C::from(colour));
}

#[test]
fn flat_colours_are_the_nearest_of_every_colour_type() {
    let mut rng = Rng::new(0x62);
    for _ in 0..300 {
        let [r, g, b] = random_colour(&mut rng).rgb;
        let colour = Rgb888::new(r, g, b);
        nearest::<Rgb555>(colour);
        nearest::<Bgr555>(colour);
        nearest::<Rgb565>(colour);
        nearest::<Bgr565>(colour);
        nearest::<Rgb666>(colour);
        nearest::<Bgr666>(colour);
        nearest::<Rgb888>(colour);
        nearest::<Bgr888>(colour);
        nearest::<Gray8>(colour);
    }
}

/// Levels of light beyond 256 count as 256.
#[test]
fn a_light_level_of_256_is_full_light() {
    for level in [256, 257, u16::MAX] {
        let colour = Rgb888::new(9, 8, 7);
        assert_eq!(Gouraud::lit(colour, [level; 3]), Gouraud::lit(colour, [256; 3]));
        assert_ne!(Gouraud::lit(colour, [level; 3]), Gouraud::lit(colour, [level, 255, level]));
    }
}
