//! Stands for your display, and shows nothing. Put your driver's set-up here: any DrawTarget in 16-bit colour, such as a `Display` of
//! mipidsi. The README has an example.

use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::prelude::{DrawTarget, OriginDimensions, Pixel, Size};

pub const SIZE: Size = Size::new(240, 240);

/// Stands for your HAL's peripherals, such as `stm32f4xx_hal::pac::Peripherals`.
pub struct Peripherals;

impl Peripherals {
    pub fn take() -> Option<Self> {
        Some(Self)
    }
}

pub struct Display;

impl Display {
    /// Sets the display up. An error is logged before the chip is reset.
    pub fn new(_: Peripherals) -> Result<Self, &'static str> {
        Ok(Self)
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
