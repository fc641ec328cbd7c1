//! Keyed texels, against rays in f64, which share no code with the library. In every format, and behind screen doors, they are tested by
//! `fuzz/targets/texture` and `fuzz/targets/translucent.rs`.

use crate::rays::{everywhere, floor, in_memory, perspective, Faces, Tiles, AREA, SKY, WALL};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::Point;
use embedded_graphics::primitives::PointsIter;
use pinhole::{
    target::DepthBuffer,
    texture::{Accuracy, ColorKeyed, Texels, Texture},
};

const KEY: Rgb888 = Rgb888::new(255, 0, 255);

/// A chessboard of 8 × 8 texels: its upper left texel has the key's colour, and the texels beside it have colours of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chessboard;

impl Texels for Chessboard {
    type Color = Rgb888;
    type Ink = Rgb888;
    type FastPath = ();

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
