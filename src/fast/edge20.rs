//! One side of a low triangle, where a division is one instruction.

use crate::raster::edge::{first_centre, numerator, Step};
use crate::raster::ScreenPoint;

/// One side of a triangle at a row, in 12.20, wrapping: what leaves the range is not asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge20 {
    at: i32,
    /// Per row.
    step: i32,
}

impl Edge20 {
    pub(crate) const NONE: Self = Self { at: 0, step: 0 };

    /// The edge from `p` down to `q` at p's first row, which lies above q's. Pixels are counted from the column `from`
    /// columns to the left of p's.
    #[inline(always)]
    pub(crate) fn new<D: Divisor>(p: &ScreenPoint, q: &ScreenPoint, from: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx| < D::WIDTH, 0 < dy < D::HEIGHT
        let (start, step) = D::divide(first_centre(p), dx, dy);
        Self { at: (from << 20).wrapping_add(start), step }
    }

    /// By as many rows.
    #[inline(always)]
    pub(crate) fn skip(&mut self, rows: i32) {
        self.at = self.at.wrapping_add(self.step.wrapping_mul(rows));
    }
}

impl Step for Edge20 {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let pixel = self.at >> 20;
        self.at = self.at.wrapping_add(self.step);
        pixel
    }
}

/// Divides what a [`Edge20`] is made of: to 12.20, a little rounded down.
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
/// The start is `m/dy` in 2⁻¹⁷, truncated, less one: below `m/dy`, by less than two units. The step is rounded
/// down to a multiple of 2⁻¹⁸. So what is kept falls behind T by less than 2⁻¹⁶ at first and 2⁻¹⁸ in each of the
/// (dy − 1) / 256 rows that may follow, which is at most 1/dy where `dy · (4 + (dy − 1) / 256) ≤ 2¹⁸`. That of
/// 30·256 is 253 440.
pub(crate) struct AtOnce;

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

/// Of a wide triangle, |n| ≤ 2¹⁹, whole pixels first. RowOrigin and step are rounded to multiples of 2⁻¹⁸: S falls behind by at
/// most 2⁻¹⁸ at first and in each of the 31 rows that may follow, 2⁻¹³ in all, which is less than 1/dy.
pub(crate) struct ByDivision;

impl Divisor for ByDivision {
    const WIDTH: i32 = 2040 << 8;
    const HEIGHT: i32 = 1 << 13;

    #[inline(never)] // three times a triangle that is wide, cut, or not drawn into memory: small is better
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::edge::tests::edge;
    use crate::raster::edge::{column, first_row};

    /// T·dy − S·dy, in 2⁻²⁰: from 0 to one lattice unit. S is a digit more, or what is kept is less than T by up to a lattice unit.
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
    }

    /// All that small triangles ask for at the largest heights, where the least is left of a lattice unit.
    #[test]
    fn one_division_is_enough() {
        for dy in [AtOnce::HEIGHT - 1, AtOnce::HEIGHT - 2, 7 << 10, 4097] {
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
                    let (start, step) = AtOnce::divide(first, dx, dy);
                    let m = numerator(first, dx, dy);
                    assert_side_behind(m, dx, dy, (start, step), last, false);
                }
            }
        }
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
            let side = Edge20::new::<D>(&p, &q, 0);
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
    }
}
