//! Stands for your display, and shows nothing. Put your driver's set-up here, and what sends pixels: the README has an example.

use core::hint::black_box;
use embedded_graphics_core::{geometry::Size, primitives::Rectangle};

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

    /// Sends pixels in 16-bit colour into a rectangle: row by row, the high byte of each first. An error ends the frame.
    pub fn send(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), &'static str> {
        black_box((area, pixels)); // so that the compiler does not leave out the drawing that nobody sees
        Ok(())
    }
}
