//! Targets of every colour type, and triangles with given positions on the screen.

use embedded_graphics_core::pixelcolor::{
    BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb565, Rgb888, RgbColor,
};
use embedded_graphics_core::prelude::*;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{
    Camera, Channels, Gouraud, Mesh, MeshInstance, PixelFormat, Scalar, ShadeTable, SpanShader, StoredPixel,
    TableShader,
};
use std::convert::Infallible;
use support::bridge;
use support::bridge::pair::{CameraBits, ProjectionBits, ViewBits, ONE};
use support::oracle::coverage::P;
use support::oracle::rng::Rng;
use support::oracle::shade::{Depths, Lit};

/// A colour whose channels the tests can read.
pub(crate) trait Colour: Channels + PixelFormat + core::fmt::Debug + 'static {
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
    type Raw = ();
}

impl Channels for Own {
    const GRAY: bool = false;
    const MAX: [u8; 3] = [100, 1, 200];
    fn from_channels(levels: [u8; 3]) -> Self {
        Self(levels)
    }
}

impl PixelFormat for Own {
    const BITS: u32 = 32;
    fn encode(self) -> u32 {
        let [r, g, b] = self.0;
        u32::from_be_bytes([0xa5, b, g, r])
    }
    fn decode(bits: u32) -> Self {
        let [_, b, g, r] = bits.to_be_bytes();
        Self([r, g, b])
    }
}

impl StoredPixel<[u8; 4]> for Own {
    fn stored(self) -> [u8; 4] {
        self.encode().to_be_bytes()
    }

    fn load(bytes: [u8; 4]) -> Self {
        Self::decode(u32::from_be_bytes(bytes))
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

/// Pixels in memory, `None` where nothing was drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture<C> {
    area: Rectangle,
    pixels: Vec<Option<C>>,
}

impl<C: PixelColor> Picture<C> {
    pub(crate) fn new(area: Rectangle) -> Self {
        Picture { area, pixels: vec![None; (area.size.width * area.size.height) as usize] }
    }

    /// The drawn pixels.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = (Point, C)> + '_ {
        self.area.points().zip(&self.pixels).filter_map(|(p, &c)| Some((p, c?)))
    }

    pub(crate) fn at(&self, p: Point) -> Option<C> {
        let p = p - self.area.top_left;
        self.pixels[p.y as usize * self.area.size.width as usize + p.x as usize]
    }

    /// All pixels, drawn over a background.
    pub(crate) fn before(&self, background: C) -> Vec<C> {
        self.pixels.iter().map(|c| c.unwrap_or(background)).collect()
    }
}

impl<C: PixelColor> Dimensions for Picture<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Picture<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(p, colour) in pixels {
            assert!(self.area.contains(p), "{p:?} outside");
            let p = p - self.area.top_left;
            self.pixels[p.y as usize * self.area.size.width as usize + p.x as usize] = Some(colour);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        self.draw_iter(area.points().map(|p| Pixel(p, colour)))
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        let colours: Vec<C> = colours.into_iter().collect();
        assert_eq!(
            colours.len() as u32,
            area.size.width * area.size.height,
            "one color per pixel of the area"
        );
        self.draw_iter(area.points().zip(colours).map(|(p, c)| Pixel(p, c)))
    }
}

pub(crate) const SIZE: (u32, u32) = (64, 48);

pub(crate) fn screen() -> Rectangle {
    bridge::rectangle(0, 0, SIZE.0, SIZE.1)
}

/// A camera for which a world unit is a pixel and (0, 0) the middle of the picture.
pub(crate) fn flat_camera() -> Camera {
    let (w, h) = (SIZE.0 as i32 * ONE / 2, SIZE.1 as i32 * ONE / 2);
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([-w, w, -h, h], ONE, 9 * ONE),
        viewport: (0, 0, SIZE.0, SIZE.1),
    }
    .library()
}

/// The vertex that [`flat_camera`] projects to a position in sub-pixels.
pub(crate) fn vertex((x, y): P) -> [Scalar; 3] {
    let (w, h) = (i64::from(SIZE.0) * 128, i64::from(SIZE.1) * 128);
    let bits = |v: i64| Scalar::from_bits(i32::try_from(v << 8).expect("a scalar"));
    [bits(x - w), bits(h - y), Scalar::from_bits(-2 * ONE)]
}

/// The screen positions of the corners of face 0, which the library computes.
pub(crate) fn corners(instance: &MeshInstance<'_, Scalar>) -> Option<[P; 3]> {
    let at = |i: usize| {
        instance.project(i).ok().map(|seen| (i64::from(seen.point.x()), i64::from(seen.point.y())))
    };
    Some([at(0)?, at(1)?, at(2)?])
}

pub(crate) fn mesh<'a>(vertices: &'a [[Scalar; 3]; 3]) -> Mesh<'a, Scalar> {
    Mesh::from_fixed(vertices, &[[0, 1, 2]]).expect("a mesh")
}

pub(crate) fn draw<C: Colour, I: SpanShader<C>>(
    instance: &MeshInstance<'_, Scalar>,
    shader: I,
) -> Picture<C> {
    let mut picture = Picture::new(screen());
    let shade: &dyn Fn(usize) -> I = &|_| shader;
    let Ok(_) = instance.with_cull(pinhole::Cull::None).solid(shade, &mut [], &mut picture);
    picture
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

pub(crate) fn flat(colour: Lit) -> pinhole::Flat {
    let [r, g, b] = colour.rgb;
    pinhole::Flat::lit(Rgb888::new(r, g, b), colour.level)
}

pub(crate) fn gouraud(colours: [Lit; 3]) -> Gouraud {
    Gouraud::new(colours.map(flat))
}

/// A shader of corners that differ only in their light.
pub(crate) fn lit([a, b, c]: [Lit; 3]) -> pinhole::Lit {
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
