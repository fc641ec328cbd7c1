//! A picture in memory, written pixel by pixel: the reference for what a display shows.

use core::convert::Infallible;
use embedded_graphics::prelude::*;

/// A row-major picture.
#[derive(Clone, Debug)]
pub struct Framebuffer<C> {
    size: Size,
    pixels: Vec<C>,
}

impl<C: PixelColor> Framebuffer<C> {
    /// A picture of one colour.
    pub fn new(size: Size, color: C) -> Self {
        Framebuffer { size, pixels: vec![color; size.width as usize * size.height as usize] }
    }

    /// The pixels in row-major order.
    pub fn pixels(&self) -> &[C] {
        &self.pixels
    }
}

impl<C> OriginDimensions for Framebuffer<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Framebuffer<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let (width, height) = (self.size.width as usize, self.size.height as usize);
        for Pixel(point, color) in pixels {
            let (Ok(x), Ok(y)) = (usize::try_from(point.x), usize::try_from(point.y)) else { continue };
            if x < width && y < height {
                self.pixels[y * width + x] = color;
            }
        }
        Ok(())
    }
}
