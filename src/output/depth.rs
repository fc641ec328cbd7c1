//! The depth buffer.

use super::inside;
use crate::math::num::CORTEX_M0;
use crate::raster::{Plane, Scissor, Span};
use bytemuck::pod_align_to_mut;
use core::hint::black_box;
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

/// The depth of what is seen so far, for the pixels of a rectangle of the target: 2 bytes each, lent
/// by the caller.
///
/// 0 is near, 65534 far, 65535 nothing; linear on the screen.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use embedded_graphics::primitives::Rectangle;
/// use pinhole::{DepthBuffer, DepthBufferError};
/// let mut storage = [0; 64 * 64];
/// let area = Rectangle::new(Point::zero(), Size::new(64, 64));
/// let mut depth = DepthBuffer::new(area, &mut storage)?;
/// assert_eq!(depth.at(Point::new(63, 0)), Some(DepthBuffer::NOTHING));
/// assert_eq!(depth.at(Point::new(64, 0)), None);
/// depth.clear(); // before every frame
/// let short = DepthBuffer::new(area, &mut storage[..100]).map(|_| ());
/// assert_eq!(short, Err(DepthBufferError { needed: 4096, given: 100 }));
/// # Ok::<(), DepthBufferError>(())
/// ```
#[derive(Debug)]
pub struct DepthBuffer<'a> {
    area: Rectangle,
    values: &'a mut [u16],
}

/// The storage of a depth buffer is too short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DepthBufferError {
    /// One number for each pixel of the area.
    pub needed: u64,
    /// What there is.
    pub given: usize,
}

impl core::fmt::Display for DepthBufferError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "a depth buffer of {} pixels has storage for {}", self.needed, self.given)
    }
}

impl core::error::Error for DepthBufferError {}

impl<'a> DepthBuffer<'a> {
    /// The depth where nothing is.
    pub const NOTHING: u16 = u16::MAX;

    /// For the pixels of `area`, row by row in the first numbers of `storage`; clears it.
    ///
    /// # Errors
    ///
    /// [`DepthBufferError`] when the storage has fewer numbers than the area has pixels.
    pub fn new(area: Rectangle, storage: &'a mut [u16]) -> Result<Self, DepthBufferError> {
        let needed = u64::from(area.size.width) * u64::from(area.size.height);
        let given = storage.len();
        let error = DepthBufferError { needed, given };
        let values = usize::try_from(needed).ok().and_then(|n| storage.get_mut(..n)).ok_or(error)?;
        let mut buffer = Self { area, values };
        buffer.clear();
        Ok(buffer)
    }

    /// Sets every depth to [`NOTHING`](Self::NOTHING), before each frame but the first.
    pub fn clear(&mut self) {
        let (before, words, after) = pod_align_to_mut::<u16, u32>(self.values);
        before.fill(Self::NOTHING);
        // In blocks that become wide stores. The hint keeps the loop from being taken for the library's
        // `memset`, which costs up to three times as much on a Cortex-M.
        let word = u32::from(Self::NOTHING) << 16 | u32::from(Self::NOTHING);
        let (blocks, rest) = words.as_chunks_mut::<64>();
        if CORTEX_M0 {
            // Copied, as one instruction there stores four words of which the compiler does not know that they are alike.
            let some = black_box([word; 16]);
            for block in blocks {
                block.as_chunks_mut().0.iter_mut().for_each(|words| *words = some);
                black_box(()); // not unrolled
            }
        } else {
            blocks.iter_mut().for_each(|block| block.fill(black_box(word)));
        }
        rest.fill(word);
        after.fill(Self::NOTHING);
    }

    /// The pixels that it holds.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// The depths, row by row.
    pub const fn values(&self) -> &[u16] {
        self.values
    }

    /// The depth at a pixel of the target, or `None` outside the [`area`](Self::area).
    pub fn at(&self, pixel: Point) -> Option<u16> {
        let x = u32::try_from(i64::from(pixel.x) - i64::from(self.area.top_left.x)).ok()?;
        if x >= self.area.size.width {
            return None;
        }
        self.values.get(self.place_of_row(pixel.y)?).and_then(|row| row.get(x as usize)).copied()
    }

    pub(crate) fn scissor(&self) -> Scissor {
        inside(&self.area)
    }

    /// Where a row of the target stands.
    #[inline(always)]
    fn place_of_row(&self, y: i32) -> Option<core::ops::Range<usize>> {
        let row = y.wrapping_sub(self.area.top_left.y) as u32; // far too large above
        if row >= self.area.size.height {
            return None;
        }
        let width = self.area.size.width as usize;
        let start = (row as usize).wrapping_mul(width); // a pixel inside has a place
        Some(start..start.wrapping_add(width))
    }

    /// All that is held, row by row.
    #[inline(always)]
    pub(super) fn held(&mut self) -> &mut [u16] {
        self.values
    }

    /// What is held in a row, which lies inside.
    #[inline(always)]
    pub(super) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [u16]> {
        let Rectangle { top_left, size } = self.area;
        // Pixels inside have places.
        let row = (y.wrapping_sub(top_left.y) as usize).wrapping_mul(size.width as usize);
        let from = row.wrapping_add(x.wrapping_sub(top_left.x) as usize);
        self.values.get_mut(from..from.wrapping_add(width as usize))
    }

    /// Keeps the span's depths where they are nearer than those held, and passes on the runs of such
    /// pixels. The span is one row inside the buffer.
    #[inline(always)]
    pub(crate) fn test<E>(
        &mut self,
        span: Span,
        plane: &Plane,
        mut visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        let Some(row) = self.row(span.x, span.y, span.width) else { return Ok(()) };
        let (mut z, step) = (plane.at(span.x, span.y), plane.step());
        let mut nearer = |held: &mut u16| {
            let depth = (z >> 16) as u16;
            z = z.wrapping_add(step);
            let nearer = depth < *held;
            core::hint::black_box(()); // not unrolled: it would not be faster
            if nearer {
                *held = depth;
            }
            nearer
        };
        let end = span.x + span.width;
        let mut pixels = row.iter_mut();
        // Both stop behind the first pixel that is otherwise.
        while pixels.any(&mut nearer) {
            let first = end - 1 - pixels.len() as i32;
            let to_the_end = pixels.all(&mut nearer);
            let width = end - pixels.len() as i32 - i32::from(!to_the_end) - first;
            visible(Span { x: first, width, ..span })?;
        }
        Ok(())
    }

    /// Passes on the runs of those pixels of a line's span that `is_seen`, given their places and the
    /// depths held there. The span lies inside the buffer.
    pub(crate) fn along<E>(
        &mut self,
        span: Span,
        mut is_seen: impl FnMut(i32, i32, &mut u16) -> bool,
        mut visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        let tall = span.height > 1;
        let length = span.width.max(span.height); // the other is 1
        let left = self.area.top_left.x;
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
            let column = x.wrapping_sub(left) as usize;
            let held = self
                .place_of_row(y)
                .and_then(|row| self.values.get_mut(row))
                .and_then(|row| row.get_mut(column));
            if !held.is_some_and(|held| is_seen(x, y, held)) {
                run(first, i)?;
                first = i + 1;
            }
        }
        run(first, length)
    }
}

/// What triangles are tested against: a depth buffer as one target has it.
#[derive(Debug)]
pub struct Against<'d, 'b> {
    pub(super) buffer: &'d mut DepthBuffer<'b>,
    /// Whether its depths stand where the pixels do, row by row: there may be more rows of either.
    pub(super) beside: bool,
}

impl<'d, 'b> Against<'d, 'b> {
    /// `pixels`: the rectangle whose pixels the target has in memory.
    pub(super) fn new(buffer: &'d mut DepthBuffer<'b>, pixels: Option<&Rectangle>) -> Self {
        let Rectangle { top_left, size } = buffer.area;
        let beside = pixels.is_some_and(|own| own.top_left == top_left && own.size.width == size.width);
        Self { buffer, beside }
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for DepthBuffer<'_> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Rectangle { top_left, size } = self.area;
        defmt::write!(f, "depth buffer of {} at {}", size, top_left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics_core::geometry::{Point, Size};

    /// The visible runs of a line's span keep the span's place across the line and its thickness of 1, whether the span
    /// runs along a row or a column.
    #[test]
    fn runs_of_a_line_are_parts_of_its_span() {
        let mut values = [0; 8 * 8];
        let area = Rectangle::new(Point::new(10, 20), Size::new(8, 8));
        let mut depth = DepthBuffer::new(area, &mut values).unwrap();
        // Of six pixels the second and the fifth are hidden: runs of 1, 2 and 1 pixels.
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
