//! The memory that other libraries draw into: this library's picture, and the DrawTarget of the variant `dt`. The count is that
//! of the memory that takes fewer instructions.

use bench::board::Clock;
use bench::cells::{count_by, count_screen_by, Counted, Frame, Picture};
use core::convert::Infallible;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, OriginDimensions, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::Pixel;

/// A frame, into any memory.
pub trait Work {
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions;
}

/// Counts a frame in both memories, and returns the smaller count.
pub fn count(clock: &mut Clock, frame: &mut Frame, work: &mut impl Work) -> Option<Counted> {
    let picture = count_by(clock, frame, &mut |picture| work.draw(&mut Framebuffer(picture)))?;
    let screen = count_screen_by(clock, frame, &mut |screen| work.draw(screen))?;
    Some(if screen.instructions < picture.instructions { screen } else { picture })
}

/// The picture, with the size that embedded-3dgfx asks for.
struct Framebuffer<'f, 'p>(&'f mut Picture<'p>);

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
