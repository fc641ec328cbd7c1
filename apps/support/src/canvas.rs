//! A picture in memory.

use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use std::convert::Infallible;

/// A picture in memory: a [`DrawTarget`] of any size.
pub struct Canvas<C> {
    size: Size,
    pixels: Vec<C>,
}

impl<C: Copy> Canvas<C> {
    /// A picture of one colour.
    pub fn new(size: Size, colour: C) -> Self {
        let pixels = vec![colour; size.width as usize * size.height as usize];
        Canvas { size, pixels }
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[C] {
        &self.pixels
    }

    /// A pixel, which must lie in the picture.
    pub fn pixel(&mut self, p: Point) -> &mut C {
        let index = self.index(p);
        &mut self.pixels[index]
    }

    /// Index of a pixel in the row-major buffer.
    fn index(&self, p: Point) -> usize {
        p.y as usize * self.size.width as usize + p.x as usize
    }
}

impl<C> OriginDimensions for Canvas<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Canvas<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<C>>,
    {
        let area = self.bounding_box();
        for Pixel(point, colour) in pixels {
            if area.contains(point) {
                *self.pixel(point) = colour;
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        let area = area.intersection(&self.bounding_box());
        for y in area.rows() {
            let start = self.index(Point::new(area.top_left.x, y));
            self.pixels[start..start + area.size.width as usize].fill(colour);
        }
        Ok(())
    }
}
