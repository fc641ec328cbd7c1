//! Triangles of few rows where a division is one instruction.
//!
//! - **Plain twin**: [`AnyTriangle`](crate::raster::AnyTriangle), and its spans, [`Triangle::spans`].
//! - **Domain**: all corners between the scissor's columns, and within the [`Divisor`]'s width and height: 32 × 30 pixels
//!   for one division per edge, 2040 × 32 pixels for the middle tier. Without `CLIP_ROWS` all corners lie inside the scissor.
//! - **Gain**: with two divisions on an M3, S3 takes 9 % fewer instructions, 4.5 % with depth; one division: not measured
//!   alone. In bands of 8 rows, a trapezoid outside the band is not set up: S3 takes 4 % fewer instructions with depth, 5 %
//!   without. A Cortex-M0 uses `BresenhamTriangle` (`bresenham_triangle.rs`) instead.
//! - **Test**: `tests/raster/memory_triangles.rs`.

use super::edge20::{Divisor, Edge20, TwoDivisions};
use super::rows::{RowOrigin, Rows};
use crate::math::hints::{keep_rolled, opaque};
use crate::raster::edge::{base_column, first_row};
use crate::raster::triangle::sort_by_y;
use crate::raster::{PixelLayout, RowScratch, Scissor, ScreenPoint, Span, Trapezoid, Triangle};
use core::marker::PhantomData;

/// A triangle of at most 32 rows as two trapezoids, above and below its middle corner. Set-up is short enough to be inlined into
/// the loops that fill memory. `CLIP_ROWS`: rows may lie above and below the scissor.
pub(crate) struct SmallTriangle<D, const CLIP_ROWS: bool> {
    /// The corners from top to bottom: the ends of the two short edges. After the upper trapezoid the two lower corners.
    ends: [ScreenPoint; 3],
    /// The next row, and the edge from the top to the bottom corner in that row.
    row: i32,
    long: Edge20,
    /// The column that the columns of edges are counted from.
    column: i32,
    middle_is_left: bool,
    /// The scissor's rows, for `CLIP_ROWS`.
    top: i32,
    bottom: i32,
    /// Chooses the [`Divisor`].
    divisor: PhantomData<D>,
}

impl<D: Divisor, const CLIP_ROWS: bool> SmallTriangle<D, CLIP_ROWS> {
    /// `None` for a triangle outside of the domain, which the module states.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor, _: &mut RowScratch) -> Option<Self> {
        if cfg!(pinhole_plain) {
            return None;
        }
        let [p, q, r] = &triangle.corners;
        // Most large triangles are tall: they are declined before the corners are sorted.
        if CLIP_ROWS && p.y.max(q.y).max(r.y) - p.y.min(q.y).min(r.y) >= D::HEIGHT {
            return None;
        }
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (ends, middle_is_left) = sort_by_y(triangle.corners, triangle.area);
        let [a, _, c] = &ends;
        // The sign bit is set if a difference is negative: one test for all comparisons. Differences are below 2²⁴. Row
        // ends lie within a column of the corners.
        let mut room = (left - (scissor.left << 8)) | ((scissor.right << 8) - right);
        room |= (D::WIDTH - 1 - (right - left)) | (D::HEIGHT - 1 - (c.y - a.y));
        if !CLIP_ROWS {
            room |= (a.y - (scissor.top << 8)) | ((scissor.bottom << 8) - c.y);
        }
        if room < 0 {
            return None;
        }
        let (row, column, long) = (first_row(a), base_column(a), Edge20::new::<D>(a, c, 0));
        Some(Self {
            ends,
            row,
            long,
            column,
            middle_is_left,
            top: scissor.top,
            bottom: scissor.bottom,
            divisor: PhantomData,
        })
    }

    /// Returns how many of the two trapezoids may have rows inside the scissor; where the scissor is a band, one of them often lies
    /// in another band. Drops the upper trapezoid if it lies above the scissor, so that its edges are not set up.
    #[inline(always)]
    fn clip_trapezoids(&mut self) -> usize {
        let [_, middle, last] = self.ends;
        let end = first_row(&middle);
        if end <= self.top {
            self.long.advance(end - self.row);
            (self.ends, self.row) = ([middle, last, last], end);
            return 1;
        }
        if end >= self.bottom {
            1
        } else {
            2
        }
    }

    /// The upper trapezoid, then the lower one; each may have no rows.
    #[inline(always)]
    fn trapezoid(&mut self) -> Trapezoid<Edge20> {
        let Self { ends: [p, q, last], row: y, long, column: origin, .. } = *self;
        let end = first_row(&q);
        let rows = end - y;
        let mut edges = [long; 2];
        if rows > 0 {
            let short = Edge20::new::<D>(&p, &q, base_column(&p) - origin);
            edges = if self.middle_is_left { [short, long] } else { [long, short] };
            self.long.advance(rows);
        }
        (self.ends, self.row) = ([q, last, last], end);
        let mut trapezoid = Trapezoid { x: origin + 1, y, rows, edges };
        if CLIP_ROWS {
            let above = (self.top - y).clamp(0, rows.max(0));
            trapezoid.y += above;
            trapezoid.rows = end.min(self.bottom) - trapezoid.y;
            let [left, right] = &mut trapezoid.edges;
            left.advance(above);
            right.advance(above);
        }
        trapezoid
    }
}

impl<D: Divisor, const CLIP_ROWS: bool> Rows for SmallTriangle<D, CLIP_ROWS> {
    const WIDTH: i32 = D::WIDTH;

    #[inline(always)]
    fn is_empty(&self) -> bool {
        let [_, _, last] = &self.ends;
        let end = first_row(last);
        match CLIP_ROWS {
            true => self.row.max(self.top) >= end.min(self.bottom),
            false => self.row >= end,
        }
    }

    #[inline(always)]
    fn start(&self, _: PixelLayout) -> RowOrigin {
        RowOrigin {
            x: self.column + 1,
            y: if CLIP_ROWS { self.row.max(self.top) } else { self.row },
            shear: 0,
        }
    }

    #[inline(always)]
    fn each(mut self, scratch: &mut RowScratch, mut row: impl FnMut(usize, i32, i32)) {
        // The lower trapezoid begins where the upper one ends.
        let RowOrigin { x, y, .. } = self.start(scratch.layout);
        let mut start = scratch.layout.at(x, y);
        // Few triangles are clipped, so code size counts: a count that the compiler does not know keeps one copy of the loop.
        for _ in 0..if CLIP_ROWS { self.clip_trapezoids() } else { 2 } {
            keep_rolled();
            start = self.trapezoid().each(start, scratch.layout.stride, &mut row);
        }
    }
}

/// The spans of a triangle of at most 32 rows: the rest of the upper trapezoid, and the lower one.
pub(crate) struct LowSpans([Trapezoid<Edge20>; 2]);

impl LowSpans {
    #[inline(always)]
    pub(crate) fn new(mut low: SmallTriangle<TwoDivisions, true>, _: RowScratch) -> Self {
        // No loop: LLVM would peel one, which takes more flash, and kept rolled it takes 40 instructions more.
        Self([low.trapezoid(), low.trapezoid()])
    }

    pub(crate) fn is_empty(&self) -> bool {
        let Self(trapezoids) = self;
        trapezoids.iter().all(|trapezoid| trapezoid.rows <= 0)
    }

    /// Calls `draw` with each span, until it returns an error.
    #[inline(always)]
    pub(crate) fn try_each<E>(&self, mut draw: impl FnMut(Span) -> Result<(), E>) -> Result<(), E> {
        let Self(trapezoids) = self;
        // The opaque count keeps LLVM from unrolling the loop into two copies of `draw`: code size counts here.
        for &trapezoid in trapezoids.iter().take(opaque(2)) {
            trapezoid.try_each_span(&mut draw)?;
        }
        Ok(())
    }

    /// The span of the next row in which the triangle covers a pixel.
    #[inline(always)]
    pub(crate) fn span(&mut self) -> Option<Span> {
        let Self([upper, lower]) = self;
        upper.span().or_else(|| lower.span())
    }
}
