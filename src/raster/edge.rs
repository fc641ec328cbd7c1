//! Edges of triangles, walked down the screen row by row (DDA).
//!
//! For an edge from p to q, `dy > 0`, the end of the span in the n-th row of pixel centres below p is
//!
//! ```text
//!     ⌈X − ½⌉ = c + ⌈T⌉,   T = (m + n·dx) / dy,   m = ⌈(xr·dy + yr·dx) / 256⌉
//! ```
//!
//! where X is the edge's x in that row in pixels, `p.x − 128 = 256·c + xr` with xr in 0 … 255, and yr in 0 … 255 is the distance
//! from p down to the first row of centres. The numerator may be rounded up to an integer first, since
//! `⌈a/(256·b)⌉ = ⌈⌈a/256⌉/b⌉`; so T is a multiple of 1/dy. An edge walker adds up rounded numbers S instead of T, with
//!
//! ```text
//!     T − 1/dy < S ≤ T
//! ```
//!
//! No multiple of 1/dy other than T lies there, and so no integer: `⌈S⌉ = ⌈T⌉`. An [`Edge32`] stores S in 32.32, less one unit
//! of the last place: the integer part of that is ⌈S⌉ − 1, so a row costs one addition. Any stored value from T − 1/dy up to but
//! excluding T gives the same end. `fast/edge20.rs` stores S in 12.20 for triangles of few rows.

use super::ScreenPoint;
use crate::math::num::{keep_rolled, mul_wide, reciprocal, Reciprocal};

/// The first row whose centres do not lie above the point: `⌈y − ½⌉`.
#[inline(always)]
pub(crate) fn first_row(p: &ScreenPoint) -> i32 {
    (p.y + 127) >> 8
}

/// An edge of a triangle, evaluated row by row from top to bottom (DDA).
pub(crate) trait EdgeWalker {
    /// The column where the span ends in the present row; advances to the next row. An edge has one such column, which is the
    /// first pixel of the span if it is a left edge, and the pixel after the last one if it is a right edge.
    fn next(&mut self) -> i32;
}

/// c in the [module](self)'s formula: the last column whose centre does not lie to the right of the point.
#[inline(always)]
pub(crate) fn base_column(p: &ScreenPoint) -> i32 {
    (p.x - 128) >> 8
}

/// xr and yr in the [module](self)'s formula: the distances in sub-pixels from the centre of column c to the point, and from the
/// point to its first row of centres.
#[inline(always)]
pub(crate) fn distances_to_centre(p: &ScreenPoint) -> (i32, i32) {
    ((p.x - 128) & 255, 255 - ((p.y + 127) & 255))
}

/// m in the [module](self)'s formula, for an edge with differences dx and dy: |m| ≤ |dx| + dy.
#[inline(always)]
pub(crate) fn numerator((xr, yr): (i32, i32), dx: i32, dy: i32) -> i32 {
    (xr * dy + yr * dx + 255) >> 8 // two products of at most 255·2²²: below 2³¹
}

/// The quotient ⌊n / d⌋ and the remainder, by repeated subtraction. For small quotients: it takes one step per unit of the
/// quotient.
#[inline(always)]
pub(crate) fn divide_by_subtraction(n: i32, d: i32) -> (i32, i32) {
    let (mut quotient, mut remainder) = (0, n);
    while remainder < 0 {
        keep_rolled();
        (quotient, remainder) = (quotient - 1, remainder.wrapping_add(d));
    }
    while remainder >= d {
        keep_rolled();
        (quotient, remainder) = (quotient + 1, remainder.wrapping_sub(d));
    }
    (quotient, remainder)
}

/// An edge of any triangle inside the guard band, in 32.32.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Edge32 {
    /// S in the present row, less one unit of the last place.
    value: i64,
    /// The change from a row to the next.
    step: i64,
}

impl Edge32 {
    /// The number of rows for which an edge stays exact after set-up.
    ///
    /// Value and step are rounded down to multiples of 2⁻³²; a negative number that is such a multiple is lowered by one, too. S
    /// falls behind T by at most 2⁻³² at first and in each row, 960·2⁻³² in all, which is less than 1/dy ≥ 2⁻²².
    pub(crate) const MAX_ROWS: i32 = 959;

    /// The edge from `p` down to `q` at `row`, which is p's first row or below and above q's first row; so `q.y > p.y`.
    /// Columns are counted from the target's origin.
    #[inline(never)]
    pub(crate) fn new(p: &ScreenPoint, q: &ScreenPoint, row: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (column, m) = (base_column(p), numerator(distances_to_centre(p), dx, dy));
        let by_dy = LongDivision::new(dy);
        // The point lies between the columns of p and q, so |n| < 2¹⁵·dy.
        let n = i64::from(m) + mul_wide(row - first_row(p), dx);
        let value = (i64::from(column) << 32) + by_dy.divide(n) + 0xffff_ffff;
        Self { value, step: by_dy.divide(dx.into()) }
    }

    /// A vertical edge: all spans end at `column`.
    pub(crate) fn vertical(column: i32) -> Self {
        Self { value: i64::from(column) << 32, step: 0 }
    }

    /// The end of the span in the present row.
    #[inline(always)]
    pub(crate) fn column(&self) -> i32 {
        (self.value >> 32) as i32
    }

    /// Whether the spans of all rows end at the present column.
    #[inline(always)]
    pub(crate) fn is_vertical(&self) -> bool {
        self.step == 0
    }

    /// Moves the edge down by `rows` rows.
    pub(crate) fn advance(&mut self, rows: i32) {
        self.value = self.value.wrapping_add(self.step.wrapping_mul(rows.into()));
    }

    /// The end of the span `rows` rows below the present row.
    pub(crate) fn column_below(&self, rows: i32) -> i32 {
        let mut edge = *self;
        edge.advance(rows);
        edge.column()
    }
}

impl EdgeWalker for Edge32 {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let column = self.column();
        self.value = self.value.wrapping_add(self.step);
        column
    }
}

/// Divides several numbers by one divisor 0 < d ≤ 2²². Quotients are in 32.32, rounded as [`Edge32::MAX_ROWS`] says.
///
/// The reciprocal has a relative error of 2⁻²⁹, so a fraction is off by less than 9 units before it is rounded down; the
/// remainder gives the exact correction.
pub(crate) struct LongDivision {
    d: i32,
    /// 1/d = mantissa · 2^(shift − 61); shifts of 8 … 30.
    reciprocal: Reciprocal,
}

impl LongDivision {
    #[inline(always)]
    pub(crate) fn new(d: i32) -> Self {
        Self { d, reciprocal: reciprocal(d) }
    }

    /// n / d in 32.32, for |n| < 2³⁸ and |n / d| < 2²³.
    #[inline(never)]
    pub(crate) fn divide(&self, n: i64) -> i64 {
        let Self { d, reciprocal: Reciprocal { mantissa, shift } } = *self;
        let (sign, n) = (n >> 63, n.unsigned_abs());
        // The upper 31 bits of n. n has more than 31 bits only if d is large; then the dropped bits are less than d.
        let dropped = if n >> 31 == 0 { 0 } else { 7 };
        let estimate = mul_wide((n >> dropped) as i32, mantissa) >> ((61 - shift - dropped) & 63);
        let mut integer = estimate as u32; // off by less than 2
        let remainder = (n as u32).wrapping_sub(integer.wrapping_mul(d as u32)) as i32;
        let (correction, remainder) = divide_by_subtraction(remainder, d); // 0 … d − 1, and 0 if d is 1
        integer = integer.wrapping_add(correction as u32);
        let mut fraction = (mul_wide(remainder, mantissa) >> (29u32.wrapping_sub(shift) & 63)) as u32;
        // The remainder of remainder·2³² lies within ±10·d, so its lower 32 bits suffice.
        let rest = 0u32.wrapping_sub(fraction.wrapping_mul(d as u32)) as i32;
        let (correction, _) = divide_by_subtraction(rest, d);
        fraction = fraction.wrapping_add(correction as u32);
        ((i64::from(integer) << 32) | i64::from(fraction)) ^ sign
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::math::random::Random;

    /// A random edge within `width` and `height`: xr and yr, dx, dy, and the number of rows that it meets.
    pub(crate) fn edge(random: &mut Random, i: i64, width: i64, height: i64) -> ((i32, i32), i32, i32, i32) {
        let dy = if i % 3 == 0 { height as i32 } else { random.within(height - 1).abs() + 1 };
        let dx = if i % 5 == 0 { width as i32 } else { random.within(width) };
        let yr = random.within(255).abs().min(dy - 1);
        ((random.within(255).abs(), yr), dx, dy, (dy - yr - 1) / 256 + 1)
    }

    /// Asserts 0 ≤ T·dy − S·dy < 1, computed in units of 2^−digits.
    fn assert_behind(n: i64, dx: i32, dy: i32, (start, step): (i64, i64), row: i32, digits: u32) {
        let s = i128::from(start) + i128::from(step) * i128::from(row);
        let t = (i128::from(n) + i128::from(dx) * i128::from(row)) << digits;
        let behind = t - s * i128::from(dy);
        assert!((0..1 << digits).contains(&behind), "{n} {dx} / {dy}, row {row}: {behind}");
    }

    #[test]
    fn wide_steps_stay_within_a_lattice_unit() {
        let random = &mut Random(10);
        let extents = [40, 8192, 131_071, 131_072, 1 << 20, 1 << 22];
        for i in 0..30_000 {
            let extent = extents[i % 6];
            let (first, dx, dy, left) = edge(random, i as i64, extents[i / 6 % 6], extent);
            let below = random.within(i64::from(left) - 1).abs();
            let n = i64::from(numerator(first, dx, dy)) + i64::from(below) * i64::from(dx);
            let (by, left) = (LongDivision::new(dy), left - below);
            let wide = (by.divide(n), by.divide(dx.into()));
            let rows = left.min(Edge32::MAX_ROWS);
            for row in [0, 1, rows / 2, rows - 1] {
                assert_behind(n, dx, dy, wide, row.min(rows - 1), 32);
            }
        }
    }
}
