//! Shaders that leave out pixels: keyed texels, against rays in f64, which share no code with the library, and screen doors, against the
//! recursive definition of Bayer's matrix.

use crate::levels::rank;
use crate::rays::{everywhere, floor, in_memory, perspective, Faces, Tiles, AREA, SKY, WALL};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::Point;
use embedded_graphics::primitives::PointsIter;
use pinhole::{
    Accuracy, ColorKeyed, DepthBuffer, Gouraud, IndexKeyed, IndexedTexels, ScreenDoor, Texels, Texture,
};
use support::oracle::rng::Rng;

const KEY: Rgb888 = Rgb888::new(255, 0, 255);

/// A chessboard of 8 × 8 texels: its upper left texel has the key's colour, and the texels beside it have colours of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chessboard;

impl Texels for Chessboard {
    type Color = Rgb888;
    type Ink = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        Tiles.size_bits()
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        let is_key = (u ^ v) >> 29 & 1 == 0;
        if is_key {
            KEY
        } else {
            Tiles.texel(u, v)
        }
    }
}

/// A pixel is drawn if the texel at its centre is not transparent, and stores its depth then; other pixels are left alone. It is
/// compared where the texel is the same within 1/64 pixel and 0.08 texel: the error that `Texture` promises.
#[test]
fn pixels_of_transparent_texels_are_left_out_with_their_depth() {
    let scenes = [
        Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 16, -10), // cut by the near plane
        Faces::quad(floor(0.9, 300.0, 200.0), 20.0, 60, -6),
        Faces::quad(WALL, 70.0, 60, -4),
    ];
    let (matrix, far) = (perspective(2000.0), 2000.0);
    let (mut drawn, mut left_out) = (0, 0);
    for alone in scenes.iter().flat_map(|scene| [0, 1].map(|face| scene.alone(face))) {
        let full = in_memory(&alone, &|_| Texture::new(Tiles).at(alone.uv[0]));
        let texture = Texture::new(ColorKeyed::new(Chessboard, KEY)).with_accuracy(Accuracy::Sixteenth);
        let found = everywhere(&alone, &|_| texture.at(alone.uv[0]));
        assert!(found.solid == found.deep, "one face hides nothing of itself");
        let (texels, distances) = (alone.ray(0, &matrix, [1.0 / 16.0; 2]), alone.distances(0, &matrix));
        for (i, at) in AREA.points().enumerate() {
            let Point { x, y } = at;
            let (pixel, stored) = (found.solid[i], found.depths[i]);
            if full.solid[i] == SKY {
                assert_eq!((pixel, stored), (SKY, DepthBuffer::NOTHING), "outside of the face");
                continue;
            }
            let around = texels.0.around(x.into(), y.into());
            // The one texel that both ends of a range lie in.
            let of = |(low, high): (f64, f64)| {
                let [low, high] = [low - 0.08, high + 0.08].map(|texel| texel.floor() as i64);
                (low == high).then_some(low.rem_euclid(8) as u32)
            };
            let Some([Some(column), Some(row)]) = around.map(|ranges| ranges.map(of)) else { continue };
            if (column + row) % 2 == 0 {
                assert_eq!((pixel, stored), (SKY, DepthBuffer::NOTHING), "{at}");
                left_out += 1;
                continue;
            }
            assert_eq!(pixel, Tiles.texel(column << 29, row << 29), "{at}");
            // One step of rounding, and the change of depth within 1/64 pixel.
            let [(near, beyond), _] = distances.0.around(x.into(), y.into()).expect("before the eye");
            let [low, high] = [near, beyond].map(|w| 65_535.0 * far / (far - 1.0) * (1.0 - 1.0 / w));
            let is_right = (low - 1.0..=high + 1.0).contains(&f64::from(stored));
            assert!(is_right, "{at}: {stored}, {low} … {high}");
            drawn += 1;
        }
    }
    assert!(drawn > 10_000 && left_out > 10_000, "{drawn} and {left_out}");
}

/// Faces of any shape that hide each other: keyed texels are the unkeyed picture without the key, on every target and in bands.
#[test]
fn keyed_faces_show_what_is_behind_them() {
    for seed in 5..8 {
        let scene = Faces::soup(&mut Rng::new(seed), 120, 1200, 3000, |rng| rng.int(-3200, 3200) as i16);
        let texture = Texture::new(ColorKeyed::new(Chessboard, KEY));
        let found = everywhere(&scene, &|face| texture.at(scene.uv[face]));
        assert!(found.solid.iter().chain(&found.deep).all(|&pixel| pixel != KEY));
        for (pixel, depth) in found.deep.iter().zip(&found.depths) {
            assert_eq!(*pixel == SKY, *depth == DepthBuffer::NOTHING);
        }
        let drawn = found.deep.iter().filter(|&&pixel| pixel != SKY).count();
        assert!(drawn > 10_000 && found.solid != found.deep, "{drawn}");
    }
}

/// A key of an index leaves out the same pixels as a key of the index's colour; an index that no texel has leaves out none.
#[test]
fn a_key_is_a_colour_or_an_index() {
    let scene = Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10);
    let palette: Vec<Rgb888> = (0..16).map(|i| Rgb888::new(100 + i, 7 * i, 255 - i)).collect();
    let bytes: Vec<u8> = (0..8 * 8 / 2).map(|i: u8| i.wrapping_mul(37)).collect();
    let texels = IndexedTexels::<_, 4>::new(&bytes, 8, 8, &palette).unwrap();
    let full = in_memory(&scene, &|face| Texture::new(texels).at(scene.uv[face]));
    for key in [0, 5, 10, 16, 255] {
        let by_index = Texture::new(IndexKeyed::new(texels, key));
        let drawn = in_memory(&scene, &|face| by_index.at(scene.uv[face]));
        let Some(&color) = palette.get(usize::from(key)) else {
            assert!(drawn.deep == full.deep && drawn.depths == full.depths);
            continue;
        };
        let by_color = Texture::new(ColorKeyed::new(texels, color));
        assert!(drawn == in_memory(&scene, &|face| by_color.at(scene.uv[face])));
        let without = full.deep.iter().map(|&pixel| if pixel == color { SKY } else { pixel });
        assert!(drawn.deep.iter().copied().eq(without) && drawn.deep != full.deep);
    }
    // Two indices of one colour: only the key is transparent.
    let same = [Rgb888::new(9, 9, 9); 16];
    let texels = texels.with_palette(&same).unwrap();
    let kept = |x: u32| IndexKeyed::new(texels, 5).texel(x << 29, 0);
    // 37 = 0x25 is the second byte: texels 0, 0, 2, 5.
    assert_eq!([kept(0), kept(2), kept(3)], [Some(same[0]), Some(same[0]), None]);
    assert_eq!(ColorKeyed::new(texels, same[0]).texel(0, 0), None);
}

#[test]
fn the_pixels_of_low_ranks_are_drawn_with_their_depth() {
    let scene = Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10);
    let shade = |face: usize| {
        let [a, b, c] = [[9, 200, 40], [250, 3, 77], [20, 90, 255]].map(|[r, g, b]| Rgb888::new(r, g, b));
        Gouraud::new(if face == 0 { [a, b, c] } else { [a, c, b] })
    };
    let full = in_memory(&scene, &shade);
    assert!(full.deep.iter().filter(|&&pixel| pixel != SKY).count() > 10_000);
    for coverage in [0, 1, 7, 16, 32, 33, 48, 63, 64, 200] {
        let drawn = everywhere(&scene, &|face| ScreenDoor::new(shade(face), coverage));
        for (i, at) in AREA.points().enumerate() {
            let is_drawn = rank(at) < i128::from(coverage);
            let wanted = if is_drawn { (full.deep[i], full.depths[i]) } else { (SKY, DepthBuffer::NOTHING) };
            assert_eq!((drawn.deep[i], drawn.depths[i]), wanted, "{at}, {coverage} of 64");
            assert_eq!(drawn.solid[i], if is_drawn { full.solid[i] } else { SKY });
        }
    }
}

/// Plain colours, faces of any shape: of two faces with one coverage the nearer hides the other.
#[test]
fn of_faces_with_equal_coverage_the_nearer_is_seen() {
    let scene = Faces::soup(&mut Rng::new(9), 120, 1200, 3000, |_| 0);
    let color = |face: usize| Rgb888::new(face as u8, 255 - face as u8, 100);
    let full = in_memory(&scene, &color);
    let drawn = everywhere(&scene, &|face| ScreenDoor::new(color(face), 40));
    for (i, at) in AREA.points().enumerate() {
        assert_eq!(drawn.deep[i], if rank(at) < 40 { full.deep[i] } else { SKY });
    }
    // Where coverages differ, what is behind shows through.
    let mixed = everywhere(&scene, &|face| ScreenDoor::new(color(face), if face % 2 == 0 { 20 } else { 64 }));
    let through =
        mixed.deep.iter().zip(&full.deep).filter(|(mixed, full)| mixed.r() % 2 == 1 && full.r() % 2 == 0);
    assert!(through.count() > 1000);
}
