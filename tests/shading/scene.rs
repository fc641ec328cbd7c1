//! Colour types whose channels the tests read, and triangles with given positions on the screen.

use embedded_graphics_core::pixelcolor::raw::RawU32;
use embedded_graphics_core::pixelcolor::{
    BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb565, Rgb888, RgbColor,
};
use embedded_graphics_core::prelude::*;
use pinhole::{
    color::Format,
    prelude::*,
    shading::{SpanShader, TableShader},
};
use support::bridge::pair::{CameraBits, ProjectionBits, ONE};
use support::oracle::coverage::P;
use support::oracle::rng::Rng;
use support::oracle::shade::{Depths, Lit};
use support::oracle::target::Screen;

/// A colour whose channels the tests can read.
pub(crate) trait Colour: Color + core::fmt::Debug + 'static {
    const DEPTHS: Depths;
    fn levels(self) -> Vec<i128>;
}

macro_rules! colours {
    ($($rgb:ident: $depths:expr),*; $($grey:ident: $max:literal),*) => {
        $(impl Colour for $rgb {
            const DEPTHS: Depths = Depths(&$depths);
            fn levels(self) -> Vec<i128> {
                [self.r(), self.g(), self.b()].map(i128::from).to_vec()
            }
        })*
        $(impl Colour for $grey {
            const DEPTHS: Depths = Depths(&[$max]);
            fn levels(self) -> Vec<i128> {
                vec![i128::from(self.luma())]
            }
        })*
    };
}

colours! {
    Rgb565: [31, 63, 31], Rgb888: [255, 255, 255];
    Gray8: 255, Gray4: 15, Gray2: 3
}

impl Colour for BinaryColor {
    const DEPTHS: Depths = Depths(&[1]);
    fn levels(self) -> Vec<i128> {
        vec![i128::from(self.is_on())]
    }
}

/// A custom colour: 32 bits on the wire, and channels whose highest levels are not powers of two minus one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Own([u8; 3]);

impl PixelColor for Own {
    type Raw = RawU32;
}

impl Color for Own {
    const FORMAT: Format = Format::indexed(32, [100, 1, 200]);

    fn to_bits(self) -> u32 {
        let [r, g, b] = self.0;
        u32::from_be_bytes([0xa5, b, g, r])
    }

    fn from_bits(bits: u32) -> Self {
        let [_, b, g, r] = bits.to_be_bytes();
        Self([r, g, b])
    }

    fn channels(self) -> [u8; 3] {
        self.0
    }

    fn from_channels(levels: [u8; 3]) -> Self {
        Self(levels)
    }
}

impl Colour for Own {
    const DEPTHS: Depths = Depths(&[100, 1, 200]);
    fn levels(self) -> Vec<i128> {
        self.0.map(i128::from).to_vec()
    }
}

/// Runs a generic test for every kind of colour.
macro_rules! for_every_colour {
    ($test:ident($($argument:expr),*)) => {{
        $test::<embedded_graphics_core::pixelcolor::Rgb565>($($argument),*);
        $test::<embedded_graphics_core::pixelcolor::Rgb888>($($argument),*);
        $test::<embedded_graphics_core::pixelcolor::Gray8>($($argument),*);
        $test::<embedded_graphics_core::pixelcolor::Gray4>($($argument),*);
        $test::<embedded_graphics_core::pixelcolor::Gray2>($($argument),*);
        $test::<embedded_graphics_core::pixelcolor::BinaryColor>($($argument),*);
        $test::<crate::scene::Own>($($argument),*);
    }};
}
pub(crate) use for_every_colour;

pub(crate) const SIZE: (u32, u32) = (64, 48);

/// A camera for which a world unit is a pixel and (0, 0) the middle of the picture.
pub(crate) fn flat_camera() -> Camera {
    let (w, h) = (SIZE.0 as i32 * ONE / 2, SIZE.1 as i32 * ONE / 2);
    CameraBits::ahead(ProjectionBits::Orthographic([-w, w, -h, h], ONE, 9 * ONE), SIZE).library()
}

/// The vertex that [`flat_camera`] projects to a position in sub-pixels.
pub(crate) fn vertex((x, y): P) -> [Scalar; 3] {
    let (w, h) = (i64::from(SIZE.0) * 128, i64::from(SIZE.1) * 128);
    let bits = |v: i64| Scalar::from_bits(i32::try_from(v << 8).expect("a scalar"));
    [bits(x - w), bits(h - y), Scalar::from_bits(-2 * ONE)]
}

/// The screen positions of the corners of face 0, which the library computes.
pub(crate) fn corners(instance: &MeshInstance<'_, Scalar>) -> [P; 3] {
    [0, 1, 2].map(|i| {
        let at = instance.project(i).expect("in the guard band").point;
        (i64::from(at.x()), i64::from(at.y()))
    })
}

pub(crate) fn draw<C: PixelColor, I: SpanShader<C, Ink = C>>(
    instance: &MeshInstance<'_, Scalar>,
    shader: I,
) -> Screen<C> {
    let mut screen = Screen::sized(SIZE.0, SIZE.1);
    let shade: &dyn Fn(usize) -> I = &|_| shader;
    let Ok(_) = instance.with_cull(Cull::None).faces(shade).draw(&mut screen);
    screen
}

/// Calls `with` for a triangle, given in sub-pixels, that faces either way.
pub(crate) fn with_triangle<R>(t: [P; 3], with: impl FnOnce(&MeshInstance<'_, Scalar>) -> R) -> R {
    let vertices = t.map(vertex);
    let mesh = Mesh::from_fixed(&vertices, &[[0, 1, 2]]).expect("a mesh");
    with(&flat_camera().place(&mesh, &Affine::identity()).with_cull(Cull::None))
}

/// A random colour, often at the ends of its ranges.
pub(crate) fn random_colour(rng: &mut Rng) -> Lit {
    let mut channel = || match rng.below(4) {
        0 => 0,
        1 => 255,
        _ => rng.below(256) as u8,
    };
    let rgb = [channel(), channel(), channel()];
    let level = if rng.one_in(2) { 256 } else { rng.int(0, 256) as u16 };
    Lit { rgb, level }
}

pub(crate) fn flat(colour: Lit) -> Flat {
    let [r, g, b] = colour.rgb;
    Flat::lit(Rgb888::new(r, g, b), colour.level)
}

pub(crate) fn gouraud(colours: [Lit; 3]) -> Gouraud {
    Gouraud::new(colours.map(flat))
}

/// A shader of corners that differ only in their light.
pub(crate) fn lit([a, b, c]: [Lit; 3]) -> pinhole::shading::Lit {
    assert!(a.rgb == b.rgb && a.rgb == c.rgb);
    let [red, green, blue] = a.rgb;
    Gouraud::lit(Rgb888::new(red, green, blue), [a.level, b.level, c.level])
}

/// A table of the first corner's colour, leaked so that a shader can borrow it.
pub(crate) fn table<C: Colour>([a, ..]: [Lit; 3]) -> &'static ShadeTable<C> {
    let [red, green, blue] = a.rgb;
    Box::leak(Box::new(ShadeTable::new(Rgb888::new(red, green, blue))))
}

/// Corners as in [`lit`], shaded by the table of their colour.
pub(crate) fn shaded<C: Colour>(lights: [Lit; 3]) -> TableShader<'static, C> {
    table(lights).lit(lights.map(|light| light.level))
}

/// Three lights of one colour.
pub(crate) fn random_lights(rng: &mut Rng) -> [Lit; 3] {
    let Lit { rgb, .. } = random_colour(rng);
    [0; 3].map(|_| Lit { rgb, ..random_colour(rng) })
}

/// A triangle inside the guard band: small, as large as the picture, far larger, or a sliver.
pub(crate) fn random_triangle(rng: &mut Rng) -> [P; 3] {
    let reach = [300, 3_000, 12_000, 100_000, 2_000_000][rng.below(5)];
    let (w, h) = (i64::from(SIZE.0) * 256, i64::from(SIZE.1) * 256);
    let middle = (rng.int(0, w), rng.int(0, h));
    let mut corner = || (middle.0 + rng.int(-reach, reach), middle.1 + rng.int(-reach, reach));
    let (a, b, mut c) = (corner(), corner(), corner());
    if rng.one_in(4) {
        let k = rng.int(0, 256);
        let on = |p: i64, q: i64| p + (q - p) * k / 256;
        let off = rng.int(1, 300);
        c = (on(a.0, b.0) + rng.int(-off, off), on(a.1, b.1) + rng.int(-off, off));
    }
    [a, b, c]
}
