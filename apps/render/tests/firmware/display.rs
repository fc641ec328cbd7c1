//! Stands for a display on an emulated microcontroller: prints each pixel of the first frame as it arrives, `x y colour`, and ends
//! the emulator after the last one.

use core::convert::Infallible;
use embedded_graphics_core::pixelcolor::{raw::ToBytes, Rgb565};
use embedded_graphics_core::prelude::{DrawTarget, OriginDimensions, Pixel, Size};
use semihosting::println;

pub const SIZE: Size = Size::new(96, 64);

/// Stands for your HAL's peripherals, such as `stm32f4xx_hal::pac::Peripherals`.
pub struct Peripherals;

impl Peripherals {
    pub fn take() -> Option<Self> {
        Some(Self)
    }
}

pub struct Display {
    sent: u32,
}

impl Display {
    pub fn new(_: Peripherals) -> Result<Self, &'static str> {
        Ok(Self { sent: 0 })
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
        for Pixel(at, colour) in pixels {
            println!("{} {} {}", at.x, at.y, u16::from_be_bytes(colour.to_be_bytes()));
            self.sent += 1;
            if self.sent == SIZE.width * SIZE.height {
                semihosting::process::exit(0)
            }
        }
        Ok(())
    }
}
