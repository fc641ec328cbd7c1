//! The depth buffer, and the depth test.

use super::block_fill::fill_words;
use super::{each_run, inside};
use crate::math::hints::keep_rolled;
use crate::raster::{Gradient, LineDepth, LineSpans, PixelLayout, Scissor, Span};
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

    /// A depth buffer for callers that have checked the number of values, which stay.
    pub(super) const fn unchecked(area: Rectangle, values: &'a mut [u16]) -> Self {
        Self { area, values }
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

    /// All depths, the index of the depth of pixel (x, y), which lies in the area, and the stride.
    #[inline(always)]
    pub(crate) fn rows_from(&mut self, x: i32, y: i32) -> (&mut [u16], usize, usize) {
        let Rectangle { top_left, size } = self.area;
        let layout = PixelLayout::new(top_left.x, top_left.y, size.width as usize);
        (self.values, layout.at(x, y), layout.stride)
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

    /// Calls `visible` for each run of pixels of a line for which `is_seen` returns `true`. `is_seen` gets the depth of the line at a pixel,
    /// the pixel's depth in the buffer, which it may change, and the pixel's coordinates along the line's major and its minor axis. The line
    /// lies in the area.
    #[inline(always)]
    pub(crate) fn along<E>(
        &mut self,
        line: LineSpans,
        line_depth: &LineDepth,
        mut is_seen: impl FnMut(u32, &mut u16, [i32; 2]) -> bool,
        mut visible: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        let LineSpans { x, y, tall, up, step, last, minor_step, mut error, along, aside } = line;
        let mut left = last - step; // pixels after this one
        if left < 0 {
            return Ok(());
        }
        let Rectangle { top_left, size } = self.area;
        let (stride, down) = (size.width as usize, if up { -1 } else { 1 });
        let index_down = if up { stride.wrapping_neg() } else { stride };
        // How coordinates and the index change from pixel to pixel, and where the line turns aside.
        let ([mut major, mut minor], [by, by_aside], [index_by, index_aside]) = if tall {
            ([y + down * step, x + minor_step], [down, 1], [index_down, 1])
        } else {
            ([x + step, y + down * minor_step], [1, down], [1, index_down])
        };
        // No operation wraps for a pixel of the area.
        let [x, y] = if tall { [minor, major] } else { [major, minor] };
        let row = (y.wrapping_sub(top_left.y) as usize).wrapping_mul(stride);
        let mut index = row.wrapping_add(x.wrapping_sub(top_left.x) as usize);
        let [mut own, last_own, mut inner, by_depth] = line_depth.between(major, major + by * left);
        // The run of `count` pixels that ends with a pixel.
        let mut run = |count: i32, end: i32, minor: i32| {
            let first = end.min(end - by * (count - 1));
            visible(if tall {
                Span { x: minor, y: first, width: 1, height: count }
            } else {
                Span { x: first, y: minor, width: count, height: 1 }
            })
        };
        let mut count = 0;
        loop {
            let stored = self.values.get_mut(index);
            if stored.is_some_and(|stored| is_seen(LineDepth::step_of(own), stored, [major, minor])) {
                count += 1;
            } else if count > 0 {
                run(count, major - by, minor)?;
                count = 0;
            }
            if error > 0 {
                if count > 0 {
                    run(count, major, minor)?;
                    count = 0;
                }
                error += aside;
                (minor, index) = (minor + by_aside, index.wrapping_add(index_aside));
            } else {
                error += along;
            }
            left -= 1;
            inner = inner.wrapping_add(by_depth);
            own = inner;
            if left <= 0 {
                if left < 0 {
                    break;
                }
                own = last_own;
            }
            (major, index) = (major + by, index.wrapping_add(index_by));
        }
        if count > 0 {
            run(count, major, minor)?;
        }
        Ok(())
    }
}

defmt_format!([] DepthBuffer<'_>, self, "depth buffer of {} at {}", self.area.size, self.area.top_left);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{LineSetup, Pixel, ScreenPoint};
    use embedded_graphics_core::geometry::{Point, Size};

    /// The visible runs of a line are one pixel thick, and have the pixels that are seen, for lines in all directions.
    #[test]
    fn runs_of_a_line_are_its_seen_pixels() {
        let mut values = [0; 8 * 8];
        let area = Rectangle::new(Point::new(10, 20), Size::new(8, 8));
        let mut depth = DepthBuffer::new(area, &mut values).unwrap();
        // The second and the fifth of six pixels are hidden.
        let mut runs = |a: [i16; 2], b: [i16; 2]| {
            let setup = LineSetup::new(Pixel { x: a[0], y: a[1] }, Pixel { x: b[0], y: b[1] });
            let mut found = heapless::Vec::<[i32; 4], 6>::new();
            let mut seen = 0;
            let line = LineSpans::new(&setup, &Scissor::new(10, 20, 18, 28));
            let ends = [a, b].map(|[x, y]| ScreenPoint::inside(i32::from(x) * 256, i32::from(y) * 256));
            let line_depth = LineDepth::on_axis(line.tall, ends, [300, 12_000_000]);
            let is_seen = |own, stored: &mut u16, [major, _]: [i32; 2]| {
                assert_eq!(own, u32::from(line_depth.depth(major)));
                seen += 1;
                *stored = seen;
                ![2, 5].contains(&seen)
            };
            let run = |run: Span| found.push([run.x, run.y, run.width, run.height]);
            depth.along(line, &line_depth, is_seen, run).unwrap();
            let stored = depth.row(b[0].into(), b[1].into(), 1).unwrap()[0];
            assert_eq!((seen, stored), (6, if b[0] < a[0] { 1 } else { 6 }), "{a:?} {b:?}");
            found
        };
        assert_eq!(runs([11, 23], [16, 23]), [[11, 23, 1, 1], [13, 23, 2, 1], [16, 23, 1, 1]]);
        assert_eq!(runs([13, 21], [13, 26]), [[13, 21, 1, 1], [13, 23, 1, 2], [13, 26, 1, 1]]);
        // From the left end on, the line goes to the next row or column after three pixels.
        assert_eq!(
            runs([11, 23], [16, 24]),
            [[11, 23, 1, 1], [13, 23, 1, 1], [14, 24, 1, 1], [16, 24, 1, 1]]
        );
        assert_eq!(
            runs([16, 24], [11, 25]),
            [[11, 25, 1, 1], [13, 25, 1, 1], [14, 24, 1, 1], [16, 24, 1, 1]]
        );
        assert_eq!(
            runs([12, 21], [13, 26]),
            [[12, 21, 1, 1], [12, 23, 1, 1], [13, 24, 1, 1], [13, 26, 1, 1]]
        );
        assert_eq!(
            runs([12, 26], [13, 21]),
            [[12, 26, 1, 1], [12, 24, 1, 1], [13, 23, 1, 1], [13, 21, 1, 1]]
        );
        assert_eq!(runs([12, 26], [12, 21]), [[12, 26, 1, 1], [12, 23, 1, 2], [12, 21, 1, 1]]);
    }
}
