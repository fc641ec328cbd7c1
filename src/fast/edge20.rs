//! Edges of triangles of few rows in 12.20, where a division is one instruction.
//!
//! - **Plain twin**: [`Edge`](crate::raster::edge::Edge).
//! - **Domain**: edges within a [`Divisor`]'s width and height, walked over the rows of the edge only.
//! - **Gain**: a row takes two instructions for an edge in place of five, and two registers in place of five. Not measured alone;
//!   [`fast`](super) has the gain of the triangles that use it.
//! - **Test**: `edges_stay_within_a_lattice_unit` in this file, and `tests/raster/memory_triangles.rs`.
//!
//! With T of `raster/edge.rs`, a multiple of 1/dy, an edge adds up rounded numbers S with
//!
//! ```text
//!     T − 1/dy < S ≤ T
//! ```
//!
//! No multiple of 1/dy other than T lies there, and so no integer: `⌈S⌉ = ⌈T⌉`. An edge stores S less one unit of the last place:
//! the integer part of that is ⌈S⌉ − 1, so a row costs one addition. Any stored value from T − 1/dy up to but excluding T gives the
//! same end.

use crate::raster::edge::{distances_to_centre, numerator, EdgeWalker};
use crate::raster::ScreenPoint;

/// An edge: the column at which it crosses a row of pixel centres, and the change from row to row, in 12.20. The value wraps in
/// rows that the edge does not meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge20 {
    value: i32,
    /// The change from a row to the next.
    step: i32,
}

impl Edge20 {
    pub(crate) const EMPTY: Self = Self { value: 0, step: 0 };

    /// The edge from `p` down to `q`, at the [first row](crate::raster::edge::first_row) of `p`, which must lie above that of
    /// `q`. Columns are counted from `from` columns to the left of p's [base column](crate::raster::edge::base_column).
    #[inline(always)]
    pub(crate) fn new<D: Divisor>(p: &ScreenPoint, q: &ScreenPoint, from: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx| < D::WIDTH, 0 < dy < D::HEIGHT
        let (start, step) = D::divide(distances_to_centre(p), dx, dy);
        Self { value: (from << 20).wrapping_add(start), step }
    }

    /// Moves the edge down by `rows` rows.
    #[inline(always)]
    pub(crate) fn advance(&mut self, rows: i32) {
        self.value = self.value.wrapping_add(self.step.wrapping_mul(rows));
    }
}

impl EdgeWalker for Edge20 {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let column = self.value >> 20;
        self.value = self.value.wrapping_add(self.step);
        column
    }
}

/// Computes the value and step of an [`Edge20`], rounded down far enough.
pub(crate) trait Divisor {
    /// The corners of a triangle are less than this far apart, in sub-pixels.
    const WIDTH: i32;
    const HEIGHT: i32;

    /// The value and the step of an edge: m / dy less at least one unit of the last place, and dx / dy. m is the
    /// [`numerator`](crate::raster::edge::numerator) for `first`, the [distances](distances_to_centre) of the upper end to a
    /// pixel centre. An edge that meets no row of pixel centres may have dy ≤ 0; its result is not used.
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32);
}

/// One 32-bit division for the value and one for the step, for triangles of at most 32 × 30 pixels.
///
/// The value is `m/dy` in 2⁻¹⁷, truncated, less one unit: below `m/dy` by less than two units. The step is rounded
/// down to a multiple of 2⁻¹⁸. So the edge falls behind T by less than 2⁻¹⁶ at first and 2⁻¹⁸ in each of the
/// (dy − 1) / 256 rows that may follow, which is at most 1/dy if `dy · (4 + (dy − 1) / 256) ≤ 2¹⁸`: for dy = 30·256 the
/// left side is 253 440.
pub(crate) struct OneDivision;

impl Divisor for OneDivision {
    // WIDTH − 1 and HEIGHT − 1, which `SmallTriangle::new` compares with, are immediate operands of a Thumb-2 instruction.
    const WIDTH: i32 = (255 << 5) + 1;
    const HEIGHT: i32 = (30 << 8) + 1;

    #[inline(always)]
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
        if dy <= 0 {
            return (0, 0);
        }
        // Below 2³¹: |m| < 2¹⁴, |dx| < 2¹³. Division truncates, so a negative step takes one unit less.
        let start = (numerator(first, dx, dy) << 17) / dy - 1;
        let step = ((dx << 18) / dy).wrapping_add(dx >> 31);
        (start << 3, step << 2)
    }
}

/// Two 32-bit divisions for the value and two for the step, whole pixels first, for triangles of at most 2040 × 32 pixels:
/// |n| ≤ 2¹⁹. Value and step are rounded down to multiples of 2⁻¹⁸: S falls behind T by at most 2⁻¹⁸ at first and in each of
/// the 31 rows that may follow, 2⁻¹³ in all, which is less than 1/dy.
pub(crate) struct TwoDivisions;

impl Divisor for TwoDivisions {
    const WIDTH: i32 = 2040 << 8;
    const HEIGHT: i32 = 1 << 13;

    #[inline(never)] // called three times for wide or clipped triangles and for spans: code size counts
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
        if dy <= 0 {
            return (0, 0);
        }
        let divide = |n: i32| {
            // Both divisions truncate, so a negative number takes one unit less. The remainder is less than 2¹³.
            let integer = n / dy;
            let fraction = ((n - integer * dy) << 18) / dy;
            ((integer << 18).wrapping_add(fraction).wrapping_add(n >> 31)) << 2
        };
        (divide(numerator(first, dx, dy)).wrapping_sub(1), divide(dx))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::edge::tests::edge;

    /// Asserts that an edge is behind T by at most one unit of the lattice, in 2⁻²⁰ of that unit. With `less` one unit of the
    /// last place is added to the edge, and it may be equal to T; without, it must be less than T.
    fn assert_behind(m: i32, dx: i32, dy: i32, (start, step): (i32, i32), row: i32, less: bool) {
        let more =
            if less { (i64::from(start) + 1, i64::from(step)) } else { (i64::from(start), i64::from(step)) };
        let t = (i128::from(m) + i128::from(dx) * i128::from(row)) << 20;
        let behind = t - (i128::from(more.0) + i128::from(more.1) * i128::from(row)) * i128::from(dy);
        let within = if less { 0..1 << 20 } else { 1..(1 << 20) + 1 };
        assert!(within.contains(&behind), "{m} {dx} / {dy}, row {row}: {behind}");
    }

    /// Asserts that the edges of a divisor stay within a unit of [`assert_behind`] in all rows of random edges, with its `less`.
    fn assert_steps_of<D: Divisor>(less: bool) {
        let random = &mut Random(9);
        let heights = [40, 300, 4095, 4096, i64::from(D::HEIGHT) - 1];
        let widths =
            [200, 3000, 60_000, i64::from(D::WIDTH) - 1].map(|width| width.min(i64::from(D::WIDTH) - 1));
        for i in 0..60_000 {
            let (first, dx, dy, rows) = edge(random, i as i64, widths[i % 4], heights[i % 5]);
            let (start, step) = D::divide(first, dx, dy);
            let step = if dy > 256 { step } else { 0 }; // lower edges meet one row at most
            for row in [0, 1, rows / 2, rows - 1] {
                let (m, row) = (numerator(first, dx, dy), row.min(rows - 1));
                assert_behind(m, dx, dy, (start, step), row, less);
            }
        }
    }

    #[test]
    fn edges_stay_within_a_lattice_unit() {
        assert_steps_of::<OneDivision>(false);
        assert_steps_of::<TwoDivisions>(true);
    }

    /// All widths at the largest heights, where the error comes closest to a lattice unit.
    #[test]
    fn one_division_is_exact_at_the_largest_heights() {
        for dy in [OneDivision::HEIGHT - 1, OneDivision::HEIGHT - 2, 7 << 10, 4097] {
            for dx in (1 - OneDivision::WIDTH..OneDivision::WIDTH).step_by(3) {
                for first in [
                    (0, 0),
                    (255, 0),
                    (255, 1),
                    (85, 0),
                    (0, 255),
                    (255, 255),
                    (1, 127),
                    (dx & 255, dy & 255),
                ] {
                    let last = (dy - first.1 - 1) >> 8;
                    let (start, step) = OneDivision::divide(first, dx, dy);
                    let m = numerator(first, dx, dy);
                    assert_behind(m, dx, dy, (start, step), last, false);
                }
            }
        }
    }
}
