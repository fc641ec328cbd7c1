//! Gouraud shading in perspective: each level against the colour on a ray in f64, which shares no code with the library, on several
//! kinds of target; and equal pixels however spans are cut.

use crate::levels::levels;
use crate::rays::{camera, everywhere, floor, library, perspective, Faces, WALL};
use crate::scene::Colour;
use embedded_graphics::pixelcolor::{Gray8, Rgb565, Rgb888};
use pinhole::{prelude::*, shading::SpanShader};
use support::oracle::chain::M4;
use support::oracle::rng::Rng;

/// Floors and a wall that reach close to the eye, some cut by the near plane, and random triangles.
fn scenes() -> [(&'static str, Faces); 6] {
    let quad = |corners, roll, exponent| Faces::quad(corners, roll, 1, exponent);
    let soup = |reach| Faces::soup(&mut Rng::new(47), 90, reach, 3000, |_| 0);
    [
        ("floor", quad(floor(1.0, 16.0, 6.0), 0.0, -10)),
        ("rolled floor", quad(floor(0.5, 9.5, 6.0), 25.0, -10)),
        ("horizon", quad(floor(0.9, 1000.0, 900.0), 20.0, -5)),
        ("wall", quad(WALL, 0.0, -4)),
        ("small triangles", soup(300)),
        ("large triangles", soup(2000)),
    ]
}

/// Black, white and random colours at the corners.
fn colours(face: usize) -> [[u8; 3]; 3] {
    let mut rng = Rng::new(face as u64);
    match face % 3 {
        0 => [[0; 3], [255; 3], [255; 3]],
        1 => [[255; 3], [0; 3], [255, 0, 128]],
        _ => [(); 3].map(|()| [(); 3].map(|()| rng.int(0, 255) as u8)),
    }
}

fn gouraud(face: usize) -> Gouraud {
    Gouraud::new(colours(face).map(|[r, g, b]| Rgb888::new(r, g, b)))
}

/// The largest distance of a level of a face from those of the points within 1/64 pixel, in levels of the target; and the number of
/// pixels.
fn worst<C: Colour, S: SpanShader<C, Ink = C>>(
    faces: &Faces,
    face: usize,
    matrix: &M4,
    shader: S,
) -> (f64, usize) {
    let ray = faces.weights(face, matrix).0;
    let levels = |[u, v]: [f64; 2]| {
        let [first, second, third] = colours(face).map(|color| color.map(f64::from));
        let mixed = |i: usize| first[i] + u * (second[i] - first[i]) + v * (third[i] - first[i]);
        levels(C::DEPTHS, [0, 1, 2].map(mixed))
    };
    let (mut worst, mut count) = (0.0f64, 0);
    for (at, shown) in faces.draw(face, &camera(&library(matrix)), shader).drawn() {
        let near: Option<Vec<_>> = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
            .into_iter()
            .map(|(dx, dy)| ray.at(f64::from(at.x) + 0.5 + dx / 64.0, f64::from(at.y) + 0.5 + dy / 64.0))
            .collect();
        // Beside the face's horizon a point within 1/64 pixel may show anything.
        let Some(near) = near else { continue };
        let near: Vec<_> = near.into_iter().map(levels).collect();
        for (channel, shown) in shown.levels().into_iter().enumerate() {
            let of = |pick: fn(f64, f64) -> f64| near.iter().map(|all| all[channel]).reduce(pick).unwrap();
            let (shown, low, high) = (shown as f64, of(f64::min), of(f64::max));
            worst = worst.max(low - shown).max(shown - high);
        }
        count += 1;
    }
    (worst, count)
}

/// The promise of `PerspectiveGouraud`, and by how much of its range of colours `Gouraud` is off on a floor whose end is 16 times as far
/// as its beginning.
fn levels_are_those_of_rays<C: Colour>() {
    let (matrix, mut largest, mut linear) = (perspective(2000.0), 0.0f64, 0.0f64);
    for (name, faces) in scenes() {
        let mut pixels = 0;
        for face in 0..faces.uv.len() {
            let (error, count) = worst::<C, _>(&faces, face, &matrix, gouraud(face).in_perspective());
            assert!(error <= 0.75 + 1.0 / 64.0, "{name}, face {face}: {error}");
            (largest, pixels) = (largest.max(error), pixels + count);
            if name == "floor" {
                linear = linear.max(worst::<C, _>(&faces, face, &matrix, gouraud(face)).0);
            }
        }
        assert!(pixels > 5_000, "{name}: {pixels}");
    }
    // 153 of 255.
    let documented = 0.6 * *C::DEPTHS.0.iter().max().expect("a channel") as f64 + 0.5;
    assert!(largest > 0.55 && (0.9 * documented..documented).contains(&linear), "{largest}, {linear}");
}

#[test]
fn levels_are_those_of_rays_within_a_quarter() {
    levels_are_those_of_rays::<Rgb888>();
    levels_are_those_of_rays::<Gray8>();
    levels_are_those_of_rays::<Rgb565>();
}

#[test]
fn pixels_are_equal_however_spans_are_cut() {
    for (_, faces) in scenes() {
        everywhere(&faces, &|face| gouraud(face).in_perspective());
        everywhere(&faces, &|face| Dithered(gouraud(face).in_perspective()));
    }
}
