//! The depth buffer, and the depth test.

use super::block_fill::fill_words;
use super::{each_run, inside};
use crate::math::hints::keep_rolled;
use crate::raster::{Gradient, Scissor, Span};
use crate::surface::BufferError;
use bytemuck::pod_align_to_mut;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

/// A depth buffer: for each pixel of a rectangle of the target, the depth of the nearest face drawn so far. It takes 2 bytes per
/// pixel, in a caller-provided buffer. Nothing is drawn outside of it: in bands, make one for each band's
/// [area](crate::bands::Band::area).
///
/// Depth is linear on the screen, from 0 near to 65534 far; 65535 marks a pixel where nothing was drawn.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use embedded_graphics::primitives::Rectangle;
/// use pinhole::target::{BufferError, DepthBuffer};
/// let mut storage = [0; 64 * 64];
/// let area = Rectangle::new(Point::zero(), Size::new(64, 64));
/// let mut depth = DepthBuffer::new(area, &mut storage)?;
/// assert_eq!(depth.at(Point::new(63, 0)), Some(DepthBuffer::NOTHING));
/// assert_eq!(depth.at(Point::new(64, 0)), None);
/// depth.clear(); // before every frame
/// let short = DepthBuffer::new(area, &mut storage[..100]).map(|_| ());
/// assert_eq!(short, Err(BufferError::Depth { needed: 4096, given: 100 }));
/// # Ok::<(), BufferError>(())
/// ```
#[derive(Debug)]
pub struct DepthBuffer<'a> {
    area: Rectangle,
    values: &'a mut [u16],
}

impl<'a> DepthBuffer<'a> {
    /// The depth of a pixel where nothing was drawn.
    pub const NOTHING: u16 = u16::MAX;

    /// A depth buffer for the pixels of `area`, row by row in the first elements of `storage`, which it clears.
    ///
    /// # Errors
    ///
    /// [`BufferError`] when the storage has fewer elements than the area has pixels.
    pub fn new(area: Rectangle, storage: &'a mut [u16]) -> Result<Self, BufferError> {
        let needed = u64::from(area.size.width) * u64::from(area.size.height);
        let given = storage.len();
        let error = BufferError::Depth { needed, given };
        let values = usize::try_from(needed).ok().and_then(|n| storage.get_mut(..n)).ok_or(error)?;
        let mut buffer = Self { area, values };
        buffer.clear();
        Ok(buffer)
    }

    /// Sets every depth to [`NOTHING`](Self::NOTHING). Call it before each frame but the first.
    pub fn clear(&mut self) {
        let (before, words, after) = pod_align_to_mut::<u16, u32>(self.values);
        // At most one element each: a loop is smaller than a call of `memset`, and a program may need no other.
        for values in [before, after] {
            for value in values {
                keep_rolled();
                *value = Self::NOTHING;
            }
        }
        fill_words(words, u32::from(Self::NOTHING) << 16 | u32::from(Self::NOTHING));
    }

    /// The rectangle whose pixels have a depth.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The depths, row by row: 0 near … 65534 far, or [`NOTHING`](Self::NOTHING).
    pub const fn values(&self) -> &[u16] {
        self.values
    }

    /// The depth at a pixel of the target, or `None` outside the [`area`](Self::area).
    pub fn at(&self, pixel: Point) -> Option<u16> {
        let x = u32::try_from(i64::from(pixel.x) - i64::from(self.area.top_left.x)).ok()?;
        if x >= self.area.size.width {
            return None;
        }
        self.values.get(self.row_range(pixel.y)?).and_then(|row| row.get(x as usize)).copied()
    }

    pub(crate) fn scissor(&self) -> Scissor {
        inside(&self.area)
    }

    /// The indices of a row's depths.
    #[inline(always)]
    fn row_range(&self, y: i32) -> Option<core::ops::Range<usize>> {
        let row = y.wrapping_sub(self.area.top_left.y) as u32; // far too large above the area
        if row >= self.area.size.height {
            return None;
        }
        let width = self.area.size.width as usize;
        let start = (row as usize).wrapping_mul(width); // below the length: the row exists
        Some(start..start.wrapping_add(width))
    }

    /// All depths, row by row, mutable.
    #[inline(always)]
    pub(crate) fn values_mut(&mut self) -> &mut [u16] {
        self.values
    }

    /// The depths of a part of a row, which lies in the area.
    #[inline(always)]
    pub(crate) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [u16]> {
        let Rectangle { top_left, size } = self.area;
        // No operation wraps for a pixel of the area.
        let row = (y.wrapping_sub(top_left.y) as usize).wrapping_mul(size.width as usize);
        let from = row.wrapping_add(x.wrapping_sub(top_left.x) as usize);
        self.values.get_mut(from..from.wrapping_add(width as usize))
    }

    /// The depth test: stores the depth of those pixels of a span that are nearer than the depth buffer, and calls `visible` for
    /// each run of them. The span has one row and lies in the area.
    #[inline(always)]
    pub(crate) fn test<E>(
        &mut self,
        span: Span,
        gradient: &Gradient,
        visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        self.test_kept(span, gradient, || true, true, visible)
    }

    /// [`test`](Self::test) for those pixels for which `is_kept` returns `true`: it is called once for each pixel, from left to
    /// right. `writes`: whether depths are stored; a constant.
    #[inline(always)]
    pub(crate) fn test_kept<E>(
        &mut self,
        span: Span,
        gradient: &Gradient,
        mut is_kept: impl FnMut() -> bool,
        writes: bool,
        visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        let Some(row) = self.row(span.x, span.y, span.width) else { return Ok(()) };
        let (mut z, step) = (gradient.at(span.x, span.y), gradient.step());
        let is_nearer = |stored: &mut u16| {
            let depth = (z >> 16) as u16;
            z = z.wrapping_add(step);
            let is_visible = is_kept() && depth < *stored;
            keep_rolled(); // it would not be faster
            if is_visible && writes {
                *stored = depth;
            }
            is_visible
        };
        each_run(span, row.iter_mut().map(is_nearer), visible)
    }

    /// Calls `visible` for each run of pixels of a line's span for which `is_seen` returns `true`. `is_seen` gets a pixel's
    /// column, its row, and its depth in the buffer, which it may change. The span lies in the area.
    pub(crate) fn along<E>(
        &mut self,
        span: Span,
        mut is_seen: impl FnMut(i32, i32, &mut u16) -> bool,
        mut visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        let tall = span.height > 1;
        let length = span.width.max(span.height); // the other is 1
        let Rectangle { top_left, size } = self.area;
        // No operation wraps for a pixel of the area.
        let row = (span.y.wrapping_sub(top_left.y) as usize).wrapping_mul(size.width as usize);
        let mut index = row.wrapping_add(span.x.wrapping_sub(top_left.x) as usize);
        let step = if tall { size.width as usize } else { 1 };
        let mut run = |first: i32, end: i32| {
            let (by, length) = (first, end - first);
            match (length > 0, tall) {
                (false, _) => Ok(()),
                (true, true) => visible(Span { y: span.y + by, height: length, ..span }),
                (true, false) => visible(Span { x: span.x + by, width: length, ..span }),
            }
        };
        let mut first = 0;
        for i in 0..length {
            let (x, y) = if tall { (span.x, span.y + i) } else { (span.x + i, span.y) };
            if !self.values.get_mut(index).is_some_and(|stored| is_seen(x, y, stored)) {
                run(first, i)?;
                first = i + 1;
            }
            index = index.wrapping_add(step);
        }
        run(first, length)
    }
}

defmt_format!([] DepthBuffer<'_>, self, "depth buffer of {} at {}", self.area.size, self.area.top_left);

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics_core::geometry::{Point, Size};

    /// The visible runs of a line's span lie in the row or column of the span and are one pixel thick, for spans along a row and
    /// along a column.
    #[test]
    fn runs_of_a_line_are_parts_of_its_span() {
        let mut values = [0; 8 * 8];
        let area = Rectangle::new(Point::new(10, 20), Size::new(8, 8));
        let mut depth = DepthBuffer::new(area, &mut values).unwrap();
        // The second and the fifth of six pixels are hidden: runs of 1, 2 and 1 pixels.
        let mut runs = |span: Span| {
            let mut found = heapless::Vec::<Span, 6>::new();
            let mut seen = 0;
            let is_seen = |_, _, _: &mut u16| {
                seen += 1;
                ![2, 5].contains(&seen)
            };
            depth.along(span, is_seen, |run| found.push(run)).unwrap();
            found
        };
        let across = |x, width| Span { x, y: 23, width, height: 1 };
        assert_eq!(runs(across(11, 6)), [across(11, 1), across(13, 2), across(16, 1)]);
        let down = |y, height| Span { x: 13, y, width: 1, height };
        assert_eq!(runs(down(21, 6)), [down(21, 1), down(23, 2), down(26, 1)]);
    }
}
