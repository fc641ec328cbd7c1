//! How textures are drawn: by the library in its three accuracies, and as other libraries do it.

use super::stepped::Stepped;
use core::convert::Infallible;
use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::prelude::*;
use pinhole::{Accuracy, MeshInstance, SpanShader, Texels, Texture};

/// The coordinates that a pixel shows, in 2⁻³² of the texture's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown(pub(crate) [u32; 2]);

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
pub(crate) const TEXELS: f64 = 64.0;

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Method {
    Ours(Accuracy),
    EveryPixel,
    EverySixteen,
}

/// In the order of the page, with their names there.
pub(crate) const METHODS: [(Method, &str); 5] = [
    (Method::Ours(Accuracy::Quarter), "`Accuracy::Quarter`"),
    (Method::Ours(Accuracy::Eighth), "`Accuracy::Eighth`"),
    (Method::Ours(Accuracy::Sixteenth), "`Accuracy::Sixteenth`"),
    (Method::EveryPixel, "a division for each pixel"),
    (Method::EverySixteen, "a division for every 16 pixels"),
];

/// A DrawTarget that lists what is drawn.
struct List(Vec<(Point, Shown)>);

impl OriginDimensions for List {
    fn size(&self) -> Size {
        Size::new(super::scenes::SIDE, super::scenes::SIDE)
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

impl Method {
    /// The pixels of a mesh of one face, in the order in which they are drawn.
    pub(crate) fn draw(self, instance: &MeshInstance<'_>, uv: [[i16; 2]; 3]) -> Vec<(Point, Shown)> {
        match self {
            Self::Ours(accuracy) => list(instance, Texture::new(Numbered).with_accuracy(accuracy).at(uv)),
            Self::EveryPixel => list(instance, Stepped::<_, 1>::new(Numbered, uv)),
            Self::EverySixteen => list(instance, Stepped::<_, 16>::new(Numbered, uv)),
        }
    }
}

fn list<S: SpanShader<Shown>>(instance: &MeshInstance<'_>, shader: S) -> Vec<(Point, Shown)> {
    let mut list = List(Vec::new());
    let Ok(_) = instance.solid(|_| shader, &mut [], &mut list);
    list.0
}
