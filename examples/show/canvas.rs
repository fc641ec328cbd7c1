//! A picture in memory, borrowed: the smallest fast `DrawTarget`.

use core::convert::Infallible;
use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Dimensions, OriginDimensions, Point, Size},
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

    /// The part of a rectangle that lies in the picture.
    #[inline(always)]
    fn part(&self, area: &Rectangle) -> Rectangle {
        let Rectangle { top_left: Point { x, y }, size } = *area;
        // To the left and above, far too large.
        let fits = |low: i32, extent: u32, all: u32| {
            let low = low as u32;
            low <= all && extent <= all - low
        };
        if fits(x, size.width, self.size.width) && fits(y, size.height, self.size.height) {
            *area
        } else {
            self.bounding_box().intersection(area)
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
        // Most are a row, and lie in the picture.
        let Rectangle { top_left, size } = self.part(area);
        let width = self.size.width as usize;
        // Pixels in the picture have places.
        let mut from = (top_left.y as usize).wrapping_mul(width).wrapping_add(top_left.x as usize);
        for _ in 0..size.height {
            let Some(row) = self.pixels.get_mut(from..from.wrapping_add(size.width as usize)) else { break };
            // Eight at a time, of known number. The hint keeps the compiler from unrolling the rest, which costs
            // short rows more than it saves.
            let mut eights = row.chunks_exact_mut(8);
            eights.by_ref().for_each(|pixels| pixels.fill(colour));
            for pixel in eights.into_remainder() {
                *pixel = colour;
                core::hint::black_box(());
            }
            from = from.wrapping_add(width);
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
