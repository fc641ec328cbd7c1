//! Draws the model that `build.rs` imported, and prints the picture: 64 rows of a character for each pixel.

mod picture;

use embedded_graphics_core::pixelcolor::{Gray8, GrayColor};
use embedded_graphics_core::prelude::*;
use std::convert::Infallible;

fn main() {
    let mut screen = Screen([[Gray8::BLACK; 64]; 64]);
    let Ok(()) = picture::draw(&mut screen);
    for row in screen.0 {
        let shade =
            |pixel: Gray8| b" .:-=+*#%@".get(usize::from(pixel.luma() / 26)).copied().map_or('?', char::from);
        println!("{}", row.into_iter().map(shade).collect::<String>());
    }
}

/// In place of a display and its driver.
struct Screen([[Gray8; 64]; 64]);

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        Size::new(64, 64)
    }
}

impl DrawTarget for Screen {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            let row = usize::try_from(at.y).ok().and_then(|y| self.0.get_mut(y));
            if let Some(pixel) = row.and_then(|row| row.get_mut(usize::try_from(at.x).ok()?)) {
                *pixel = colour;
            }
        }
        Ok(())
    }
}
