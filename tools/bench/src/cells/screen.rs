//! A DrawTarget as firmware has one of its own: pixels in memory, nothing of this library.

use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use embedded_graphics_core::Pixel;

/// Pixels in rows. The methods check every area and pixel against the size, as the trait asks.
pub struct Screen<'p> {
    pixels: &'p mut [Rgb565],
    size: Size,
}

impl<'p> Screen<'p> {
    /// `None` if there are fewer pixels than the size says.
    pub fn new(pixels: &'p mut [Rgb565], size: Size) -> Option<Self> {
        let count = size.width as usize * size.height as usize;
        Some(Self { pixels: pixels.get_mut(..count)?, size })
    }
}

impl OriginDimensions for Screen<'_> {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Screen<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            let (x, y) = (point.x as u32, point.y as u32); // a negative coordinate becomes a large one
            if x < self.size.width && y < self.size.height {
                if let Some(pixel) = self.pixels.get_mut((y * self.size.width + x) as usize) {
                    *pixel = color;
                }
            }
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let inside = area.intersection(&self.bounding_box());
        if inside != *area {
            // An area across the border: pixel by pixel.
            return self.draw_iter(area.points().zip(colors).map(|(point, color)| Pixel(point, color)));
        }
        let mut colors = colors.into_iter();
        let (width, stride) = (area.size.width as usize, self.size.width as usize);
        let mut from = area.top_left.y as usize * stride + area.top_left.x as usize;
        for _ in 0..area.size.height {
            if let Some(row) = self.pixels.get_mut(from..from + width) {
                for (pixel, color) in row.iter_mut().zip(&mut colors) {
                    *pixel = color;
                }
            }
            from += stride;
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Rgb565) -> Result<(), Infallible> {
        let inside = area.intersection(&self.bounding_box());
        let (width, stride) = (inside.size.width as usize, self.size.width as usize);
        let mut from = inside.top_left.y as usize * stride + inside.top_left.x as usize;
        for _ in 0..inside.size.height {
            if let Some(row) = self.pixels.get_mut(from..from + width) {
                row.fill(color);
            }
            from += stride;
        }
        Ok(())
    }
}
