//! Edges of triangles, on their way down the screen.
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
//! Between S and T there is no other point of the lattice, and so no whole number: `⌈S⌉ = ⌈T⌉`. S is in 32.32, and what
//! is kept is S and one whole, less 2⁻³², whose integer part that is. A row costs one addition; the bounds at [`by_division`],
//! [`by_reciprocal`] and [`long`] say that S stays where it must.

use super::ScreenPoint;
use crate::math::num::{divide, fraction};
use core::num::NonZeroU32;

/// An edge at a row.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    x: i64,
    /// Per row.
    step: i64,
}

/// The first row whose centres are not above the point: `⌈y − ½⌉`.
#[inline(always)]
pub(super) fn first_row(p: &ScreenPoint) -> i32 {
    (p.y + 127) >> 8
}

/// In sub-pixels, 512 pixels: what 32 bits are enough for.
const SHORT: i32 = 1 << 17;

impl Edge {
    /// The most rows of a stretch. An edge is stepped through two of them, down to where the sides bend and on, and then
    /// set up anew.
    pub(super) const ROWS: i32 = 480;

    /// Becomes the edge from `p` down to `q` at `row`, which lies at or below p's first row and above
    /// q's; so `q.y > p.y`.
    #[inline(never)]
    pub(super) fn set(&mut self, p: &ScreenPoint, q: &ScreenPoint, row: i32) {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (column, xr) = ((p.x - 128) >> 8, (p.x - 128) & 255);
        let first = first_row(p);
        let yr = first * 256 + 128 - p.y; // 0 … 255
        let m = (xr * dy + yr * dx + 255) >> 8; // two products of at most 255·2²²: below 2³¹
        let below = row - first; // 0 … 2¹⁴ rows
        let d = NonZeroU32::new(dy.unsigned_abs()).unwrap_or(NonZeroU32::MIN);
        let (start, step) = if dx.abs() < SHORT && dy < SHORT {
            // |m| ≤ 2¹⁸ and below ≤ 512: the sum stays below 2²⁷.
            short(m + below * dx, dx, d)
        } else {
            long(i64::from(m) + i64::from(below) * i64::from(dx), dx, d) // < 2³⁷
        };
        *self = Self { x: (i64::from(column) << 32) + start + 0xffff_ffff, step };
    }

    /// The end of the row's span.
    #[inline(always)]
    pub(super) fn pixel(&self) -> i32 {
        (self.x >> 32) as i32
    }

    /// To the next row.
    #[inline(always)]
    pub(super) fn advance(&mut self) {
        self.x = self.x.wrapping_add(self.step);
    }
}

#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
use by_division as short;
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
use by_reciprocal as short;

/// S at a row, n / d of it, and its step, dx / d: for cores that divide.
///
/// Both are rounded down to multiples of 2^−f, or of a negative number the one below. So S falls behind by at
/// most 2^−f at first and in each row: below 32 pixels by 33·2⁻¹⁹ in all, where 1/dy > 2⁻¹³, below 512 by
/// 514·2⁻³⁰, where 1/dy > 2⁻¹⁷.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
#[inline(always)]
fn by_division(n: i32, dx: i32, d: NonZeroU32) -> (i64, i64) {
    let ratio = |n: i32| {
        let (sign, n) = (n >> 31, n.unsigned_abs());
        let (whole, rest) = (n / d, n % d);
        // Digits whose shifts keep the rest, which is below d, in 32 bits.
        let (fraction, least) = if d.get() < 1 << 13 {
            (((rest << 19) / d) << 13, 13)
        } else {
            let (digit, rest) = ((rest << 15) / d, (rest << 15) % d);
            ((digit << 17) | (((rest << 15) / d) << 2), 2)
        };
        // The complement of a negative one's magnitude, in units of 2^−f.
        let (high, low) = (whole ^ sign as u32, fraction ^ ((sign as u32) << least));
        ((u64::from(high) << 32) | u64::from(low)) as i64
    };
    (ratio(n), ratio(dx))
}

/// The same for a Cortex-M0, where a division is a call.
///
/// With the reciprocal's relative error of 2⁻²⁸ and one rounding each, the start is off by less than
/// `|m|/dy · 2⁴ + 1` and the step by less than `|dx|/dy · 2⁴ + 1`, in 2⁻³². After n ≤ 513 rows the sum is
/// off by less than `((|m| + n·|dx|) · 2⁴ + (n + 1)·dy) / dy`, where |m| ≤ 2¹⁸, n·|dx| < 2²⁶·⁰¹ and
/// (n + 1)·dy < 2²⁶·⁰¹: less than `2³⁰·² / dy`. Half a lattice unit, `2³¹ / dy`, is held back, and its own
/// rounding takes less than `(2³ + dy) / dy` of it.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline(always)]
fn by_reciprocal(n: i32, dx: i32, d: NonZeroU32) -> (i64, i64) {
    use crate::math::num::{mul_wide, reciprocal};
    let r = reciprocal(d.get() as i32); // 1/dy = mantissa · 2^(shift − 61), 13 ≤ shift ≤ 30
    let right = 30 - r.shift.min(30);
    // 1/dy in 2⁻³² is mantissa · 2^(shift − 29); products of 28 + 31 bits.
    let by_dy = |v: i32| (mul_wide(v, r.mantissa) << 1) >> (right & 31);
    let half = i64::from(r.mantissa >> right);
    (by_dy(n) - half, by_dy(dx))
}

/// The same for any edge inside the guard band, |n| < 2³⁸, by long division: they are rare.
///
/// Rounded down to multiples of 2⁻³²: S falls behind by at most 2⁻³² at first and in each row, 960 · 2⁻³² in
/// all, where 1/dy ≥ 2⁻²².
#[cold]
#[inline(never)]
fn long(n: i64, dx: i32, d: NonZeroU32) -> (i64, i64) {
    let d = d.get();
    let ratio = |n: i64| {
        let (whole, rest) = divide(n.unsigned_abs(), d);
        let magnitude = (whole << 32) | fraction(rest.into(), d.into(), 32); // |T| < 2¹⁵, |dx / dy| < 2²³
        magnitude as i64 ^ (n >> 63)
    };
    (ratio(n), ratio(i64::from(dx)))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Random(u64);

    impl Random {
        fn within(&mut self, n: i64) -> i32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((self.0 >> 33) as i64) % (2 * n + 1) - n) as i32
        }
    }

    /// `T − 1/dy < S ≤ T` in the rows that are stepped, by whole numbers.
    #[test]
    fn steps_stay_within_a_lattice_unit() {
        let random = &mut Random(9);
        let extents = [40, 300, 8191, 8192, 40_000, 131_071, 131_072, 1 << 22];
        for i in 0..40_000 {
            let extent = extents[i % 8];
            let dy = if i % 3 == 0 { extent as i32 } else { random.within(extent).abs().max(1) };
            let dx = if i % 5 == 0 { extent as i32 } else { random.within(extent) };
            let d = NonZeroU32::new(dy.unsigned_abs()).unwrap();
            let rows = (dy >> 8) + 1;
            let below = random.within(rows.into()).abs().min(rows - 1);
            let m = (random.within(255).abs() * dy + random.within(255).abs() * dx) >> 8;
            let n = i64::from(m) + i64::from(below) * i64::from(dx);
            let is_short = dx.abs() < SHORT && dy < SHORT;
            let ways = [long(n, dx, d)].into_iter();
            let short = [by_division, by_reciprocal].into_iter().take(if is_short { 2 } else { 0 });
            for (start, step) in ways.chain(short.map(|way| way(n as i32, dx, d))) {
                let last = (rows - below).min(2 * Edge::ROWS) - 1;
                for row in [0, 1, last / 2, last] {
                    let s = i128::from(start) + i128::from(step) * i128::from(row);
                    let t = (i128::from(n) + i128::from(dx) * i128::from(row)) << 32;
                    let behind = t - s * i128::from(dy); // over 2³²·dy
                    assert!((0..1 << 32).contains(&behind), "{n} {dx} / {dy}, row {row}: {behind}");
                }
            }
        }
    }
}
