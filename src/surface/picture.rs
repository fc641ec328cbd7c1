//! A picture in memory.

use super::block_fill::{clear, fill};
use super::inside;
use super::pixels::Pixels;
use crate::surface::BufferError;
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A picture in a caller-provided buffer, one colour per pixel, row by row. It is a DrawTarget; its [`pixels`](Self::pixels)
/// are the fastest [`Surface`](crate::target::Surface).
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::{draw::fill_triangle, raster::ScreenPoint, target::Picture};
/// let mut frame = [Rgb565::BLACK; 32 * 24];
/// let mut picture = Picture::new(&mut frame, Size::new(32, 24))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let Ok(()) = fill_triangle([corner(0, 0), corner(40, 0), corner(0, 20)], Rgb565::RED, &mut picture.pixels());
/// assert_eq!((frame[31], frame[32 * 24 - 1]), (Rgb565::RED, Rgb565::BLACK));
/// # Ok::<(), pinhole::target::BufferError>(())
/// ```
#[derive(Debug)]
pub struct Picture<'a, C> {
    area: Rectangle,
    cells: &'a mut [C],
}

impl<'a, C: PixelColor> Picture<'a, C> {
    /// A picture of `size` in the first elements of `buffer`. Its top left pixel is (0, 0).
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the buffer has fewer elements than the picture has pixels.
    pub fn new(buffer: &'a mut [C], size: Size) -> Result<Self, BufferError> {
        let needed = u64::from(size.width) * u64::from(size.height);
        let error = BufferError::Picture { needed, given: buffer.len() };
        let cells = usize::try_from(needed).ok().and_then(|n| buffer.get_mut(..n)).ok_or(error)?;
        Ok(Self { area: Rectangle::new(Point::zero(), size), cells })
    }

    /// The picture's pixels as the fastest target.
    #[inline(always)]
    pub fn pixels(&mut self) -> Pixels<'_, C> {
        Pixels::unchecked(self.cells, self.area)
    }

    /// Fills the part of a rectangle that lies in the picture.
    #[inline(never)]
    fn fill_part(&mut self, area: &Rectangle, color: C) {
        // `Rectangle::intersection` would overflow for large rectangles.
        let both = inside(area).clipped_to(&inside(&self.area));
        let (columns, rows) = (both.columns(), both.rows());
        let width = columns.end.wrapping_sub(columns.start);
        rows.for_each(|y| self.fill_row(columns.start, y, width as u32, color));
    }

    /// Fills `width` pixels from (`x`, `y`) on, which lie in the picture.
    #[inline(always)]
    fn fill_row(&mut self, x: i32, y: i32, width: u32, color: C) {
        let from = (y as usize).wrapping_mul(self.area.size.width as usize).wrapping_add(x as usize);
        if let Some(run) = self.cells.get_mut(from..from.wrapping_add(width as usize)) {
            fill(run, color);
        }
    }

    /// The colours of all pixels, row by row.
    pub const fn colors(&self) -> &[C] {
        self.cells
    }
}

impl<C> Dimensions for Picture<'_, C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Picture<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let Size { width, height } = self.area.size;
        for Pixel(Point { x, y }, color) in pixels {
            // A negative coordinate wraps to one beyond any size.
            if (x as u32) < width && (y as u32) < height {
                let at = (y as usize).wrapping_mul(width as usize).wrapping_add(x as usize);
                if let Some(pixel) = self.cells.get_mut(at) {
                    *pixel = color;
                }
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        let (Point { x, y }, Size { width, height }) = (area.top_left, area.size);
        let Size { width: columns, height: rows } = self.area.size;
        // A negative coordinate wraps to one beyond any size. Most rectangles are a span of a triangle that lies in the picture.
        if height == 1 && (y as u32) < rows && (x as u32) <= columns && width <= columns - x as u32 {
            self.fill_row(x, y, width, color);
        } else {
            self.fill_part(area, color);
        }
        Ok(())
    }

    fn clear(&mut self, color: C) -> Result<(), Infallible> {
        clear(self.cells, color);
        Ok(())
    }
}

// The colours are not printed: they need not implement `Format`.
defmt_format!([C] Picture<'_, C>, self, "picture of {}", self.area.size);
