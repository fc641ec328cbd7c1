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
//! Between S and T there is no other point of the lattice, and so no whole number: `⌈S⌉ = ⌈T⌉`. S is in 12.20 for small
//! triangles ([`Side`]) and in 32.32 for all others ([`Wide`]). What is kept is S less its last digit, whose integer part
//! is ⌈S⌉ − 1: a row costs one addition. Anything from T − 1/dy up to but not including T would do.

use super::ScreenPoint;
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
use crate::math::num::short_reciprocal;
use crate::math::num::{keep_rolled, mul_wide, reciprocal, Reciprocal};

/// The first row whose centres are not above the point: `⌈y − ½⌉`.
#[inline(always)]
pub(super) fn first_row(p: &ScreenPoint) -> i32 {
    (p.y + 127) >> 8
}

/// A side of a triangle, row by row.
pub(crate) trait Step {
    /// The end of the row's span; then to the next row.
    fn next(&mut self) -> i32;
}

/// One side of a triangle at a row, in 12.20, wrapping: what leaves the range is not asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    at: i32,
    /// Per row.
    step: i32,
}

impl Side {
    pub(super) const NONE: Self = Self { at: 0, step: 0 };

    /// The edge from `p` down to `q` at p's first row, which lies above q's. Pixels are counted from the column `from`
    /// columns to the left of p's.
    #[inline(always)]
    pub(super) fn new<D: Divisor>(p: &ScreenPoint, q: &ScreenPoint, from: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx| < D::WIDTH, 0 < dy < D::HEIGHT
        let (start, step) = D::divide(first_centre(p), dx, dy);
        Self { at: (from << 20).wrapping_add(start), step }
    }

    /// By as many rows.
    #[inline(always)]
    pub(super) fn skip(&mut self, rows: i32) {
        self.at = self.at.wrapping_add(self.step.wrapping_mul(rows));
    }
}

impl Step for Side {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let pixel = self.at >> 20;
        self.at = self.at.wrapping_add(self.step);
        pixel
    }
}

/// c: the column whose centre is not to the right of the point, or the next.
#[inline(always)]
pub(super) fn column(p: &ScreenPoint) -> i32 {
    (p.x - 128) >> 8
}

/// xr and yr.
#[inline(always)]
fn first_centre(p: &ScreenPoint) -> (i32, i32) {
    ((p.x - 128) & 255, 255 - ((p.y + 127) & 255))
}

/// m of the edge that leads by dx and dy: |m| ≤ |dx| + dy.
#[inline(always)]
fn numerator((xr, yr): (i32, i32), dx: i32, dy: i32) -> i32 {
    (xr * dy + yr * dx + 255) >> 8 // two products of at most 255·2²²: below 2³¹
}

/// Divides what a [`Side`] is made of: to 12.20, a little rounded down.
pub(crate) trait Divisor {
    /// The corners of a triangle with these sides are less apart.
    const WIDTH: i32;
    const HEIGHT: i32;

    /// m / dy, of these xr and yr, less a digit or more, and dx / dy, where dy is positive if the edge meets a row of
    /// centres: if it meets none, digits may be lost.
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32);
}

/// In one division of 32 bits, for triangles within 32 pixels across and 30 down.
///
/// The start is in multiples of 2⁻¹⁷, of m / dy rounded to zero the one below: less than m / dy whatever its sign, by less than
/// two of them. The step is rounded down to a multiple of 2⁻¹⁸. So what is kept falls behind T by less than 2⁻¹⁶ at first and 2⁻¹⁸ in each
/// of the (dy − 1) / 256 rows that may follow, which is at most 1/dy where `dy · (4 + (dy − 1) / 256) ≤ 2¹⁸`. That of 30·256 is
/// 253 440.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
pub(crate) struct AtOnce;

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl Divisor for AtOnce {
    // These less one are constants that an instruction holds.
    const WIDTH: i32 = (255 << 5) + 1;
    const HEIGHT: i32 = (30 << 8) + 1;

    #[inline(always)]
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
        if dy <= 0 {
            return (0, 0);
        }
        // Below 2³¹: |m| < 2¹⁴, |dx| < 2¹³. Of a negative step the multiple below.
        let start = (numerator(first, dx, dy) << 17) / dy - 1;
        let step = ((dx << 18) / dy).wrapping_add(dx >> 31);
        (start << 3, step << 2)
    }
}

/// Of a wide triangle, |n| ≤ 2¹⁹, whole pixels first. Start and step are rounded to multiples of 2⁻¹⁸: S falls behind by at
/// most 2⁻¹⁸ at first and in each of the 31 rows that may follow, 2⁻¹³ in all, which is less than 1/dy.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
pub(crate) struct ByDivision;

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl Divisor for ByDivision {
    const WIDTH: i32 = 2040 << 8;
    const HEIGHT: i32 = 1 << 13;

    #[inline(always)]
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
        if dy <= 0 {
            return (0, 0);
        }
        let divide = |n: i32| {
            // Both to zero, and a negative number to the one below. The rest is less than 2¹³.
            let whole = n / dy;
            let fraction = ((n - whole * dy) << 18) / dy;
            ((whole << 18).wrapping_add(fraction).wrapping_add(n >> 31)) << 2
        };
        (divide(numerator(first, dx, dy)).wrapping_sub(1), divide(dx))
    }
}

/// For a Cortex-M0, where a division is a call, and for all triangles there that are not large.
///
/// The step is dx/dy rounded down to a multiple of 2⁻¹⁸. A reciprocal of 18 bits, never too large, leaves a quotient that is a
/// little small: what is left of dx then tells by how much.
///
/// The start follows from the step. Where m = (xr·dy + yr·dx + e) / 256, 0 ≤ e < 256,
///
/// ```text
///     m / dy = xr/256 + yr/256 · dx/dy + e/256 / dy
/// ```
///
/// in which the step stands for dx/dy and the reciprocal for 1/dy. So it is short by less than 2⁻¹⁸ for what the step is short of,
/// for rounding down the second term and the third, and 255 · 2⁻⁸ · 2⁻¹⁶·⁹ / dy for the reciprocal. With the rows that may
/// follow S falls behind by less than 1/dy where `dy · (3 + (dy − 1) / 256) + 3 < 2¹⁸`: that of 31·256 is 261 891.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) struct ByReciprocal;

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
impl Divisor for ByReciprocal {
    const WIDTH: i32 = 2040 << 8;
    const HEIGHT: i32 = (31 << 8) + 1;

    #[inline(never)] // its numbers need all registers
    fn divide(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
        if (dx.abs() + dy) >> 4 >= dy.min(1 << 10) {
            return by_long(first, dx, dy); // steep: too far off
        }
        let by = short_reciprocal(dy);
        let (sign, n) = (dx >> 31, dx.unsigned_abs());
        // n < 2¹⁴. n · 2¹⁸ / dy, below 2²²: short by less than 2⁻¹⁶·⁹ of itself, and 1.
        let mut quotient = n.wrapping_mul(by.mantissa as u32) >> ((12 - by.shift) & 31);
        // Less than 36·dy.
        let mut rest = (n << 18).wrapping_sub(quotient.wrapping_mul(dy as u32));
        while rest >= dy as u32 {
            keep_rolled();
            (quotient, rest) = (quotient.wrapping_add(1), rest.wrapping_sub(dy as u32));
        }
        let step = quotient as i32 ^ sign;
        let (xr, yr) = first;
        let e = (xr * dy + yr * dx).wrapping_neg() & 255; // as in `numerator`
                                                          // In 2⁻¹⁸: 18 bits, 8 bits of 2²², and 8 bits of the reciprocal's 18.
        let start = (xr << 10) + ((yr * step) >> 8) + ((e * by.mantissa) >> ((20 - by.shift) & 31));
        ((start << 2) - 1, step << 2)
    }
}

/// The same in wide arithmetic.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[cold]
#[inline(never)]
fn by_long(first: (i32, i32), dx: i32, dy: i32) -> (i32, i32) {
    let by = Long::new(dy);
    let [start, step] = [numerator(first, dx, dy), dx].map(|n| (by.divide(n.into()) >> 12) as i32);
    (start.wrapping_sub(1), step)
}

/// Of most triangles, and of those that are wider or cut.
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) use self::{AtOnce as Quick, ByDivision as Any};
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use self::{ByReciprocal as Quick, ByReciprocal as Any};

/// `⌊rest / d⌋` modulo 2³², for small ones.
#[inline(always)]
fn excess(mut rest: i32, d: i32) -> u32 {
    let mut excess = 0u32;
    while rest < 0 {
        keep_rolled();
        (excess, rest) = (excess.wrapping_sub(1), rest.wrapping_add(d));
    }
    while rest >= d {
        keep_rolled();
        (excess, rest) = (excess.wrapping_add(1), rest.wrapping_sub(d));
    }
    excess
}

/// One side of any triangle inside the guard band, in 32.32.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wide {
    at: i64,
    step: i64,
}

impl Wide {
    /// The most rows that it may be stepped through.
    ///
    /// Start and step are rounded down to multiples of 2⁻³², or of a negative number the one below: S falls behind by at
    /// most 2⁻³² at first and in each row, 960·2⁻³² in all, where 1/dy ≥ 2⁻²².
    pub(super) const ROWS: i32 = 959;

    /// The edge from `p` down to `q` at `row`, which lies at or below p's first row and above q's; so `q.y > p.y`. Pixels
    /// are counted from the target's origin.
    #[inline(never)]
    pub(super) fn new(p: &ScreenPoint, q: &ScreenPoint, row: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (column, m) = (column(p), numerator(first_centre(p), dx, dy));
        let by = Long::new(dy);
        // Between the columns of p and q: |n| < 2¹⁵·dy.
        let n = i64::from(m) + mul_wide(row - first_row(p), dx);
        Self { at: (i64::from(column) << 32) + by.divide(n) + 0xffff_ffff, step: by.divide(dx.into()) }
    }

    /// A vertical one.
    pub(super) fn vertical(column: i32) -> Self {
        Self { at: i64::from(column) << 32, step: 0 }
    }

    /// The end of the span.
    #[inline(always)]
    pub(super) fn first(&self) -> i32 {
        (self.at >> 32) as i32
    }

    /// Whether all spans end there.
    #[inline(always)]
    pub(super) fn is_vertical(&self) -> bool {
        self.step == 0
    }

    /// By as many rows.
    pub(super) fn skip(&mut self, rows: i32) {
        self.at = self.at.wrapping_add(self.step.wrapping_mul(rows.into()));
    }

    /// The end of the span so many rows below.
    pub(super) fn pixel(&self, below: i32) -> i32 {
        let mut side = *self;
        side.skip(below);
        side.first()
    }
}

impl Step for Wide {
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
struct Long {
    d: i32,
    /// 1/d = mantissa · 2^(shift − 61); shifts of 8 … 30.
    by: Reciprocal,
}

impl Long {
    #[inline(always)]
    fn new(d: i32) -> Self {
        Self { d, by: reciprocal(d) }
    }

    /// For |n| < 2³⁸, and |n / d| < 2²³.
    #[inline(never)]
    fn divide(&self, n: i64) -> i64 {
        let Self { d, by: Reciprocal { mantissa, shift } } = *self;
        let (sign, n) = (n >> 63, n.unsigned_abs());
        // 31 bits of it. Those dropped are less than d: only of a large one are there so many.
        let dropped = if n >> 31 == 0 { 0 } else { 7 };
        let estimate = mul_wide((n >> dropped) as i32, mantissa) >> ((61 - shift - dropped) & 63);
        let mut whole = estimate as u32; // less than 2 off
        let rest = (n as u32).wrapping_sub(whole.wrapping_mul(d as u32)) as i32;
        let more = excess(rest, d);
        whole = whole.wrapping_add(more);
        let rest = rest.wrapping_sub(more.wrapping_mul(d as u32) as i32); // 0 … d − 1, and 0 where d is 1
        let mut fraction = (mul_wide(rest, mantissa) >> (29u32.wrapping_sub(shift) & 63)) as u32;
        // Of rest·2³²: less than 10·d either way, so 32 bits tell. It may have been rounded up to the next whole.
        let left = 0u32.wrapping_sub(fraction.wrapping_mul(d as u32)) as i32;
        let more = excess(left, d);
        fraction = fraction.wrapping_add(more);
        ((i64::from(whole) << 32) | i64::from(fraction)) ^ sign
    }
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

    /// xr and yr, dx and dy of edges within `width` and `height`, and how many rows they meet.
    fn edge(random: &mut Random, i: i64, width: i64, height: i64) -> ((i32, i32), i32, i32, i32) {
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

    /// The same of a [`Side`]'s: S is a digit more, or what is kept is less than T by up to a lattice unit.
    fn assert_side_behind(m: i32, dx: i32, dy: i32, (start, step): (i32, i32), row: i32, less: bool) {
        let more =
            if less { (i64::from(start) + 1, i64::from(step)) } else { (i64::from(start), i64::from(step)) };
        // T·dy − 1/2²⁰, for less than T.
        let t = (i128::from(m) + i128::from(dx) * i128::from(row)) << 20;
        let behind = t - (i128::from(more.0) + i128::from(more.1) * i128::from(row)) * i128::from(dy);
        let within = if less { 0..1 << 20 } else { 1..(1 << 20) + 1 };
        assert!(within.contains(&behind), "{m} {dx} / {dy}, row {row}: {behind}");
    }

    /// `less`: what is asked of is S less its last digit, else it is behind T itself.
    fn assert_steps_of<D: Divisor>(less: bool) {
        let random = &mut Random(9);
        let heights = [40, 300, 4095, 4096, i64::from(D::HEIGHT) - 1];
        let widths =
            [200, 3000, 60_000, i64::from(D::WIDTH) - 1].map(|width| width.min(i64::from(D::WIDTH) - 1));
        for i in 0..60_000 {
            let (first, dx, dy, rows) = edge(random, i as i64, widths[i % 4], heights[i % 5]);
            let (start, step) = D::divide(first, dx, dy);
            let step = if dy > 256 { step } else { 0 }; // one row at most
            for row in [0, 1, rows / 2, rows - 1] {
                let (m, row) = (numerator(first, dx, dy), row.min(rows - 1));
                assert_side_behind(m, dx, dy, (start, step), row, less);
            }
        }
    }

    #[test]
    fn steps_stay_within_a_lattice_unit() {
        assert_steps_of::<AtOnce>(false);
        assert_steps_of::<ByDivision>(true);
        assert_steps_of::<ByReciprocal>(true);
    }

    /// All that small triangles ask for at the largest heights, where the least is left of a lattice unit.
    fn assert_enough_of<D: Divisor>(less: bool) {
        for dy in [D::HEIGHT - 1, D::HEIGHT - 2, 7 << 10, 4097] {
            for dx in (1 - AtOnce::WIDTH..AtOnce::WIDTH).step_by(3) {
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
                    let (start, step) = D::divide(first, dx, dy);
                    let m = numerator(first, dx, dy);
                    assert_side_behind(m, dx, dy, (start, step), last, less);
                }
            }
        }
    }

    #[test]
    fn one_division_is_enough() {
        assert_enough_of::<AtOnce>(false);
        assert_enough_of::<ByReciprocal>(true);
    }

    fn assert_ends_of<D: Divisor>() {
        let random = &mut Random(11);
        for i in 0..100_000 {
            let mut corner = |reach: i64| (random.within(reach), random.within(reach));
            let height = [40, 300, 4095, i64::from(D::HEIGHT) - 1][i % 4];
            let (p, (dx, dy)) = (corner(100_000), corner(height));
            let dx = if i % 5 == 0 { dx * 63 } else { dx }.clamp(1 - D::WIDTH, D::WIDTH - 1);
            let dy = dy.abs().max(1);
            let point = |x, y| ScreenPoint::from_subpixels(x, y).unwrap();
            let (p, q) = (point(p.0, p.1), point(p.0 + dx, p.1 + dy));
            let side = Side::new::<D>(&p, &q, 0);
            let rows = first_row(&q) - first_row(&p);
            // X − ½ in the row, in 2⁻⁸ / dy px, and its ceiling.
            for row in 0..rows {
                let below = i64::from(first_row(&p) + row) * 256 + 128 - i64::from(p.y);
                let x = (i64::from(p.x) - 128) * i64::from(dy) + below * i64::from(dx);
                let end = -(-x).div_euclid(256 * i64::from(dy));
                let at = side.at.wrapping_add(side.step.wrapping_mul(row));
                assert_eq!(i64::from(at >> 20) + 1 + i64::from(column(&p)), end, "{p:?} {q:?} {row}");
            }
        }
    }

    #[test]
    fn ends_are_exact() {
        assert_ends_of::<AtOnce>();
        assert_ends_of::<ByDivision>();
        assert_ends_of::<ByReciprocal>();
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
            let rows = left.min(Wide::ROWS);
            for row in [0, 1, rows / 2, rows - 1] {
                assert_behind(n, dx, dy, wide, row.min(rows - 1), 32);
            }
        }
    }
}
