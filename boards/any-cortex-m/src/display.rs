//! Stands for your display, and shows nothing. Put your driver's set-up here, and return what it makes: any DrawTarget in
//! 16-bit colour, such as a `Display` of mipidsi.

use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::prelude::{DrawTarget, OriginDimensions, Pixel, Size};

pub const SIZE: Size = Size::new(240, 240);

pub struct Display;

impl Display {
    pub fn new() -> Self {
        Self
    }
}

impl OriginDimensions for Display {
    fn size(&self) -> Size {
        SIZE
    }
}

impl DrawTarget for Display {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        // So that the compiler does not leave out the drawing that nobody sees.
        pixels.into_iter().for_each(|pixel| _ = black_box(pixel));
        Ok(())
    }
}
