//! Trapezoids: consecutive rows between two edges.

use super::edge::{Edge, EdgeWalker};
use super::Span;
use crate::math::hints::{keep_rolled, opaque};

/// Consecutive rows between two straight edges that lie inside the scissor's columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trapezoid<E> {
    /// The column that the edges count from.
    pub(crate) x: i32,
    /// The next row.
    pub(crate) y: i32,
    /// The number of rows; none if zero or negative.
    pub(crate) rows: i32,
    /// The left and the right edge.
    pub(crate) edges: [E; 2],
}

impl<E: EdgeWalker> Trapezoid<E> {
    /// The ends of the next row, counted from `x`, and advances to the row below. The row is empty if `left ≥ right`.
    #[inline(always)]
    fn row(&mut self) -> (i32, i32) {
        let [left, right] = &mut self.edges;
        (left.next(), right.next())
    }

    /// Calls `row` for each row with a base index and the row's ends, counted from it, and leaves the edges at the row below. `start`
    /// is the first row's base index, and each row adds `stride`; returns the base index of the row below the last one.
    #[inline(always)]
    pub(crate) fn each(
        &mut self,
        mut start: usize,
        stride: usize,
        mut row: impl FnMut(usize, i32, i32),
    ) -> usize {
        while self.rows > 0 {
            let (left, right) = self.row();
            row(start, left, right);
            start = start.wrapping_add(stride);
            self.rows -= 1;
        }
        start
    }

    /// Calls `draw` with the span of each row that covers a pixel, until it returns an error.
    #[allow(dead_code)] // only small triangles call it, which a Cortex-M0 and `pinhole_plain` do without
    #[inline(always)]
    pub(crate) fn try_each_span<Error>(
        mut self,
        mut draw: impl FnMut(Span) -> Result<(), Error>,
    ) -> Result<(), Error> {
        while self.rows > 0 {
            let (x, y, (left, right)) = (self.x, self.y, self.row());
            self.y += 1;
            self.rows -= 1;
            if left < right {
                draw(Span { x: x + left, y, width: right - left, height: 1 })?;
            }
            keep_rolled(); // a copy for each of several rows would not be faster
        }
        Ok(())
    }

    /// The span of the next row that covers a pixel; `None` if no row is left.
    #[inline(always)]
    pub(crate) fn span(&mut self) -> Option<Span> {
        while self.rows > 0 {
            let (x, y, (left, right)) = (self.x, self.y, self.row());
            self.y += 1;
            self.rows -= 1;
            if left < right {
                return Some(Span { x: x + left, y, width: right - left, height: 1 });
            }
        }
        None
    }
}

impl Trapezoid<Edge> {
    /// A trapezoid that has no row.
    #[inline(always)]
    pub(crate) fn without_rows() -> Self {
        // A number that the compiler does not know: it would clear a trapezoid of zeros by a library function.
        Self { x: 0, y: 0, rows: opaque(0), edges: [Edge::vertical(0); 2] }
    }

    /// The first column and the number of pixels, if the trapezoid is a rectangle of this width.
    #[inline(always)]
    pub(crate) fn as_rectangle(&self, width: i32) -> Option<(i32, i32)> {
        let [left, right] = &self.edges;
        let is_rectangle =
            right.column() - left.column() == width && left.is_vertical() && right.is_vertical();
        is_rectangle.then(|| (left.column(), width.wrapping_mul(self.rows)))
    }

    /// Clips the trapezoid to columns `left` up to but excluding `right`: an edge outside of them becomes vertical at the
    /// border, and the trapezoid ends above the row where an edge crosses a border.
    #[inline(always)]
    pub(crate) fn clip_columns(&mut self, left: i32, right: i32) {
        let Self { rows, edges: [left_edge, right_edge], .. } = self;
        *rows = clip_edge(left_edge, left, *rows, false);
        *rows = clip_edge(right_edge, right, *rows, true);
    }
}

/// Clips an edge at column `limit` and returns for how many of the next `rows` rows the result holds: the edge is unchanged if
/// it stays inside the limit in these rows, and vertical at the limit if it stays outside. `right`: whether outside is to the
/// right of the limit.
#[inline(never)] // one copy for both edges: code size counts here, few triangles are clipped
fn clip_edge(edge: &mut Edge, limit: i32, rows: i32, right: bool) -> i32 {
    let first_beyond = limit + i32::from(right); // a right edge may end at the limit
    let rows = edge.rows_before(first_beyond, rows);
    if (edge.column() >= first_beyond) == right {
        *edge = Edge::vertical(limit);
    }
    rows
}
