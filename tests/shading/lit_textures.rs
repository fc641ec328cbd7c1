//! Textures in light, by face and by vertex, against light in f64 and the texels of unlit faces.

use crate::rays::{camera, Faces, SIDE};
use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::pixelcolor::{Gray8, PixelColor};
use embedded_graphics::prelude::*;
use pinhole::{
    camera::Window,
    color::Format,
    prelude::*,
    shading::SpanShader,
    texture::{ColorKeyed, IndexedTexels, TexelSlice, Texels},
};
use support::oracle::rng::Rng;

/// A level of light, and the number of a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry(u16, u16);

impl PixelColor for Entry {
    type Raw = RawU32;
}

impl Color for Entry {
    const FORMAT: Format = Format::indexed(32, [0; 3]);

    fn to_bits(self) -> u32 {
        u32::from(self.0) | u32::from(self.1) << 16
    }

    fn from_bits(bits: u32) -> Self {
        Self(bits as u16, (bits >> 16) as u16)
    }
}

/// A triangle on the screen, in sub-pixels of 1/64.
fn random_triangle(rng: &mut Rng) -> [[i64; 2]; 3] {
    let reach = [240 * 64, 5_000, 1_000][rng.below(3)];
    let from = [(); 2].map(|()| rng.int(0, 240 * 64 - reach));
    [(); 3].map(|()| from.map(|from| from + rng.int(0, reach)))
}

/// The pixels of a triangle: a unit is a pixel, and the origin is the upper left corner.
fn draw<C: PixelColor, S: SpanShader<C, Ink = C>>(corners: [[i64; 2]; 3], shader: S) -> Vec<Option<C>> {
    let [zero, one, side] = [0, 1, SIDE as i32].map(Scalar::from_int);
    let window = Window { left: zero, right: side, bottom: -side, top: zero };
    let camera = camera(&Projection::orthographic(window, -one, one).unwrap());
    let mut faces = Faces::new(-6);
    faces.push(corners.map(|[x, y]| [x as i16, -y as i16, 0]), [[0; 2]; 3]);
    faces.draw(0, &camera, shader).pixels
}

/// A value at a pixel's centre, linear between those of the corners.
fn linear(corners: [[i64; 2]; 3], values: [f64; 3], pixel: usize) -> f64 {
    let p = [pixel as i64 % i64::from(SIDE), pixel as i64 / i64::from(SIDE)].map(|c| c * 64 + 32);
    let area = |a: [i64; 2], b: [i64; 2], c: [i64; 2]| {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) as f64
    };
    let [a, b, c] = corners;
    let weights = [area(p, b, c), area(a, p, c), area(a, b, p)];
    (0..3).map(|i| weights[i] * values[i]).sum::<f64>() / area(a, b, c)
}

/// 32 × 16 texels that show their number and one of 2^`BITS` levels of their light.
#[derive(Clone, Copy)]
struct Leveled<const BITS: u32>;

impl<const BITS: u32> Texels for Leveled<BITS> {
    type Color = Entry;
    type Ink = Entry;
    type FastPath = ();
    const LEVEL_BITS: u32 = BITS;

    fn size_bits(&self) -> [u32; 2] {
        [5, 4]
    }

    fn texel(&self, u: u32, v: u32) -> Entry {
        self.lit_texel(u, v, (1 << BITS) - 1)
    }

    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Entry {
        Entry(level as u16, ((v >> 28) << 5 | u >> 27) as u16)
    }
}

/// Each pixel shows the texel that it shows without light, in the nearest of 2^`BITS` levels.
fn levels_are_the_nearest<const BITS: u32>() {
    let mut rng = Rng::new(1000 + u64::from(BITS));
    let (texture, most) = (Texture::new(Leveled::<BITS>), f64::from((1 << BITS) - 1));
    let (mut pixels, mut met) = (0, vec![false; 1 << BITS]);
    for _ in 0..60 {
        let corners = random_triangle(&mut rng);
        let levels = [(); 3].map(|()| [rng.int(0, 256), 0, 256, rng.int(257, 300)][rng.below(4)] as u16);
        let uv = [(); 3].map(|()| [(); 2].map(|()| rng.int(-700, 700) as i16));
        let own = draw(corners, texture.at(uv).lit(levels));
        let without = draw(corners, texture.at(uv));
        let edge = draw(corners, texture.clamped_at(uv));
        let lit_edge = draw(corners, texture.clamped_at(uv).lit(levels));
        for (i, shown) in own.iter().enumerate() {
            let Some(Entry(row, color)) = *shown else {
                assert_eq!(without[i], None);
                continue;
            };
            // The texel is that of the face without light, which the last level shows.
            assert_eq!(without[i], Some(Entry(most as u16, color)));
            let exact = linear(corners, levels.map(|level| f64::from(level.min(256)) / 256.0), i) * most;
            assert!((f64::from(row) - exact).abs() <= 0.5 + 1.0 / 256.0, "row {row} for {exact}");
            assert_eq!(lit_edge[i], edge[i].map(|Entry(_, color)| Entry(row, color)));
            (pixels, met[usize::from(row)]) = (pixels + 1, true);
        }
    }
    assert!(pixels > 30_000, "{pixels}");
    assert!(met.iter().all(|met| *met), "{met:?}");
}

#[test]
fn light_chooses_the_nearest_level() {
    levels_are_the_nearest::<1>();
    levels_are_the_nearest::<5>();
    levels_are_the_nearest::<6>();
    levels_are_the_nearest::<8>();
}

/// Texels times light, of a picture and of a palette: within ½ level for rounding the product, and the light's own rounding to
/// 1/255, which is another half, and its map to 256 levels.
#[test]
fn texels_are_multiplied_by_light_at_each_pixel() {
    let mut rng = Rng::new(7);
    let picture: [[Gray8; 32]; 64] =
        core::array::from_fn(|_| core::array::from_fn(|_| Gray8::new(rng.bits() as u8)));
    let flat: Vec<Gray8> = picture.iter().flatten().copied().collect();
    let bytes: Vec<u8> = flat.iter().map(|color| color.luma()).collect();
    let palette: Vec<Gray8> = (0..=255).map(Gray8::new).collect();
    let texture = Texture::new(&picture);
    // Keyed texels are lit, too, and the key is found before.
    let keyed = ColorKeyed::new(&picture, picture[0][0]);
    let found = [0, 1 << 27].map(|u| keyed.lit_texel(u, 0, 128));
    assert_eq!(found, [None, Some(picture[0][1].dim(129))]);
    let slice = Texture::new(TexelSlice::new(&flat, 32, 64).unwrap());
    let indexed = Texture::new(IndexedTexels::<_, 8>::new(&bytes, 32, 64, &palette).unwrap());
    let mut pixels = 0;
    for _ in 0..60 {
        let corners = random_triangle(&mut rng);
        let levels = [(); 3].map(|()| [rng.int(0, 256), 0, 256][rng.below(3)] as u16);
        let uv = [(); 3].map(|()| [(); 2].map(|()| rng.int(-700, 700) as i16));
        let texels = draw(corners, texture.at(uv));
        let lit = draw(corners, texture.at(uv).lit(levels));
        assert!(lit == draw(corners, slice.at(uv).lit(levels)));
        assert!(lit == draw(corners, indexed.at(uv).lit(levels)));
        for (i, (shown, texel)) in lit.iter().zip(&texels).enumerate() {
            let (Some(shown), Some(texel)) = (shown, texel) else {
                assert_eq!(shown, texel);
                continue;
            };
            let (shown, texel) = (f64::from(shown.luma()), f64::from(texel.luma()));
            let light = linear(corners, levels.map(|level| f64::from(level) / 256.0), i);
            let bound = 0.5 + texel * (0.5 / 255.0 + 0.5 / 256.0 + 1.0 / 65536.0);
            assert!((shown - texel * light).abs() <= bound, "{shown} for {texel} in {light}");
            pixels += 1;
        }
        // Full light changes nothing, no light leaves black.
        assert!(draw(corners, texture.at(uv).lit([256; 3])) == texels);
        let dark = draw(corners, texture.at(uv).lit([0; 3]));
        assert!(dark.iter().flatten().all(|color| color.luma() == 0));
    }
    assert!(pixels > 50_000, "{pixels}");
}
