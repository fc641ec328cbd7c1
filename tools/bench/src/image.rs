//! What the images share whose size in flash is measured. Each is a firmware of its own, and all of them hold the cube.

use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// The cube's vertices, and its faces or edges with a word of bits.
pub const CORNERS: usize = 8;
pub const RECORDS: usize = 12 + 1;

/// A display that costs next to nothing: a driver's code is not the library's.
pub struct Sink;

impl OriginDimensions for Sink {
    fn size(&self) -> Size {
        black_box(Size::new(crate::scene::SIZE, crate::scene::SIZE))
    }
}

impl DrawTarget for Sink {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for pixel in pixels {
            black_box(pixel);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: Rgb565) -> Result<(), Infallible> {
        black_box((area, colour));
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        black_box(area);
        for colour in colours {
            black_box(colour);
        }
        Ok(())
    }
}
