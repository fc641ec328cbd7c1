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

    /// Called before each frame: feeds the watchdog that `new` has started, if it has.
    pub fn feed(&mut self) {}

    /// Called twice a second: writes the display's registers again, without a reset, for a panel that has lost its state unnoticed.
    pub fn refresh(&mut self) -> Result<(), &'static str> {
        Ok(())
    }

    /// Called after an error: resets the panel and sets it up. The next frame is sent whole. An error resets the chip.
    pub fn restart(&mut self) -> Result<(), &'static str> {
        Ok(())
    }

    /// Sends pixels in 16-bit colour into a rectangle: row by row, the high byte of each first. It does not wait for ever for the bus,
    /// or the watchdog resets the chip. An error ends the frame.
    pub fn send(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), &'static str> {
        black_box((area, pixels)); // so that the compiler does not leave out the drawing that nobody sees
        Ok(())
    }
}
