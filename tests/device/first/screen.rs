// Stands for a board and its display.
mod picture;

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_core::Pixel;
use pinhole::Angle;

struct Screen {
    pixels: [[Rgb565; 64]; 64],
    sent: u32,
}

impl Screen {
    fn shown() -> Self {
        let mut screen = Self { pixels: [[Rgb565::MAGENTA; 64]; 64], sent: 0 };
        let Ok(()) = picture::draw(&mut screen, Angle::degrees(30));
        screen
    }
}

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        Size::new(64, 64)
    }
}

impl DrawTarget for Screen {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            self.pixels[at.y as usize][at.x as usize] = colour;
            self.sent += 1;
        }
        Ok(())
    }
}

fn print() {
    let screen = Screen::shown();
    println!("{} pixels sent", screen.sent);
    for row in screen.pixels {
        for colour in row {
            print!("{:04x} ", u32::from(colour.r()) << 11 | u32::from(colour.g()) << 5 | u32::from(colour.b()));
        }
        println!();
    }
}
