//! The picture, with the size that embedded-3dgfx asks for.

use bench::cells::Picture;
use core::convert::Infallible;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, OriginDimensions, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::Pixel;

pub struct Framebuffer<'f, 'p>(pub &'f mut Picture<'p>);

impl OriginDimensions for Framebuffer<'_, '_> {
    fn size(&self) -> Size {
        self.0.bounding_box().size
    }
}

impl DrawTarget for Framebuffer<'_, '_> {
    type Color = Rgb565;
    type Error = Infallible;

    #[inline(always)]
    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        self.0.draw_iter(pixels)
    }

    #[inline(always)]
    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        self.0.fill_contiguous(area, colours)
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, colour: Rgb565) -> Result<(), Infallible> {
        self.0.fill_solid(area, colour)
    }
}
