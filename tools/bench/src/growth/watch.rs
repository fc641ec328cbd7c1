//! A target that counts what is drawn on it.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

pub(super) struct Watch {
    size: Size,
    pub(super) runs: u32,
    pub(super) pixels: u32,
}

impl Watch {
    pub(super) fn new(size: Size) -> Self {
        Self { size, runs: 0, pixels: 0 }
    }
}

impl OriginDimensions for Watch {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Watch {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        // A line: its pixels lie in the picture.
        self.pixels += pixels.into_iter().count() as u32;
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, _: Rgb565) -> Result<(), Infallible> {
        // One row of a face; where a large one is as wide as the picture, many.
        self.runs += area.size.height;
        self.pixels += area.size.width * area.size.height;
        Ok(())
    }
}
