//! A display that receives rectangles of pixels in wire order, as from its driver.

use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::PixelFormat;
use std::convert::Infallible;

pub(crate) struct Display {
    size: Size,
    pixels: Vec<Rgb565>,
}

impl Display {
    pub(crate) fn new(size: Size) -> Self {
        // A colour that the picture does not have, so that a pixel that is not sent shows.
        Self { size, pixels: vec![Rgb565::MAGENTA; (size.width * size.height) as usize] }
    }

    /// Sets the window and writes its bytes.
    pub(crate) fn receive(&mut self, area: &Rectangle, bytes: &[u8]) {
        let colours = bytes.chunks_exact(2).map(|b| Rgb565::decode(u16::from_be_bytes([b[0], b[1]]).into()));
        let Ok(()) = self.fill_contiguous(area, colours);
    }

    pub(crate) fn pixels(&self) -> Vec<Rgb888> {
        self.pixels.iter().map(|&c| c.into()).collect()
    }
}

impl OriginDimensions for Display {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Display {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            if self.bounding_box().contains(at) {
                self.pixels[(at.y as u32 * self.size.width + at.x as u32) as usize] = colour;
            }
        }
        Ok(())
    }
}
