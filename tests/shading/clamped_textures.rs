//! Textures whose edge continues, against rays in f64.

use crate::texture_rays::{camera, library, numbered, perspective, Faces};
use embedded_graphics::pixelcolor::Gray8;
use pinhole::{Accuracy, Texels, Texture};
use support::oracle::rng::Rng;

/// A quad that faces the eye and fills the picture, as two triangles.
fn screen_filling(low: [i16; 2], high: [i16; 2]) -> Faces {
    let mut faces = Faces::new(-6);
    let corner = |x: usize, y: usize| {
        ([[-230, 230][x], [-230, 230][y], -384], [[low[0], high[0]][x], [high[1], low[1]][y]])
    };
    for corners in [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]] {
        faces.push(corners.map(|(at, _)| at), corners.map(|(_, uv)| uv));
    }
    faces
}

/// A floor and a ceiling that the near plane cuts, rolled by `roll` degrees.
fn rolled(roll: f64, uv: impl Fn(f64, f64) -> [i16; 2]) -> Faces {
    let mut faces = Faces::new(-6);
    let (s, c) = f64::to_radians(roll).sin_cos();
    for y in [-1.0, 1.5] {
        let corner = |x: f64, z: f64| {
            let at = [c * x - s * y, s * x + c * y, z].map(|c| (c * 64.0).round() as i16);
            (at, uv(x, z))
        };
        let [a, b, d, e] =
            [corner(-40.0, 0.5), corner(40.0, 0.5), corner(40.0, -300.0), corner(-40.0, -300.0)];
        for corners in [[a, b, d], [a, d, e]] {
            faces.push(corners.map(|(at, _)| at), corners.map(|(_, uv)| uv));
        }
    }
    faces
}

/// Every pixel shows the texel of a point within 1/64 pixel, or the edge's nearest to it, within the accuracy and 0.03 texel for the
/// planes.
#[test]
fn beyond_the_picture_its_edge_continues() {
    let matrix = perspective(2000.0);
    let camera = camera(&library(&matrix));
    let mut rng = Rng::new(21);
    for (accuracy, chosen) in
        [(Accuracy::Quarter, 0.25), (Accuracy::Eighth, 0.125), (Accuracy::Sixteenth, 0.0625)]
    {
        let scenes = [
            rolled(25.0, |x, z| [(x * 16.0) as i16, (z * 10.0) as i16]),
            rolled(-70.0, |x, z| [(z * 16.0 + 2000.0) as i16, (x * 12.0 - 30.0) as i16]),
            screen_filling([-500, -1000], [2000, 999]),
            Faces::soup(&mut rng, 60, 300, 3000, |rng| rng.int(-2000, 3000) as i16),
            Faces::soup(&mut rng, 60, 2000, 3000, |rng| rng.int(-16_000, 16_000) as i16),
        ];
        let (mut largest, mut pixels) = (0.0f64, 0);
        for (faces, bits) in scenes.iter().zip([[6, 6], [3, 8], [5, 4], [7, 3], [8, 8]]) {
            let texture = Texture::new(numbered(bits)).with_accuracy(accuracy);
            for (face, &uv) in faces.uv.iter().enumerate() {
                let picture = faces.draw(face, &camera, texture.clamped_at(uv));
                let ray = faces.ray(face, &matrix, [1.0 / 16.0; 2]);
                let (worst, count) = ray.worst_clamped(&picture, bits);
                assert!(worst <= chosen + 0.03, "{accuracy:?}, face {face} of {bits:?}: {worst}");
                (largest, pixels) = (largest.max(worst), pixels + count);
            }
        }
        assert!(largest > chosen / 2.0, "{accuracy:?}: {largest}");
        assert!(pixels > 200_000, "{pixels}");
    }
}

/// Coordinates at both ends of `i16`, in every unit: neither end wraps to the other.
#[test]
fn coordinates_at_the_ends_of_i16_show_the_edge() {
    let matrix = perspective(2000.0);
    let camera = camera(&library(&matrix));
    let ends = [i16::MIN, i16::MAX];
    for exponent in -15..=0 {
        let bits = [8, 3];
        // One side is 2^−exponent units.
        let unit = bits.map(|bits: i32| 2f64.powi(bits + i32::from(exponent)));
        let texture = Texture::new(numbered(bits.map(|bits| bits as u32))).with_exponent(exponent).unwrap();
        // All corners at one end; from end to end; and from an end by 99 units.
        let mut scenes = vec![];
        for at in ends {
            scenes.push(screen_filling([at; 2], [at; 2]));
            scenes.push(rolled(25.0, |_, _| [at; 2]));
            let inwards = at.signum() * -99;
            scenes.push(rolled(33.0, |x, z| {
                [
                    at.wrapping_add(if x > 0.0 { inwards } else { 0 }),
                    if z > 0.0 { at } else { at.wrapping_add(inwards) },
                ]
            }));
        }
        scenes.push(screen_filling([i16::MIN; 2], [i16::MAX; 2]));
        for (scene, faces) in scenes.iter().enumerate() {
            let mut pixels = 0;
            for (face, &uv) in faces.uv.iter().enumerate() {
                let picture = faces.draw(face, &camera, texture.clamped_at(uv));
                let (worst, count) =
                    faces.ray(face, &matrix, unit).worst_clamped(&picture, bits.map(|b| b as u32));
                assert!(worst <= 0.28, "2^{exponent}, scene {scene}, face {face}: {worst}");
                pixels += count;
            }
            assert!(pixels > 10_000, "{pixels}");
        }
    }
}

/// The texels of the edge of a picture with sides of different lengths, by hand.
#[test]
fn the_edge_is_that_of_each_side() {
    let picture: [[Gray8; 16]; 8] =
        core::array::from_fn(|y| core::array::from_fn(|x| Gray8::new((16 * y + x) as u8)));
    let matrix = perspective(2000.0);
    let camera = camera(&library(&matrix));
    // Columns −16 … 32 and rows −8 … 16 over the picture.
    let faces = screen_filling([-256, -128], [512, 256]);
    let index = [[0, 1, 2], [3, 4, 5]];
    let mesh = pinhole::Mesh::new(&faces.vertices, faces.exponent, &index).unwrap();
    let instance = camera.place(&mesh, &pinhole::Affine::identity());
    let mut pixels = vec![Gray8::new(255); 240 * 240];
    let mut target =
        pinhole::Picture::new(&mut pixels, embedded_graphics::prelude::Size::new(240, 240)).unwrap();
    let texture = Texture::new(&picture);
    let Ok(_) = instance.solid(|face| texture.clamped_at(faces.uv[face]), &mut [], &mut target.pixels());
    // The quad is 460 wide at a distance of 384, where 240 pixels are 443.4 wide: a column is 9.9 pixels or so.
    let share = |at: usize| 0.5 + (at as f64 + 0.5 - 120.0) / 240.0 * 443.405 / 460.0;
    for y in 0..240 {
        for x in 0..240 {
            let column = -16.0 + 48.0 * share(x);
            let row = -8.0 + 24.0 * share(y);
            let near = |c: f64| (c - c.round()).abs() < 0.01;
            if !near(column) && !near(row) {
                let [column, row] = [column.clamp(0.0, 15.9), row.clamp(0.0, 7.9)].map(|c| c as usize);
                assert_eq!(pixels[240 * y + x], picture[row][column], "({x}, {y})");
            }
        }
    }
    assert_eq!((&picture).texel(0, 0), Gray8::new(0));
}
