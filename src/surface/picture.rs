//! A picture in memory.

use super::inside;
use super::memory::clear;
use super::pixels::Pixels;
use super::target::Target;
use crate::raster::Span;
use core::convert::Infallible;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::Pixel;

/// A whole picture in memory that is lent to it, a colour for each pixel, row by row: a DrawTarget, and by
/// [`pixels`](Self::pixels) the fastest [`Target`].
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::{fill_triangle, raster::ScreenPoint, Picture};
/// let mut frame = [Rgb565::BLACK; 32 * 24];
/// let mut picture = Picture::new(&mut frame, Size::new(32, 24))?;
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let Ok(()) = fill_triangle([corner(0, 0), corner(40, 0), corner(0, 20)], Rgb565::RED, &mut picture.pixels());
/// assert_eq!((frame[31], frame[32 * 24 - 1]), (Rgb565::RED, Rgb565::BLACK));
/// # Ok::<(), pinhole::PictureError>(())
/// ```
#[derive(Debug)]
pub struct Picture<'a, C> {
    area: Rectangle,
    cells: &'a mut [C],
}

/// The memory of a picture is too short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PictureError {
    /// A colour for each pixel.
    pub needed: u64,
    /// What there is.
    pub given: usize,
}

impl core::fmt::Display for PictureError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { needed, given } = self;
        write!(f, "a picture of {needed} pixels has memory for {given}")
    }
}

impl core::error::Error for PictureError {}

impl<'a, C: PixelColor> Picture<'a, C> {
    /// A picture of `size` in the first colours of `memory`, whose top left pixel is the origin.
    ///
    /// # Errors
    ///
    /// [`PictureError`] when there are fewer colours than pixels.
    pub fn new(memory: &'a mut [C], size: Size) -> Result<Self, PictureError> {
        let needed = u64::from(size.width) * u64::from(size.height);
        let error = PictureError { needed, given: memory.len() };
        let cells = usize::try_from(needed).ok().and_then(|n| memory.get_mut(..n)).ok_or(error)?;
        Ok(Self { area: Rectangle::new(Point::zero(), size), cells })
    }

    /// The same pixels as the fastest target.
    #[inline(always)]
    pub fn pixels(&mut self) -> Pixels<'_, C> {
        Pixels::new(self.cells, self.area)
    }

    /// What is more than a run, or not in the picture whole.
    #[inline(never)]
    fn fill_part(&mut self, area: &Rectangle, colour: C) {
        // Not by `Rectangle::intersection`, whose sums overflow.
        let both = inside(area).clipped_to(&inside(&self.area));
        let (columns, rows) = (both.columns(), both.rows());
        // Of the picture at most, which begins at 0.
        let (width, height) = (columns.end.wrapping_sub(columns.start), rows.end.wrapping_sub(rows.start));
        let Ok(()) = self.pixels().fill(Span { x: columns.start, y: rows.start, width, height }, colour);
    }

    /// The colours, row by row.
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
        for Pixel(Point { x, y }, colour) in pixels {
            // To the left and above, far too large.
            if (x as u32) < width && (y as u32) < height {
                let at = (y as usize).wrapping_mul(width as usize).wrapping_add(x as usize);
                if let Some(pixel) = self.cells.get_mut(at) {
                    *pixel = colour;
                }
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        let (Point { x, y }, Size { width, height }) = (area.top_left, area.size);
        let Size { width: columns, height: rows } = self.area.size;
        // To the left and above, far too large. Most are a run in the picture.
        if height == 1 && (y as u32) < rows && (x as u32) <= columns && width <= columns - x as u32 {
            return self.pixels().fill(Span { x, y, width: width as i32, height: 1 }, colour);
        }
        self.fill_part(area, colour);
        Ok(())
    }

    fn clear(&mut self, colour: C) -> Result<(), Infallible> {
        clear(self.cells, colour);
        Ok(())
    }
}

// Of colours nothing is said: a colour need not have a Format.
#[cfg(feature = "defmt")]
impl<C> defmt::Format for Picture<'_, C> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "picture of {}", self.area.size);
    }
}
