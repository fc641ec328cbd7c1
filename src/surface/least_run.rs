//! A DrawTarget with a chosen way to take lines.

use super::target::Surface;
use crate::raster::Span;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A DrawTarget whose [`LEAST_RUN`](Surface::LEAST_RUN) is `PIXELS`. The library guesses from the error type whether a target is a
/// display bus; this overrides a wrong guess. The picture is equal with every number.
///
/// - `LeastRun::<_, 1>`: a display driver whose error type has no value, because the microcontroller's SPI cannot fail, as on an
///   RP2040. A line then sends one window per run of pixels. mipidsi without its feature `batch` would set a window for each
///   pixel: up to 6 times the bytes.
/// - `LeastRun::<_, 16>`: a driver that can fail, but draws into a framebuffer of its own, such as `ssd1306`'s buffered mode.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::Point};
/// use pinhole::{draw::draw_line, target::LeastRun};
/// let mut display = MockDisplay::new();
/// draw_line(Point::zero(), Point::new(5, 2), BinaryColor::On, &mut LeastRun::<_, 1>(&mut display))?;
/// display.assert_pattern(&["##    ", "  ##  ", "    ##"]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug)]
pub struct LeastRun<'d, D, const PIXELS: u16>(pub &'d mut D);

impl<D: DrawTarget, const PIXELS: u16> Surface for LeastRun<'_, D, PIXELS> {
    type Color = D::Color;
    type Error = D::Error;
    type Store = [D::Color; 0];

    const LEAST_RUN: u16 = PIXELS;

    fn area(&self) -> Rectangle {
        self.0.bounding_box()
    }

    #[inline(always)]
    fn fill(&mut self, span: Span, color: D::Color) -> Result<(), D::Error> {
        self.0.fill(span, color)
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colors: impl Iterator<Item = D::Color>) -> Result<(), D::Error> {
        self.0.fill_run(span, colors)
    }

    #[inline(always)]
    fn draw_pixels(&mut self, pixels: impl Iterator<Item = Pixel<D::Color>>) -> Result<(), D::Error> {
        self.0.draw_iter(pixels)
    }
}

defmt_format!([D, const PIXELS: u16] LeastRun<'_, D, PIXELS>, self, "target with runs of {} pixels", PIXELS);
