//! BinnedEdges of triangles, on their way down the screen.
//!
//! For an edge from p to q, `dy > 0`, the end of a row's span is, at the n-th row of centres below p,
//!
//! ```text
//!     ⌈X − ½⌉ = c + ⌈T⌉,   T = (m + n·dx) / dy,   m = ⌈(xr·dy + yr·dx) / 256⌉
//! ```
//!
//! where `p.x − 128 = 256·c + xr`, and yr in 0 … 255 leads from p to its first row of centres: numerators on
//! the lattice 1/256 may be rounded up first, since `⌈a/(256·b)⌉ = ⌈⌈a/256⌉/b⌉`. So T lies on the lattice
//! of 1/dy. What is stepped in its place is S, with
//!
//! ```text
//!     T − 1/dy < S ≤ T
//! ```
//!
//! Between S and T there is no other point of the lattice, and so no whole number: `⌈S⌉ = ⌈T⌉`. S is in 12.20 for low
//! triangles (`side.rs`) and in 32.32 for all others ([`Edge32`]). What is kept is S less its last digit, whose integer part
//! is ⌈S⌉ − 1: a row costs one addition. Anything from T − 1/dy up to but not including T would do. Where a division is a call,
//! low triangles have a way of their own (`walk.rs`).

use super::ScreenPoint;
use crate::math::num::{keep_rolled, mul_wide, reciprocal, Reciprocal};

/// The first row whose centres are not above the point: `⌈y − ½⌉`.
#[inline(always)]
pub(crate) fn first_row(p: &ScreenPoint) -> i32 {
    (p.y + 127) >> 8
}

/// A side of a triangle, row by row.
pub(crate) trait Step {
    /// The end of the row's span; then to the next row.
    fn next(&mut self) -> i32;
}

/// c: the column whose centre is not to the right of the point, or the next.
#[inline(always)]
pub(crate) fn column(p: &ScreenPoint) -> i32 {
    (p.x - 128) >> 8
}

/// xr and yr.
#[inline(always)]
pub(crate) fn first_centre(p: &ScreenPoint) -> (i32, i32) {
    ((p.x - 128) & 255, 255 - ((p.y + 127) & 255))
}

/// m of the edge that leads by dx and dy: |m| ≤ |dx| + dy.
#[inline(always)]
pub(crate) fn numerator((xr, yr): (i32, i32), dx: i32, dy: i32) -> i32 {
    (xr * dy + yr * dx + 255) >> 8 // two products of at most 255·2²²: below 2³¹
}

/// `⌊n / d⌋` and what is left, of small quotients: counted.
#[inline(always)]
pub(crate) fn counted(n: i32, d: i32) -> (i32, i32) {
    let (mut quotient, mut rest) = (0, n);
    while rest < 0 {
        keep_rolled();
        (quotient, rest) = (quotient - 1, rest.wrapping_add(d));
    }
    while rest >= d {
        keep_rolled();
        (quotient, rest) = (quotient + 1, rest.wrapping_sub(d));
    }
    (quotient, rest)
}

/// One side of any triangle inside the guard band, in 32.32.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Edge32 {
    at: i64,
    step: i64,
}

impl Edge32 {
    /// The most rows that it may be stepped through.
    ///
    /// RowOrigin and step are rounded down to multiples of 2⁻³², or of a negative number the one below: S falls behind by at
    /// most 2⁻³² at first and in each row, 960·2⁻³² in all, where 1/dy ≥ 2⁻²².
    pub(crate) const ROWS: i32 = 959;

    /// The edge from `p` down to `q` at `row`, which lies at or below p's first row and above q's; so `q.y > p.y`. Pixels
    /// are counted from the target's origin.
    #[inline(never)]
    pub(crate) fn new(p: &ScreenPoint, q: &ScreenPoint, row: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (column, m) = (column(p), numerator(first_centre(p), dx, dy));
        let by = Long::new(dy);
        // Between the columns of p and q: |n| < 2¹⁵·dy.
        let n = i64::from(m) + mul_wide(row - first_row(p), dx);
        Self { at: (i64::from(column) << 32) + by.divide(n) + 0xffff_ffff, step: by.divide(dx.into()) }
    }

    /// A vertical one.
    pub(crate) fn vertical(column: i32) -> Self {
        Self { at: i64::from(column) << 32, step: 0 }
    }

    /// The end of the span.
    #[inline(always)]
    pub(crate) fn first(&self) -> i32 {
        (self.at >> 32) as i32
    }

    /// Whether all spans end there.
    #[inline(always)]
    pub(crate) fn is_vertical(&self) -> bool {
        self.step == 0
    }

    /// By as many rows.
    pub(crate) fn skip(&mut self, rows: i32) {
        self.at = self.at.wrapping_add(self.step.wrapping_mul(rows.into()));
    }

    /// The end of the span so many rows below.
    pub(crate) fn pixel(&self, below: i32) -> i32 {
        let mut side = *self;
        side.skip(below);
        side.first()
    }
}

impl Step for Edge32 {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let pixel = self.first();
        self.at = self.at.wrapping_add(self.step);
        pixel
    }
}

/// n / d in 32.32, rounded as above, for 0 < d ≤ 2²².
///
/// With the reciprocal's relative error of 2⁻²⁹ the fraction is off by less than 9 before it is cut: what is left of n then
/// tells by how much.
pub(crate) struct Long {
    d: i32,
    /// 1/d = mantissa · 2^(shift − 61); shifts of 8 … 30.
    by: Reciprocal,
}

impl Long {
    #[inline(always)]
    pub(crate) fn new(d: i32) -> Self {
        Self { d, by: reciprocal(d) }
    }

    /// For |n| < 2³⁸, and |n / d| < 2²³.
    #[inline(never)]
    pub(crate) fn divide(&self, n: i64) -> i64 {
        let Self { d, by: Reciprocal { mantissa, shift } } = *self;
        let (sign, n) = (n >> 63, n.unsigned_abs());
        // 31 bits of it. Those dropped are less than d: only of a large one are there so many.
        let dropped = if n >> 31 == 0 { 0 } else { 7 };
        let estimate = mul_wide((n >> dropped) as i32, mantissa) >> ((61 - shift - dropped) & 63);
        let mut whole = estimate as u32; // less than 2 off
        let rest = (n as u32).wrapping_sub(whole.wrapping_mul(d as u32)) as i32;
        let (more, rest) = counted(rest, d); // 0 … d − 1, and 0 where d is 1
        whole = whole.wrapping_add(more as u32);
        let mut fraction = (mul_wide(rest, mantissa) >> (29u32.wrapping_sub(shift) & 63)) as u32;
        // Of rest·2³²: less than 10·d either way, so 32 bits tell. It may have been rounded up to the next whole.
        let left = 0u32.wrapping_sub(fraction.wrapping_mul(d as u32)) as i32;
        let (more, _) = counted(left, d);
        fraction = fraction.wrapping_add(more as u32);
        ((i64::from(whole) << 32) | i64::from(fraction)) ^ sign
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::math::random::Random;

    /// xr and yr, dx and dy of edges within `width` and `height`, and how many rows they meet.
    pub(crate) fn edge(random: &mut Random, i: i64, width: i64, height: i64) -> ((i32, i32), i32, i32, i32) {
        let dy = if i % 3 == 0 { height as i32 } else { random.within(height - 1).abs() + 1 };
        let dx = if i % 5 == 0 { width as i32 } else { random.within(width) };
        let yr = random.within(255).abs().min(dy - 1);
        ((random.within(255).abs(), yr), dx, dy, (dy - yr - 1) / 256 + 1)
    }

    /// T·dy − S·dy, in units of 2^−digits: from 0 to one lattice unit.
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
            let (by, left) = (Long::new(dy), left - below);
            let wide = (by.divide(n), by.divide(dx.into()));
            let rows = left.min(Edge32::ROWS);
            for row in [0, 1, rows / 2, rows - 1] {
                assert_behind(n, dx, dy, wide, row.min(rows - 1), 32);
            }
        }
    }
}
