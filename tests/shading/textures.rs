//! Textures: the coordinates that each pixel of a face shows, repeated and clamped, in every unit and under projections of any kind,
//! against rays in f64, which share no code with the library; and equal pixels by every draw call.

use crate::rays::{
    camera, camera_on, floor, library, perspective, Faces, Numbered, Shown, Wide, FOV, PACKING, WALL,
};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::{
    camera::Window,
    mesh::TextureCoords,
    prelude::*,
    texture::{Accuracy, IndexedTexels, TexelSlice, Texels, TextureError},
    Angle,
};
use support::oracle::chain::{self, M4};
use support::oracle::rng::Rng;
use support::oracle::texture::{off_clamped, off_repeated};

/// The accuracies of a texture, in texels.
const ACCURACIES: [(Accuracy, f64); 3] =
    [(Accuracy::Quarter, 0.25), (Accuracy::Eighth, 0.125), (Accuracy::Sixteenth, 0.0625)];

/// A quad that faces the eye and fills the picture.
fn screen_filling(low: [i16; 2], high: [i16; 2]) -> Faces {
    let ([u, v], [p, q], half) = (low, high, 230.0 / 64.0);
    let mut faces = Faces::new(-6);
    faces.push_quad(
        [[-half, -half, -6.0], [half, -half, -6.0], [half, half, -6.0], [-half, half, -6.0]],
        [[u, q], [p, q], [p, v], [u, v]],
    );
    faces
}

/// A floor and a ceiling that the near plane cuts, rolled by `roll` degrees.
fn rolled(roll: f64, uv: impl Fn(f64, f64) -> [i16; 2]) -> Faces {
    let (mut faces, (s, c)) = (Faces::new(-6), f64::to_radians(roll).sin_cos());
    for y in [-1.0, 1.5] {
        let corners = [(-40.0, 0.5), (40.0, 0.5), (40.0, -300.0), (-40.0, -300.0)];
        faces.push_quad(
            corners.map(|(x, z)| [c * x - s * y, s * x + c * y, z]),
            corners.map(|(x, z)| uv(x, z)),
        );
    }
    faces
}

/// Random triangles, a floor and a wall through all of the volume.
fn through(reach: i64) -> Faces {
    let mut faces = Faces::soup(&mut Rng::new(31), 90, reach, 2500, |rng| rng.int(-4000, 4000) as i16);
    let (low, high) = (-6000, 6000);
    for [a, b, c, d] in [
        [[low, -80, 3000], [high, -80, 3000], [high, -80, -9000], [low, -80, -9000]],
        [[150, low, 3000], [60, high, 3000], [60, high, -9000], [150, low, -9000]],
    ] {
        faces.push([a, b, c], [[0, 3000], [3000, 3000], [3000, 0]]);
        faces.push([a, c, d], [[0, 3000], [3000, 0], [0, 0]]);
    }
    faces
}

/// w that grows to the right and downwards, too, and depth across the line of sight.
fn slanted() -> M4 {
    let [x, y, ..] = perspective(100.0);
    [x, y, [0.4, -0.3, -1.1, -3.0], [0.15, -0.2, -1.0, 0.0]]
}

/// A perspective whose near plane is not across the line of sight (Lengyel, *Oblique view frustum depth projection and clipping*,
/// 2005): w as usual, and depth that depends on x and y.
fn oblique_near_plane() -> M4 {
    let [x, y, _, w] = perspective(100.0);
    [x, y, [0.2, 0.5, -1.0, -2.5], w]
}

/// A reverse perspective, in which distant objects are larger.
const REVERSE: M4 =
    [[0.05, 0.0, 0.0, 0.0], [0.0, 0.05, 0.0, 0.0], [0.0, 0.0, -0.025, -1.0], [0.0, 0.0, 0.0125, 1.0]];

/// Cabinet: receding lines run upwards to the right, half as long.
fn cabinet() -> (M4, Projection) {
    let (near, far, half) = (-20, 60, 20);
    let [l, h] = [-half, half].map(Scalar::from_int);
    let window = Window { left: l, right: h, bottom: l, top: h };
    let [near_, far_] = [near, far].map(Scalar::from_int);
    let factor = Scalar::from_ratio(1, 2);
    let lens = Projection::oblique(window, near_, far_, Angle::degrees(45), factor).unwrap();
    let mut matrix = chain::orthographic(-20.0, 20.0, -20.0, 20.0, near.into(), far.into());
    // x' = x − z·cos 45°/2, and y' so: in halves of the window, 20.
    let slope = -0.5f64.sqrt() / 2.0 / 20.0;
    (matrix[0][2], matrix[1][2]) = (slope, slope);
    (matrix, lens)
}

/// A texture of faces before a camera.
struct Case {
    camera: Camera,
    matrix: M4,
    bits: [u32; 2],
    /// The unit of coordinates, in sides; without it 1/16 texel.
    exponent: Option<i8>,
    accuracy: Accuracy,
}

impl Case {
    /// The largest errors of a face in texels, repeated with coordinates of 32 bits, repeated beyond the bound of packing, and clamped;
    /// and the number of its pixels.
    fn worst(&self, faces: &Faces, face: usize) -> ([f64; 3], usize) {
        let (bits, uv) = (self.bits, faces.uv[face]);
        let unit =
            bits.map(|bits| self.exponent.map_or(1.0 / 16.0, |e| 2f64.powi(bits as i32 + i32::from(e))));
        let ray = faces.ray(face, &self.matrix, unit);
        let (mut texture, mut wide) = (Texture::new(Numbered(bits)), Texture::new(Wide(Numbered(bits))));
        if let Some(exponent) = self.exponent {
            texture = texture.with_exponent(exponent).unwrap();
            wide = wide.with_exponent(exponent).unwrap();
        }
        let (texture, wide) = (texture.with_accuracy(self.accuracy), wide.with_accuracy(self.accuracy));
        let (repeated, count) = ray.worst(&faces.draw(face, &self.camera, wide.at(uv)), bits, off_repeated);
        let (packed, _) = ray.worst(&faces.draw(face, &self.camera, texture.at(uv)), bits, off_repeated);
        let (clamped, _) =
            ray.worst(&faces.draw(face, &self.camera, texture.clamped_at(uv)), bits, off_clamped);
        let packing = f64::from(1 << bits[0].max(bits[1])) * PACKING;
        ([repeated, packed - packing, clamped], count)
    }
}

/// The promise of `Texture`: a pixel shows the coordinates of a point within 1/64 pixel, or of the edge's point nearest to it, off by at
/// most the chosen error, the error of the planes, and that of packing: also of faces that near, far, guard band and sides cut.
#[test]
fn texels_are_those_of_rays_within_the_chosen_error_under_every_projection() {
    let (usual, close, mut rng) = (perspective(2000.0), perspective(20.0), Rng::new(21));
    let mut soup = |reach, uv: i64| Faces::soup(&mut rng, 90, reach, 3000, |rng| rng.int(-uv, uv) as i16);
    let quad = |corners, roll, texels, exponent| Faces::quad(corners, roll, texels, exponent);
    let far = [0.9, 1000.0, 900.0];
    let horizon = |roll| quad(floor(far[0], far[1], far[2]), roll, 1600, -5);
    let ceiling = rolled(25.0, |x, z| [x * 16.0, z * 10.0].map(|c| c as i16));
    let across = rolled(-70.0, |x, z| [z * 16.0 + 2000.0, x * 12.0 - 30.0].map(|c| c as i16));
    // Whether the far plane cuts, the number of texels, and the error of the planes in texels.
    let cases = [
        ("floor", usual, false, quad(floor(1.7, 9.5, 6.0), 0.0, 64, -10), [6, 6], 0.01),
        ("rolled floor", usual, false, quad(floor(0.5, 9.5, 6.0), 25.0, 64, -10), [6, 6], 0.01),
        ("rolled horizon", usual, false, horizon(20.0), [6, 6], 0.02),
        ("horizon", usual, false, horizon(0.0), [6, 6], 0.02),
        ("wall", usual, false, quad(WALL, 0.0, 400, -4), [6, 6], 0.02),
        ("small triangles", usual, false, soup(300, 480), [6, 6], 0.01),
        ("large triangles", usual, false, soup(2000, 16_000), [6, 6], 0.02),
        ("floor and ceiling", usual, false, ceiling, [6, 6], 0.03),
        ("floor and ceiling, across", usual, false, across, [3, 8], 0.03),
        ("whole screen", usual, false, screen_filling([-500, -1000], [2000, 999]), [5, 4], 0.03),
        ("small triangles, few rows", usual, false, soup(300, 3000), [7, 3], 0.03),
        ("large triangles, 256 texels", usual, false, soup(2000, 16_000), [8, 8], 0.03),
        ("far plane", close, true, through(400), [6, 5], 0.03),
        ("guard band", usual, false, through(4000), [6, 5], 0.03),
        ("slanted", slanted(), true, through(400), [6, 5], 0.03),
        ("slanted near plane", oblique_near_plane(), true, through(400), [6, 5], 0.03),
        ("reverse", REVERSE, true, through(400), [6, 5], 0.03),
        ("cabinet", cabinet().0, true, through(900), [6, 5], 0.03),
    ];
    for (accuracy, chosen) in ACCURACIES {
        let mut largest = [f64::MIN; 3];
        for &(name, matrix, far, ref faces, bits, planes) in &cases {
            let lens = if name == "cabinet" { cabinet().1 } else { library(&matrix) };
            let case =
                Case { camera: camera(&lens).with_far_clip(far), matrix, bits, exponent: None, accuracy };
            let (mut pixels, mut drawn) = (0, 0);
            for face in 0..faces.uv.len() {
                let (worst, count) = case.worst(faces, face);
                let is_right = worst.iter().all(|&worst| worst <= chosen + planes);
                assert!(is_right, "{name}, {accuracy:?}, face {face}: {worst:?}");
                (pixels, drawn) = (pixels + count, drawn + usize::from(count > 0));
                for (largest, worst) in largest.iter_mut().zip(worst) {
                    *largest = largest.max(worst);
                }
            }
            assert!(
                pixels > 10_000 && drawn >= faces.uv.len().min(7),
                "{name}: {pixels} pixels of {drawn} faces"
            );
        }
        assert!(largest[0] > chosen / 2.0 && largest[2] > chosen / 2.0, "{accuracy:?}: {largest:?}");
    }
}

/// Where coordinates are linear, no pixel shows what lies beyond the corners' coordinates: a picture that a face shows once does not
/// begin again at the face's border. Beyond a shift of 1/64 pixel, no pixel is off by more than the bound of packing, and some are by
/// more than half of it.
#[test]
fn linear_coordinates_stay_between_those_of_the_corners() {
    let matrix = chain::orthographic(-4.0, 4.0, -4.0, 4.0, -20.0, 20.0);
    let camera = camera(&library(&matrix));
    let mut rng = Rng::new(61);
    let (mut pixels, mut closest, mut largest) = (0, f64::MAX, [f64::MIN; 2]);
    for case in 0..3000 {
        // Up to 6, 30 and 150 pixels.
        let reach = [102, 512, 2560][case % 3];
        let centre = [(); 2].map(|()| rng.int(-3000, 3000));
        let mut faces = Faces::new(-10);
        let corner =
            |rng: &mut Rng| [centre[0] + rng.int(-reach, reach), centre[1] + rng.int(-reach, reach), 0];
        let corners = [(); 3].map(|()| corner(&mut rng).map(|c| c as i16));
        let bits = [3 + rng.below(6) as u32, 3 + rng.below(6) as u32];
        // From one border of the picture to the other, and parts of it.
        let uv = [(); 3].map(|()| {
            [0, 1].map(|axis| [0, 16 << bits[axis], rng.int(0, 16 << bits[axis])][rng.below(3)] as i16)
        });
        faces.push(corners, uv);
        let ray = faces.ray(0, &matrix, [1.0 / 16.0; 2]);
        let packed = faces.draw(0, &camera, Texture::new(Numbered(bits)).at(uv));
        let wide = faces.draw(0, &camera, Texture::new(Wide(Numbered(bits))).at(uv));
        for (screen, largest) in [packed, wide].iter().zip(&mut largest) {
            for (at, Shown(shown)) in screen.drawn() {
                let exact = ray.0.around(at.x.into(), at.y.into()).expect("parallel lines meet the face");
                for axis in 0..2 {
                    let texels = uv.map(|uv| f64::from(uv[axis]) / 16.0);
                    let [least, most] = [f64::min, f64::max].map(|of| texels.into_iter().reduce(of).unwrap());
                    // A texel beyond either border would show the other one.
                    let side = f64::from(1u32 << bits[axis]);
                    let shown = f64::from(shown[axis]) / 2f64.powi(32) * side;
                    let room = (shown - least).min(most - shown);
                    assert!(room >= 0.0 || least == most, "{corners:?} {uv:?} {bits:?}: {shown}");
                    if most - least > 1.0 {
                        closest = closest.min(room / side);
                    }
                    *largest = largest.max(off_repeated(shown, exact[axis], side) / side);
                }
                pixels += 1;
            }
        }
    }
    assert!(pixels > 100_000 && closest < PACKING / 32.0, "{pixels} pixels, {closest}");
    let [packed, wide] = largest;
    assert!((PACKING / 2.0..PACKING).contains(&packed) && wide < 2f64.powi(-13), "{packed}, {wide}");
}

/// Random triangles of up to 24, 200 and 700 pixels, in every unit, over ranges from one unit to all of `i16`, in a parallel projection
/// and in perspective, cut by the near plane, too. No pixel is farther from a ray's texel than documented: by 2⁻¹³ of the range or 1/400
/// texel and, in perspective, by the accuracy and the error of the planes.
#[test]
fn every_unit_and_range_is_as_exact_as_documented() {
    let mut rng = Rng::new(71);
    let (mut pixels, mut largest) = (0, [0.0f64; 2]);
    for (exponent, range) in
        (-15i8..=0).flat_map(|exponent| [1, 2, 3, 16, 300, 5000, 65_535].map(|range| (exponent, range)))
    {
        for (side, is_parallel) in [24, 200, 700].into_iter().flat_map(|side| [(side, true), (side, false)]) {
            let matrix = match is_parallel {
                true => chain::orthographic(-1.0, 1.0, -1.0, 1.0, 0.5, 300.0),
                false => chain::perspective(FOV, side, side, 0.5, 2000.0),
            };
            let camera = camera_on(side, &library(&matrix));
            let bits = [(); 2].map(|()| 3 + rng.below(6) as u32);
            let unit = bits.map(|bits| 2f64.powi(bits as i32 + i32::from(exponent)));
            let faces = any_face(&mut rng, side, range, is_parallel);
            // The larger range of u and v in texels: of their own, and with 0.
            let [extent, reach] = [None, Some(0.0)].map(|zero| {
                let of = |axis: usize| {
                    let values = || faces.uv[0].iter().map(|uv| f64::from(uv[axis])).chain(zero);
                    (values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)) * unit[axis]
                };
                of(0).max(of(1))
            });
            // From the near plane on.
            let w = || faces.vertices.iter().map(|&[.., z]| f64::from(-z).max(32.0));
            let ratio = w().fold(0.0, f64::max) / w().fold(f64::MAX, f64::min);
            let case = Case { camera, matrix, bits, exponent: Some(exponent), accuracy: Accuracy::Quarter };
            let (worst, count) = case.worst(&faces, 0);
            for (worst, range) in worst.into_iter().zip([extent, extent, reach]) {
                let linear = (range * 2f64.powi(-13)).max(1.0 / 400.0);
                let planes = 0.25 + 8.0 * 2f64.powi(-24) * range * ratio;
                let bound = if is_parallel { linear } else { linear + planes };
                let case = format!("2^{exponent}, {:?} of {bits:?}, {side} px, {is_parallel}", faces.uv[0]);
                assert!(worst <= bound, "{case}: {worst} of {bound}");
                if is_parallel {
                    let kind = usize::from(linear > 1.0 / 400.0);
                    largest[kind] = largest[kind].max(worst / linear);
                }
            }
            pixels += count;
        }
    }
    // The bounds are at most twice the errors that are met.
    assert!(pixels > 3_000_000 && largest.iter().all(|&share| share > 0.5), "{pixels} pixels, {largest:?}");
}

/// One face, across a part of the screen or, in perspective, from any depth; its coordinates have a range of `range` units or less.
fn any_face(rng: &mut Rng, side: u32, range: i64, is_parallel: bool) -> Faces {
    let mut faces = Faces { side, ..Faces::new(-6) };
    let corners = [(); 3].map(|()| {
        let reach = if is_parallel { 64 } else { 300 };
        let z = if is_parallel { -64 } else { rng.int(-900, 60) };
        [rng.int(-reach, reach), rng.int(-reach, reach), z].map(|c| c as i16)
    });
    let least = [(); 2].map(|()| match rng.below(3) {
        0 => 0,
        1 => rng.int(i64::from(i16::MIN), i64::from(i16::MAX) - range),
        _ => -rng.int(0, range.min(1 << 15)),
    });
    let uv = [(); 3].map(|()| {
        least.map(|least| {
            (least + [0, range, rng.int(0, range)][rng.below(3)]).min(i64::from(i16::MAX)) as i16
        })
    });
    faces.push(corners, uv);
    faces
}

/// A picture of W × W pixels that shows 64 × 64 texels once: pixel (x, y) shows texel (⌊(2x + 1)·32/W⌋, ⌊(2y + 1)·32/W⌋). The corners of
/// faces come from `TextureCoords`, whose unit is a power of two of a side.
#[test]
fn a_square_shows_the_picture_once_in_every_unit() {
    let texels: Vec<Rgb888> = (0..64 * 64).map(|i| Rgb888::new((i % 64) as u8, (i / 64) as u8, 1)).collect();
    let texels = TexelSlice::new(&texels, 64, 64).unwrap();
    let (vertices, faces) = ([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]], [[0, 1, 2], [0, 2, 3]]);
    let mesh = Mesh::new(&vertices, 0, &faces).unwrap();
    let camera = |side| camera_on(side, &library(&chain::orthographic(-1.0, 1.0, -1.0, 1.0, 0.5, 300.0)));
    // Without an exponent, 1/16 texel.
    for exponent in (-14..=0).map(Some).chain([None]) {
        // One side of the picture.
        let end = exponent.map_or(1024, |exponent: i8| 1i16 << -exponent);
        let uv = [[0, end], [end, end], [end, 0], [0, 0]];
        let coords = TextureCoords::new(&uv, &faces, exponent.unwrap_or(-10)).unwrap();
        let texture = match exponent {
            Some(_) => Texture::new(texels).with_exponent(coords.exponent()).unwrap(),
            None => Texture::new(texels),
        };
        for (side, is_clamped) in [64, 600, 1500].into_iter().flat_map(|side| [(side, false), (side, true)]) {
            let camera = camera(side);
            let instance = camera.place(&mesh, &pinhole::Affine::identity());
            let mut pixels = vec![Rgb888::BLACK; (side * side) as usize];
            let mut picture = Picture::new(&mut pixels, Size::new_equal(side)).unwrap();
            let mut picture = picture.pixels();
            let Ok(_) = match is_clamped {
                true => instance.faces(|f| texture.clamped_at(coords.corners(f))).draw(&mut picture),
                false => instance.faces(|f| texture.at(coords.corners(f))).draw(&mut picture),
            };
            for (i, pixel) in pixels.into_iter().enumerate() {
                assert_eq!(pixel.b(), 1);
                let at = [i as u32 % side, i as u32 / side];
                for (at, shown) in at.into_iter().zip([pixel.r(), pixel.g()]) {
                    let (texel, rest) = ((2 * at + 1) * 32 / side, (2 * at + 1) * 32 % side);
                    // Within 1/16 texel of two texels' border either will do.
                    let is_near = |border: u32| rest.abs_diff(border) <= side / 16;
                    let off = i64::from(shown) - i64::from(texel);
                    let allowed = off == 0 || off == 1 && is_near(side) || off == -1 && is_near(0);
                    assert!(allowed, "{exponent:?}, {side} px, clamped {is_clamped}: {shown}, not {texel}");
                }
            }
        }
    }
}

/// That their messages name the numbers is tested in `pipeline`.
#[test]
fn textures_that_cannot_be_are_refused() {
    let (texels, palette) = ([0u8; 63], [Rgb888::new(0, 0, 0); 15]);
    let side = IndexedTexels::<Rgb888, 8>::new(&texels, 8, 12, &palette).unwrap_err();
    assert_eq!(side, TextureError::Side { side: 12 });
    let short = IndexedTexels::<Rgb888, 8>::new(&texels, 8, 8, &palette).unwrap_err();
    assert_eq!(short, TextureError::Texels { needed: 64, given: 63 });
    let few = IndexedTexels::<Rgb888, 4>::new(&texels, 8, 8, &palette).unwrap_err();
    assert_eq!(few, TextureError::Palette { needed: 16, given: 15 });
    let short = TexelSlice::<Rgb888>::new(&palette, 8, 8).unwrap_err();
    assert_eq!(short, TextureError::Texels { needed: 64, given: 15 });
    for side in [0, 4, 512, usize::MAX] {
        assert_eq!(TexelSlice::<Rgb888>::new(&palette, side, 8).unwrap_err(), TextureError::Side { side });
    }
    for exponent in [1, -16] {
        let texture = Texture::new(Numbered([3, 3])).with_exponent(exponent);
        assert_eq!(texture.map(|_| ()), Err(TextureError::Exponent { exponent }));
    }
}

/// A colour of its own for nearly all coordinates, in a format that every kind of target has; light dims two channels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Colored;

impl Texels for Colored {
    type Color = Rgb888;
    type Ink = Rgb888;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        [6, 6]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        Rgb888::new((u >> 24) as u8, (v >> 24) as u8, (u >> 16 ^ v >> 12) as u8)
    }

    const LEVEL_BITS: u32 = 7;

    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Rgb888 {
        Rgb888::new((u >> 24) as u8, level as u8, (v >> 24) as u8)
    }
}

/// Of faces that planes cut.
#[test]
fn textured_faces_are_equal_by_every_draw_call() {
    let mut rng = Rng::new(51);
    let mut soup = |reach| {
        let mut faces = Faces::soup(&mut rng, 60, reach, 2500, |rng| rng.int(-4000, 4000) as i16);
        faces.push(
            [[-6000, -80, 3000], [6000, -90, 3000], [0, -60, -9000]],
            [[0, 3000], [3000, 3000], [1500, 0]],
        );
        faces
    };
    // Of at most 32 x 32 pixels and one side of the texture: both coordinates lie in one word.
    let small = Faces::soup(&mut Rng::new(52), 480, 900, 400, |rng| rng.int(-500, 500) as i16);
    let usual = library(&perspective(2000.0));
    for (name, lens, faces) in [
        ("floor", usual, Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 200, -10)),
        ("horizon", usual, Faces::quad(floor(0.9, 1000.0, 900.0), 20.0, 1600, -5)),
        ("wall", usual, Faces::quad(WALL, 70.0, 400, -4)),
        ("far plane", library(&perspective(20.0)), soup(400)),
        ("guard band", usual, soup(6000)),
        ("slanted", library(&slanted()), soup(400)),
        ("cabinet", cabinet().1, soup(900)),
        ("small faces", cabinet().1, small),
    ] {
        faces.texture_by_every_call(name, &camera(&lens).with_far_clip(true), Colored);
    }
}
