//! Rows that follow each other.

use super::edge::{Edge32, Step};
use super::Span;

/// Rows that follow each other, between two sides that do not bend there and lie inside the scissor.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Trapezoid<S> {
    /// The column that the sides are counted from.
    pub(crate) x: i32,
    /// The next row.
    pub(crate) y: i32,
    /// How many: may be none, or less.
    pub(crate) rows: i32,
    /// Left and right.
    pub(crate) sides: [S; 2],
}

impl<S: Step> Trapezoid<S> {
    /// The covered pixels of the next row, from the column counted from; there may be none. Then to the row below.
    #[inline(always)]
    fn row(&mut self) -> (i32, i32) {
        let [left, right] = &mut self.sides;
        (left.next(), right.next())
    }

    /// Calls `row` with each row's base index and ends; returns the base index below the last row.
    #[inline(always)]
    pub(crate) fn each(
        mut self,
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

    /// The next row that has pixels.
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

impl Trapezoid<Edge32> {
    /// Its column and how many pixels it has, if it is a rectangle of this width.
    #[inline(always)]
    pub(crate) fn upright(&self, width: i32) -> Option<(i32, i32)> {
        let [left, right] = &self.sides;
        let is_upright = right.first() - left.first() == width && left.is_vertical() && right.is_vertical();
        is_upright.then(|| (left.first(), width.wrapping_mul(self.rows)))
    }

    /// Cuts it to these columns: what of a side lies outside becomes vertical, and the stretch is as long as either does.
    #[inline(always)]
    pub(crate) fn cut(&mut self, from: i32, to: i32) {
        let Self { rows, sides: [left, right], .. } = self;
        *rows = cut(left, from, *rows, false);
        *rows = cut(right, to, *rows, true);
    }
}

/// Of so many rows, those in which a side lies to one side of a column, or in it, or all to the other; what lies outside becomes
/// vertical there. `right`: outside is to the right.
#[inline(never)] // once for both sides: small is better
fn cut(side: &mut Edge32, limit: i32, mut rows: i32, right: bool) -> i32 {
    let outside = |row: i32| {
        let pixel = side.pixel(row);
        if right {
            pixel > limit
        } else {
            pixel < limit
        }
    };
    let begins_outside = outside(0);
    if outside(rows - 1) != begins_outside {
        // By bisection: the first row is as at the beginning, the last one is not.
        let (mut same, mut other) = (0, rows - 1);
        while other - same > 1 {
            let middle = (same + other) >> 1;
            *(if outside(middle) == begins_outside { &mut same } else { &mut other }) = middle;
        }
        rows = other;
    }
    if begins_outside {
        *side = Edge32::vertical(limit);
    }
    rows
}
