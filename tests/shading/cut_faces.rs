//! Colours of faces that the near plane, the far plane or the guard band cuts. A cut corner has the colour that its point of
//! the face has in space, and over each triangle of the clipped polygon colours are linear on the screen.

use crate::scene::{
    draw, for_every_colour, gouraud, lit, mesh, random_colour, random_lights, shaded, Colour, Picture, SIZE,
};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::Gray8;
use pinhole::clip::{Barycentric, Varying};
use pinhole::{Affine, Scalar, SpanShader};
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::oracle::chain::{self, fx3};
use support::oracle::cut_faces::{pieces, Corner};
use support::oracle::rng::Rng;
use support::oracle::shade::{bayer, Lit};

type V3 = [f64; 3];

/// At the origin, looking along −z, with a field of view of 90 degrees.
fn camera(far: i32) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, SIZE, ONE, far),
        viewport: (0, 0, SIZE.0, SIZE.1),
    }
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
}

/// The error that a shader may add to a channel, beside the errors of the gradients and of rounded cut corners.
#[derive(Clone, Copy)]
enum Rounding {
    /// The colour is rounded to the nearest level.
    Level,
    /// Light is rounded to one of 256 entries, and each entry to its nearest level.
    Entry,
    /// The colour is rounded to the level that the pattern of 8 × 8 thresholds selects.
    Pattern,
}

/// Every pixel that is surely inside one triangle of the clipped polygon has the colour of the oracle, within the documented
/// bound and the change that the snap of the corners explains. Adds the number of pixels to `seen`.
fn check<C: Colour, I: SpanShader<C>>(
    (planes, bits): (Planes, [[i32; 3]; 3]),
    shader: &dyn Fn([Lit; 3]) -> I,
    colors: [Lit; 3],
    rounding: Rounding,
    seen: &mut usize,
) {
    let (far, camera) = (matches!(planes, Planes::Far), planes.camera());
    let exact = camera.exact();
    let corners = [0, 1, 2].map(|i| Corner {
        clip: exact.clip(&chain::IDENTITY, fx3(bits[i])),
        levels: C::DEPTHS.levels(colors[i]).iter().map(|&(n, d)| n as f64 / d as f64).collect(),
    });
    let (pieces, whole) = pieces(&exact, &corners, far);
    assert!(!whole, "{planes:?} do not cut {bits:?}");
    let vertices = bits.map(|v| v.map(Scalar::from_bits));
    let mesh = mesh(&vertices);
    let camera = camera.library().with_far_clip(far);
    let picture = draw::<C, _>(&camera.place(&mesh, &Affine::identity()), shader(colors));
    let pattern = bayer(8);
    for piece in &pieces {
        for (p, color) in picture.drawn() {
            let at = (f64::from(p.x) + 0.5, f64::from(p.y) + 0.5);
            if piece.inside(at) < 1.0 / 64.0 {
                continue;
            }
            *seen += 1;
            for (channel, level) in color.levels().into_iter().enumerate() {
                let (level, exact) = (level as f64, piece.level(channel, at));
                // Gradients are off by 2⁻⁹ level, cut corners by another 2⁻⁹; a corner on the screen by 1/256 pixel.
                let slack = 1.0 / 512.0 + 1.0 / 512.0 + piece.change(channel, 1.0 / 256.0);
                let holds = match rounding {
                    Rounding::Level => (level - exact).abs() <= 0.5 + slack,
                    Rounding::Entry => {
                        (level - exact).abs() <= 0.5 + C::DEPTHS.0[channel] as f64 / 510.0 + slack
                    }
                    Rounding::Pattern => {
                        let rank = pattern[p.y as usize % 8][p.x as usize % 8];
                        let sum = exact + (2 * rank + 1) as f64 / 128.0;
                        ((sum - slack).floor()..=(sum + slack).floor()).contains(&level)
                    }
                };
                let Point { x, y } = p;
                assert!(
                    holds,
                    "{planes:?}: level {level} for {exact} ± {slack} at ({x}, {y}): {bits:?} {colors:?}"
                );
            }
        }
    }
}

fn every_shader<C: Colour>(planes: Planes, cases: usize) {
    let (mut rng, mut seen) = (Rng::new(0x90), [0; 5]);
    for _ in 0..cases {
        let mut face = || (planes, planes.random_face(&mut rng));
        let faces = [(); 5].map(|()| face());
        let mut colors = || [(); 3].map(|()| random_colour(&mut rng));
        let [first, second] = [colors(), colors()];
        let mut lights = || random_lights(&mut rng);
        let [third, fourth, fifth] = [lights(), lights(), lights()];
        let [a, b, c, d, e] = &mut seen;
        check::<C, _>(faces[0], &gouraud, first, Rounding::Level, a);
        check::<C, _>(faces[1], &lit, third, Rounding::Level, b);
        check::<C, _>(faces[2], &shaded, fourth, Rounding::Entry, c);
        check::<C, _>(faces[3], &|colors| gouraud(colors).dithered(), second, Rounding::Pattern, d);
        check::<C, _>(faces[4], &|lights| lit(lights).dithered(), fifth, Rounding::Pattern, e);
    }
    println!("{planes:?}: {seen:?} pixels");
    assert!(seen.iter().all(|&pixels| pixels > 100 * cases), "{planes:?}: {seen:?} pixels of {cases} faces");
}

#[test]
fn faces_cut_by_the_near_plane_have_the_colors_of_the_oracle() {
    for_every_colour!(every_shader(Planes::Near, 150));
}

#[test]
fn faces_cut_by_the_far_plane_have_the_colors_of_the_oracle() {
    for_every_colour!(every_shader(Planes::Far, 150));
}

#[test]
fn faces_cut_by_the_guard_band_have_the_colors_of_the_oracle() {
    for_every_colour!(every_shader(Planes::GuardBand, 150));
}

/// A corner moves from the near plane to 2⁻¹⁶ behind it: no pixel's colour jumps.
#[test]
fn colors_do_not_jump_as_a_corner_passes_the_near_plane() {
    let mut rng = Rng::new(0x91);
    let camera = Planes::Near.camera().library();
    let (mut worst, mut seen, mut faces) = (0, 0, 0);
    for _ in 0..2000 {
        let mut face = Planes::Near.random_face(&mut rng);
        for corner in &mut face {
            corner[2] = corner[2].min(-ONE);
        }
        let passes = rng.below(3);
        let colors = [(); 3].map(|()| random_colour(&mut rng));
        let picture = |z: i32| -> Picture<Gray8> {
            let mut face = face;
            face[passes][2] = z;
            let vertices = face.map(|v| v.map(Scalar::from_bits));
            let mesh = mesh(&vertices);
            draw(&camera.place(&mesh, &Affine::identity()), gouraud(colors))
        };
        let (before, behind) = (picture(-ONE), picture(1 - ONE));
        // The snap of its corners changes a sliver by more.
        if before.drawn().count() < 100 {
            continue;
        }
        faces += 1;
        for (p, color) in before.drawn() {
            let Some(other) = behind.at(p) else { continue };
            seen += 1;
            worst = worst.max((color.levels()[0] - other.levels()[0]).abs());
        }
    }
    println!("{faces} faces, {seen} pixels: {worst} levels of 255");
    assert!(faces > 500 && worst <= 2, "{faces} faces, {seen} pixels: {worst}");
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
