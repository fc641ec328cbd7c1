//! How textures are drawn: by the library in its three accuracies, and as other libraries do it.

use super::scenes::SIDE;
use super::stepped::Stepped;
use core::convert::Infallible;
use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::prelude::*;
use pinhole::{Accuracy, MeshInstance, SpanShader, Texels, Texture};

/// The coordinates that a pixel shows, in 2⁻³² of the texture's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shown(pub(super) [u32; 2]);

impl PixelColor for Shown {
    type Raw = RawU32;
}

/// 64 × 64 texels that show their coordinates.
#[derive(Clone, Copy)]
struct Numbered;

impl Texels for Numbered {
    type Color = Shown;

    fn size_bits(&self) -> [u32; 2] {
        [6, 6]
    }

    fn texel(&self, u: u32, v: u32) -> Shown {
        Shown([u, v])
    }
}

/// The side of the texture, in texels.
pub(super) const TEXELS: f64 = 64.0;
/// The pixels of a mesh of one face with the texture coordinates of its corners.
pub(super) type Draw = fn(&MeshInstance<'_>, [[i16; 2]; 3]) -> Vec<(Point, Shown)>;

/// A way to draw: its name, its accuracy if that bounds the error, and its code.
pub(super) type Method = (&'static str, Option<f64>, Draw);

/// The library's accuracies, then the methods of other libraries.
pub(super) const METHODS: [Method; 5] = [
    ("quarter", Some(0.25), |instance, uv| ours(instance, uv, Accuracy::Quarter)),
    ("eighth", Some(0.125), |instance, uv| ours(instance, uv, Accuracy::Eighth)),
    ("sixteenth", Some(0.0625), |instance, uv| ours(instance, uv, Accuracy::Sixteenth)),
    ("each pixel", None, |instance, uv| list(instance, Stepped::<_, 1>::new(Numbered, uv))),
    ("every 16", None, |instance, uv| list(instance, Stepped::<_, 16>::new(Numbered, uv))),
];

fn ours(instance: &MeshInstance<'_>, uv: [[i16; 2]; 3], accuracy: Accuracy) -> Vec<(Point, Shown)> {
    list(instance, Texture::new(Numbered).with_accuracy(accuracy).at(uv))
}

/// A DrawTarget that lists what is drawn, in the order in which it is drawn.
struct List(Vec<(Point, Shown)>);

impl OriginDimensions for List {
    fn size(&self) -> Size {
        Size::new(SIDE, SIDE)
    }
}

impl DrawTarget for List {
    type Color = Shown;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Shown>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        self.0.extend(pixels.into_iter().map(|Pixel(point, color)| (point, color)));
        Ok(())
    }
}

fn list<S: SpanShader<Shown>>(instance: &MeshInstance<'_>, shader: S) -> Vec<(Point, Shown)> {
    let mut list = List(Vec::new());
    let Ok(_) = instance.solid(|_| shader, &mut [], &mut list);
    list.0
}
