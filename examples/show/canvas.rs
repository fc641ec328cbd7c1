//! The smallest fast `DrawTarget`: a picture in borrowed memory.

use core::convert::Infallible;
use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
    Pixel,
};

/// Pixels row by row from the top left. Rows beyond the end of the slice are not drawn.
#[derive(Debug)]
pub(crate) struct Canvas<'a, C> {
    pixels: &'a mut [C],
    size: Size,
}

impl<'a, C> Canvas<'a, C> {
    /// A canvas of `size` over `size.width * size.height` pixels.
    pub(crate) fn new(pixels: &'a mut [C], size: Size) -> Self {
        Self { pixels, size }
    }

    /// Columns `left..right` of row `y`, as far as they lie in the picture.
    fn row(&mut self, y: i32, left: i32, right: i32) -> Option<&mut [C]> {
        let y = usize::try_from(y).ok().filter(|&y| y < self.size.height as usize)?;
        let width = self.size.width as usize;
        let left = usize::try_from(left.max(0)).ok()?;
        let right = usize::try_from(right).ok()?.min(width);
        let start = y.checked_mul(width)?;
        self.pixels.get_mut(start.checked_add(left)?..start.checked_add(right)?)
    }
}

/// Eight pixels at a time, and not part of the loops that draw: it needs their registers. The hint keeps the compiler from unrolling, which costs short runs more than it saves.
#[inline(never)]
fn fill<C: Copy>(run: &mut [C], colour: C) {
    let (few, eights) = run.split_at_mut(run.len() % 8);
    for pixel in few {
        *pixel = colour;
        core::hint::black_box(());
    }
    for pixels in eights.chunks_exact_mut(8) {
        pixels.fill(colour);
        core::hint::black_box(());
    }
}

impl<C: Copy> Canvas<'_, C> {
    /// Rectangles of more than one row, and rectangles that are partly outside the picture.
    #[inline(never)]
    fn fill_rows(&mut self, top_left: Point, size: Size, colour: C) {
        let (left, top, right, bottom) = edges(&Rectangle::new(top_left, size));
        for y in top.max(0)..bottom.min(self.size.height as i32) {
            if let Some(row) = self.row(y, left, right) {
                fill(row, colour);
            }
        }
    }
}

impl<C> OriginDimensions for Canvas<'_, C> {
    fn size(&self) -> Size {
        self.size
    }
}

/// The half-open columns and rows of a rectangle, whose far edges may lie beyond `i32`.
fn edges(area: &Rectangle) -> (i32, i32, i32, i32) {
    let Point { x, y } = area.top_left;
    let (right, bottom) =
        (x.saturating_add_unsigned(area.size.width), y.saturating_add_unsigned(area.size.height));
    (x, y, right, bottom)
}

impl<C: PixelColor> DrawTarget for Canvas<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, colour) in pixels {
            if let Some([pixel]) = self.row(y, x, x.saturating_add(1)) {
                *pixel = colour;
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Infallible> {
        // To the left and above, far too large.
        let (x, y, width) = (area.top_left.x as u32, area.top_left.y as u32, area.size.width);
        if area.size.height != 1
            || y >= self.size.height
            || x > self.size.width
            || width > self.size.width - x
        {
            self.fill_rows(area.top_left, area.size, colour);
            return Ok(());
        }
        // Most rectangles are one row inside the picture, whose pixels are consecutive.
        let from = (y as usize).wrapping_mul(self.size.width as usize).wrapping_add(x as usize);
        if let Some(run) = self.pixels.get_mut(from..from.wrapping_add(width as usize)) {
            fill(run, colour);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        let (left, top, right, bottom) = edges(area);
        let mut colours = colours.into_iter();
        let inside = left >= 0 && right <= self.size.width as i32;
        for y in top..bottom {
            match self.row(y, left, right) {
                // The row first: zip must not take the next row's first colour when this row ends.
                Some(row) if inside => {
                    row.iter_mut().zip(&mut colours).for_each(|(pixel, colour)| *pixel = colour)
                }
                // Colours beside the picture are taken all the same, one by one.
                _ => self.draw_iter(
                    (left..right).zip(&mut colours).map(|(x, colour)| Pixel(Point::new(x, y), colour)),
                )?,
            }
        }
        Ok(())
    }
}
