//! What an anti-aliased line covers of the pixels around its ends.
//!
//! Lines meet in joints, such as the corners of a polygon, but a line is drawn without the others. So the shares of two lines that
//! meet must make up one line without a common computation:
//!
//! - **Which part of a pixel belongs to the line**: the weight w grows from 0 to 1 along the line, around a plane through the end and
//!   across the line: w = ½ + ¾·a, cut at 0 and 1, for a pixel whose centre lies a pixels behind the plane. Where a line goes straight
//!   on in another one, the weights of both add up to 1.
//! - **Which share is mixed**: a line that covers the area A of a pixel leaves 1 − A of the stored colour. A line to which the part w
//!   of the pixel belongs leaves (1 − A)ʷ. The colours that lines leave multiply, so two lines of one direction leave (1 − A)ʷ · (1 −
//!   A)¹⁻ʷ, which is what one line leaves: the law of Beer and Lambert for layers of one material (*Real-Time Rendering*, 4th ed.,
//!   section 14.1.2).
//!
//! The weight does not depend on the line's major axis, so it changes little between two lines that meet at a small angle.

use super::{LineArea, LineCoverage};
use crate::math::num::{leading_zeros, reciprocal};

/// 1 in areas and logarithms: 2⁻¹⁶.
const ONE: i32 = 1 << 16;

/// Half of a weight's unit, which is 1/16, in 2⁻²⁴: weights are rounded to nearest.
const HALF_WEIGHT: i32 = 1 << 19;

/// What a pixel keeps at least of the stored colour where only a part of it belongs to a line: 1/32. Without this limit, a line that
/// covers a whole pixel would leave 0ʷ = 0 of it, however small the part is that belongs to the line.
pub(super) const LEAST_LEFT: i32 = ONE / 32;

/// The weights of the pixels around the ends of an anti-aliased line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineEnds {
    /// ½ + ¾·a for the pixel in column 0 and row 0, and each of both ends, in 2⁻²⁴ with half of a weight added. Away from one end:
    /// a counts from this end into the line, and the other end is far away.
    ahead: [i32; 2],
    /// The change per column and per row, in the axes of the line: ¾/√(1 + m²) and ¾·m/√(1 + m²), negative at the line's last columns.
    step: [i32; 2],
}

impl LineEnds {
    /// The weight of a pixel of which all belongs to the line.
    pub(crate) const ALL: i32 = 16;

    /// Half of each pixel belongs to the line.
    pub(crate) const HALF: Self = Self { ahead: [(Self::ALL / 2) << 20, 0], step: [0; 2] };

    /// An edge, whose ends are in 1/256 pixel as for [`LineCoverage::new`], and the columns in which weights count at its start and
    /// at its end, between them those whose pixels all belong to the line. If the line is short, the first columns are all.
    #[inline(always)]
    pub(crate) fn new(
        ends: [[i32; 2]; 2],
        line: &LineCoverage,
        area: &LineArea,
    ) -> ([Self; 2], [LineCoverage; 3]) {
        let [a, b] = ends.map(|[x, y]| {
            let [major, minor] = if line.tall { [y, x] } else { [x, y] };
            [major, if line.rises { -minor } else { minor }]
        });
        let (from, to) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        // 1/height = mantissa · 2⁻⁴⁷, as it is 2¹⁶ … 2¹⁷ − 1.
        let along = 3 * (reciprocal(area.height).mantissa >> 17); // at most 49152
        let across = ((along as u32).wrapping_mul(area.slope as u32) >> 16) as i32;
        // Wraps; within 16 pixels of an end the sums of `weight` do not.
        let ahead = |[column, row]: [i32; 2]| {
            let part = |step: i32, end: i32| step.wrapping_mul(128_i32.wrapping_sub(end));
            part(along, column).wrapping_add(part(across, row)).wrapping_add((ONE << 7) + HALF_WEIGHT)
        };
        let step = [along << 8, across << 8];
        // Weights count while the middle of a column is less than ⅔ + m pixels from the end, and 1⅓ pixels at most.
        let reach = 172 + (area.slope >> 8).min(171);
        let columns = |end: i32| ((end - reach + 127) >> 8)..((end + reach - 128) >> 8) + 1;
        let (start, end) = (columns(from[0]), columns(to[0]));
        // The loop without weights takes longer than it saves for one column.
        if end.start - start.end < 2 {
            let parts = [start.start..end.end, end.end..end.end, end.end..end.end];
            let both = Self { ahead: [ahead(from), ahead(to)], step };
            return ([both; 2], parts.map(|columns| line.part(columns)));
        }
        // At one end, the other one is far away.
        let far = 8 << 24;
        let [start_ahead, end_ahead] = [ahead(from), ahead(to)];
        let at_start = Self { ahead: [start_ahead, start_ahead.wrapping_sub(far)], step };
        // From the end back: 16 − ⌊n/2²⁰⌋ = ⌊(17·2²⁰ − 1 − n)/2²⁰⌋.
        let end_ahead = ((17 << 20) - 1_i32).wrapping_sub(end_ahead);
        let at_end = Self { ahead: [end_ahead, end_ahead.wrapping_sub(far)], step: step.map(|step| -step) };
        let parts = [start.clone(), start.end..end.start, end];
        ([at_start, at_end], parts.map(|columns| line.part(columns)))
    }

    /// The weight of a pixel, 0 … [`ALL`](Self::ALL): which part of it belongs to the line. The pixel, by its column and row in the
    /// axes of the line, lies in the columns at an end.
    #[inline(always)]
    pub(crate) fn weight(&self, [column, row]: [i32; 2]) -> i32 {
        let by = self.step[0].wrapping_mul(column).wrapping_add(self.step[1].wrapping_mul(row));
        let [from, to] = self.ahead.map(|ahead| (ahead.wrapping_add(by) >> 20).clamp(0, Self::ALL));
        from - to // not negative: no coordinate decreases from end to end
    }

    /// The weight of a pixel at one end, in 2⁻²⁰: not [clamped](Self::weight) to 0 … [`ALL`](Self::ALL), and not rounded down. And
    /// how it changes per column and per row.
    #[inline(always)]
    pub(crate) fn of_one_end(&self, [column, row]: [i32; 2]) -> [i32; 3] {
        let [along, across] = self.step;
        let by = along.wrapping_mul(column).wrapping_add(across.wrapping_mul(row));
        [self.ahead[0].wrapping_add(by), along, across]
    }
}

/// The share of a line's colour in a pixel with this weight, 1 … 15, of which the whole line covers `area`, both shares in 2⁻¹⁶:
/// 1 − (1 − area)ʷ, within 2⁻¹⁰, where 1 − area counts as 1/32 if it is less.
#[inline(always)] // two calls, in loops
pub(crate) fn weighted_area(area: i32, weight: i32) -> i32 {
    let left = (ONE - area).max(LEAST_LEFT);
    // −log₂ in 2⁻¹⁶: at most 5.
    let shift = leading_zeros(left as u32) - 15;
    let exponent = shift * ONE - log2((left << shift) - ONE);
    // 19 + 4 bits
    let exponent = (exponent * weight) >> 4;
    // 2^−exponent, from the next larger power with a whole exponent.
    let whole = (exponent + ONE - 1) >> 16;
    ONE - ((ONE + exp2(whole * ONE - exponent)) >> whole)
}

/// log₂(1 + f) for 0 ≤ f < 1, all in 2⁻¹⁶: within 0.0015. Exact at 0 and 1.
fn log2(f: i32) -> i32 {
    f + bent(f, 27_787, -10_748)
}

/// 2^g − 1 for 0 ≤ g < 1, all in 2⁻¹⁶: within 0.0006. Exact at 0 and 1.
fn exp2(g: i32) -> i32 {
    g - bent(g, 19_988, 4_981)
}

/// x·(1 − x)·(constant + linear·x) for 0 ≤ x < 1, all in 2⁻¹⁶.
fn bent(x: i32, constant: i32, linear: i32) -> i32 {
    let x = x >> 2; // 14 bits, so that products have at most 30
    let parabola = (x * ((1 << 14) - x)) >> 14;
    (parabola * ((constant + ((linear * x) >> 14)) >> 1)) >> 13
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use crate::raster::Scissor;

    #[test]
    fn weighted_areas_are_powers_of_what_is_left() {
        let mut largest = 0.0_f64;
        for area in (0..=ONE + 8).step_by(37) {
            for weight in 1..LineEnds::ALL {
                let own = f64::from(weighted_area(area, weight)) / 65536.0;
                let left = (1.0 - f64::from(area) / 65536.0).max(1.0 / 32.0);
                let error = own - (1.0 - left.powf(f64::from(weight) / 16.0));
                largest = largest.max(error.abs());
                assert!((0.0..1.0).contains(&own));
            }
        }
        assert!(largest <= 1.0 / 1024.0 && largest > 1.0 / 2048.0, "{largest}");
    }

    /// The weights of lines that follow one another in one direction add up to those of the line from the first point to the last one.
    #[test]
    fn weights_of_a_divided_line_are_those_of_the_line() {
        let random = &mut Random(41);
        let mut partial = 0;
        for _ in 0..3_000 {
            let start = [random.within(3_000), random.within(3_000)];
            let step = [random.within(200), random.within(200)];
            let at = |i: i32| [start[0] + i * step[0], start[1] + i * step[1]];
            let weights = |from: i32, to: i32| {
                let ends = [at(from), at(to)];
                let line = LineCoverage::new(ends, 1, &Scissor::GUARD_BAND);
                let (at_ends, parts) = LineEnds::new(ends, &line, &line.area());
                move |column: i32, row: i32| match parts
                    .iter()
                    .position(|p| (p.first..p.end).contains(&column))
                {
                    Some(0) => at_ends[0].weight([column, row]),
                    Some(1) => LineEnds::ALL,
                    Some(_) => at_ends[1].weight([column, row]),
                    None => 0,
                }
            };
            let (whole, first, second) = (weights(0, 8), weights(0, 5), weights(5, 8));
            let ends = [at(0), at(8)];
            let line = LineCoverage::new(ends, 1, &Scissor::GUARD_BAND);
            for column in line.columns(&line.area()) {
                for (row, area) in (column.first..).zip(column.areas) {
                    if area == 0 {
                        continue;
                    }
                    let [whole, first, second] =
                        [whole(column.column, row), first(column.column, row), second(column.column, row)];
                    assert!((whole - first - second).abs() <= 1, "{start:?} {step:?}");
                    partial += i32::from(first > 0 && second > 0);
                }
            }
        }
        assert!(partial > 3_000, "{partial}");
    }
}
