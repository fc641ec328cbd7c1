//! The pixels that an edge between two faces crosses: which part of each lies beyond the edge, as seen from the pixel's centre.
//!
//! Along its major axis an edge goes through columns of pixels; in a column it crosses at most two pixels, as its slope is at most 1. In
//! one pixel the part below the edge is a trapezoid. Where the edge goes from pixel r to r + 1, the part of r above it and the part of
//! r + 1 below it are triangles of area x²/2m, of the height x that the edge has in the pixel and its slope m. Areas are within 2⁻¹³ pixel.

use super::{LineArea, ScreenPoint};
use crate::math::num::{mul_wide, reciprocal_called};

/// Depths along an edge are in 2⁻¹⁴ step: 30 bits and the sign.
const DEPTH_BITS: u32 = 14;

/// An edge on the screen.
#[derive(Clone, Debug)]
pub(crate) struct CrossedEdge {
    ends: [ScreenPoint; 2],
    /// Whether the major axis is y.
    pub(crate) tall: bool,
    /// The ends along the major axis in 2⁻⁸ pixel, in ascending order, and the minor coordinate and the depth, in 2⁻⁸ step, of the first.
    from: i32,
    to: i32,
    minor: i32,
    depth: i32,
    /// Whether the ends changed places.
    flipped: bool,
    /// The change of the minor coordinate per column in 2⁻³² pixel: at most 2³².
    slope: i64,
    /// The change of depth per column in 2⁻¹⁴ step: at most 2²⁹.
    climb: i32,
}

/// A pixel that an edge crosses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CrossedPixel {
    /// Along the major and the minor axis.
    pub(crate) major: i32,
    pub(crate) minor: i32,
    /// The neighbour on the other side of the edge has a minor coordinate larger by this: 1 or −1.
    pub(crate) aside: i32,
    /// The part of the pixel on the neighbour's side, in 2⁻¹⁶.
    pub(crate) share: i32,
    /// How far the pixel's centre lies beyond the edge along the minor axis, in 2⁻⁸ pixel: within ±384.
    pub(crate) offset: i32,
    /// The depth of the edge in the middle of the column, in 2⁻⁸ step.
    pub(crate) depth: i32,
}

impl CrossedEdge {
    /// The edge between two points with depths in 16.8. `None` if it has no length along its major axis.
    #[inline(always)]
    pub(crate) fn new(ends: [ScreenPoint; 2], [za, zb]: [i32; 2]) -> Option<Self> {
        let [a, b] = ends;
        let tall = (b.y - a.y).abs() > (b.x - a.x).abs();
        let along = |p: ScreenPoint| if tall { (p.y, p.x) } else { (p.x, p.y) };
        let (mut first, mut last) = ((along(a), za), (along(b), zb));
        let flipped = first.0 .0 > last.0 .0;
        if flipped {
            core::mem::swap(&mut first, &mut last);
        }
        let (((from, minor), depth), ((to, end), end_depth)) = (first, last);
        if from == to {
            return None;
        }
        // 1/(to − from) = mantissa · 2^(shift − 61), of at most 2²² and at least 1.
        let r = reciprocal_called(to - from);
        // In 2⁻³²: 23 + 31 + 2 bits, then down by 1 … 31.
        let slope = (mul_wide(end - minor, r.mantissa) << 2) >> (31 - r.shift.min(30));
        // In 2⁻¹⁴ step per pixel: 25 + 31 bits, down by 17 … 47.
        let climb = mul_wide(end_depth - depth, r.mantissa) >> (47 - r.shift.min(30));
        let climb = climb.clamp(-(1 << 29), 1 << 29) as i32;
        Some(Self { ends, tall, from, to, minor, depth, flipped, slope, climb })
    }

    /// The points that the edge lies between, in the order in which they were given.
    pub(crate) const fn ends(&self) -> &[ScreenPoint; 2] {
        &self.ends
    }

    /// Whether points whose [`area`](super::area) with the edge is `side`, not 0, have larger minor coordinates than the edge.
    #[inline(always)]
    pub(crate) fn is_high(&self, side: i64) -> bool {
        (side < 0) ^ self.flipped ^ self.tall
    }

    /// The change of depth per pixel of the minor axis, in 2⁻⁸ step, of the plane through the edge and a point with a depth in 16.8; clamped to
    /// 2²¹, which is an eighth of all depths.
    #[inline(never)] // once for each face beside an edge
    pub(crate) fn gradient(&self, point: ScreenPoint, depth: i32) -> i32 {
        let (along, aside) = if self.tall { (point.y, point.x) } else { (point.x, point.y) };
        let by = i64::from(along - self.from); // 23 bits and the sign
        let away = i64::from(aside - self.minor) - ((self.slope * by) >> 32);
        let climb = i64::from(depth - self.depth) - ((i64::from(self.climb) * by) >> DEPTH_BITS);
        // A face thinner than 2⁻⁸ pixel counts as that thick. 24 bits: points lie in the guard band.
        let r = reciprocal_called(away.unsigned_abs().clamp(1, 1 << 24) as i32);
        let climb = climb.clamp(-(1 << 30), 1 << 30) as i32;
        let gradient =
            (mul_wide(climb, r.mantissa) >> (53 - r.shift.min(30))).clamp(-(1 << 21), 1 << 21) as i32;
        if away < 0 {
            -gradient
        } else {
            gradient
        }
    }

    /// The columns that the edge crosses: from the first to the last, inclusive.
    #[inline(always)]
    pub(crate) fn columns(&self) -> (i32, i32) {
        (self.from >> 8, (self.to - 1) >> 8)
    }

    /// Of columns, those in which the edge may lie between two minor coordinates in pixels, `low` inclusive to `high` exclusive.
    #[inline(always)]
    pub(crate) fn columns_between(&self, [first, last]: [i32; 2], [low, high]: [i32; 2]) -> [i32; 2] {
        let (mut first, mut last) = (first, last);
        // Of short edges, and of flat ones, which stay in few rows, all columns are looked at. 2⁻⁶ pixel per column.
        if last - first > 8 && self.slope.unsigned_abs() >> 26 != 0 {
            // 1/|slope| in 2⁻²⁹: a mantissa of 31 bits and a shift of at most 7.
            let r = reciprocal_called((self.slope.unsigned_abs() >> 3).min(1 << 29) as i32);
            // The column of a minor coordinate, within 1: the distance has 22 bits in 2⁻⁸ pixel.
            let column = |minor: i32| {
                let away = ((minor << 8) - self.minor).clamp(-(1 << 22), 1 << 22);
                let by = mul_wide(if self.slope < 0 { -away } else { away }, r.mantissa);
                ((by >> (32 - r.shift.min(8))) as i32 + self.from) >> 8
            };
            let ends = if self.slope < 0 { [column(high), column(low)] } else { [column(low), column(high)] };
            first = first.max(ends[0] - 1);
            last = last.min(ends[1] + 1);
        }
        [first, last]
    }

    /// Calls `visit` with pixels that the edge crosses in columns of pixels, `first` to `last`. `TALL` is that of the edge. Of a tall edge, whose
    /// columns are rows of the picture, every other column is looked at, with all of its pixels; of another edge every column, with the
    /// pixel in a row of the parity of `odd`.
    #[inline(always)]
    pub(crate) fn each_pixel<const TALL: bool>(
        &self,
        [first, last]: [i32; 2],
        odd: i32,
        mut visit: impl FnMut(CrossedPixel),
    ) {
        let steep = (self.slope.unsigned_abs() >> 3).min((1 << 29) - 1) as u32;
        let areas = LineArea::new(steep);
        let start = self.from >> 8;
        // At the left border of the first column, and in its middle.
        let into = i64::from(self.from & 255);
        let mut border = (i64::from(self.minor) << 24) - ((self.slope * into) >> 8)
            + self.slope * i64::from(first - start);
        let middle = (i64::from(self.climb) * (128 - into)) >> 8;
        let mut depth = (self.depth << (DEPTH_BITS - 8))
            .wrapping_add(middle as i32)
            .wrapping_add(self.climb.wrapping_mul(first - start));
        let step = if TALL { 2 } else { 1 };
        let (slope, climb) = (self.slope, self.climb.wrapping_mul(step));
        let by = if TALL { 2 * slope } else { slope };
        // Columns in which the edge has its whole width.
        let (whole, end) = ((self.from + 255) >> 8, self.to >> 8);
        let mut column = first;
        while column <= last {
            let (mut ends, mut wide) = ([border, border + slope], 256);
            if column < whole || column >= end {
                (ends, wide) = self.part(column, border);
            }
            let [low, high] = if slope < 0 { [ends[1], ends[0]] } else { ends };
            let (row, last_row) = ((low >> 32) as i32, (high >> 32) as i32);
            let [from, to] = [low, high].map(|minor| (minor as u32 >> 16) as i32);
            let crosses = last_row != row;
            // The second pixel of the column, or the first one; then the first one, if both are visited.
            let mut second = crosses && (TALL || (last_row ^ odd) & 1 == 0);
            if TALL || second || (row ^ odd) & 1 == 0 {
                // The middle of the column relative to the first pixel, in 2⁻¹⁶ pixel.
                let middle = ((border + (slope >> 1) - (i64::from(row) << 32)) >> 16) as i32;
                loop {
                    let below = match (crosses, second) {
                        (false, _) => ((from + to) * wide) >> 9, // below 2¹⁷ · 2⁸
                        (true, false) => (wide << 8) - areas.triangle((1 << 16) - from),
                        (true, true) => areas.triangle(to),
                    };
                    let minor = row + i32::from(second);
                    let offset = ((i32::from(second) << 16) + (1 << 15) - middle) >> 8;
                    let (share, aside) = if offset < 0 { ((wide << 8) - below, 1) } else { (below, -1) };
                    let depth = depth >> (DEPTH_BITS - 8);
                    visit(CrossedPixel { major: column, minor, aside, share, offset, depth });
                    if !(TALL && second) {
                        break;
                    }
                    second = false;
                }
            }
            (border, depth, column) = (border + by, depth.wrapping_add(climb), column + step);
        }
    }

    /// The minor coordinates of the edge's ends in a column that it does not cross as a whole, in the order of columns, and how much of its
    /// width the edge takes, in 2⁻⁸. `border`: the minor coordinate at the left border.
    #[cold]
    #[inline(never)]
    fn part(&self, column: i32, border: i64) -> ([i64; 2], i32) {
        let (left, right) = (self.from.max(column << 8), self.to.min((column + 1) << 8));
        let at = |along: i32| border + ((self.slope * i64::from(along - (column << 8))) >> 8);
        ([at(left), at(right)], right - left) // 1 … 255
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// The share of a pixel beyond the edge as seen from its centre, by integrals in f64, for edges of all lengths and slopes; and no pixel
    /// is left out that an edge crosses.
    #[test]
    fn shares_are_areas() {
        let mut random = Random(3);
        let (mut largest, mut farthest) = (0.0_f64, 0.0_f64);
        for i in 0..20_000 {
            let reach = [300, 3_000, 60_000, 400_000][i % 4];
            let mut point = || [0; 2].map(|_| random.within(reach));
            let (a, b) = (point(), point());
            let ends = [a, b].map(|[x, y]| ScreenPoint::inside(x, y));
            let depths = [random.below(1 << 24) as i32, random.below(1 << 24) as i32];
            let Some(edge) = CrossedEdge::new(ends, depths) else { continue };
            let along = |p: [i32; 2]| if edge.tall { [p[1], p[0]] } else { p }.map(|v| f64::from(v) / 256.0);
            let (mut from, mut to) = ((along(a), depths[0]), (along(b), depths[1]));
            if from.0[0] > to.0[0] {
                core::mem::swap(&mut from, &mut to);
            }
            let slope = (to.0[1] - from.0[1]) / (to.0[0] - from.0[0]);
            let at = |major: f64| from.0[1] + slope * (major - from.0[0]);
            let (first, last) = edge.columns();
            let last = last.min(first + 700);
            let mut crossed = 0;
            let mut check = |pixel: CrossedPixel| {
                let column = f64::from(pixel.major);
                let (left, right) = (from.0[0].max(column), to.0[0].min(column + 1.0));
                // By Simpson's rule between the points at which the edge goes in or out of the pixel: exact for lines.
                let depth_in = |major: f64| (at(major) - f64::from(pixel.minor)).clamp(0.0, 1.0);
                let corners =
                    [0.0, 1.0].map(|v| from.0[0] + (f64::from(pixel.minor) + v - from.0[1]) / slope);
                let mut cuts = [left, right, corners[0].clamp(left, right), corners[1].clamp(left, right)];
                cuts.sort_by(f64::total_cmp);
                let below: f64 =
                    cuts.windows(2).map(|w| (w[1] - w[0]) * (depth_in(w[0]) + depth_in(w[1])) / 2.0).sum();
                let middle = at(column + 0.5) - f64::from(pixel.minor) - 0.5;
                let share = if pixel.aside > 0 { right - left - below } else { below };
                largest = largest.max((f64::from(pixel.share) / 65_536.0 - share).abs());
                assert!((f64::from(pixel.offset) / 256.0 + middle).abs() < 0.01, "{a:?} {b:?} {pixel:?}");
                assert!((pixel.aside > 0) == (pixel.offset < 0));
                if to.0[0] - from.0[0] > 2.0 && column + 0.5 > from.0[0] && column + 0.5 < to.0[0] {
                    let along = (column + 0.5 - from.0[0]) / (to.0[0] - from.0[0]);
                    let depth = f64::from(from.1) + along * f64::from(to.1 - from.1);
                    farthest = farthest.max((f64::from(pixel.depth) - depth).abs());
                }
                crossed += 1;
            };
            if edge.tall {
                edge.each_pixel::<true>([first, last], 0, &mut check);
                edge.each_pixel::<true>([first + 1, last], 1, &mut check);
            } else {
                edge.each_pixel::<false>([first, last], 0, &mut check);
                edge.each_pixel::<false>([first, last], 1, &mut check);
            }
            // Rows in a column by its ends; where an end lies within 2⁻¹² of a border, either may come out.
            let rows = |column: i32| {
                let (left, right) = (from.0[0].max(f64::from(column)), to.0[0].min(f64::from(column) + 1.0));
                let (low, high) = (at(left).min(at(right)), at(left).max(at(right)));
                let count = |by: f64| ((high + by).floor() - (low - by).floor()) as i32 + 1;
                [count(-1.0 / 4096.0), count(1.0 / 4096.0)]
            };
            let [least, most] =
                (first..=last).map(rows).fold([0; 2], |sum, n| [sum[0] + n[0], sum[1] + n[1]]);
            assert!((least..=most).contains(&crossed), "{a:?} {b:?} {crossed} {least} {most}");
        }
        // 2⁻¹³ pixel, and 1/16 of a step over 700 pixels.
        assert!(largest < 1.1e-4 && farthest < 16.0, "{largest} {farthest}");
    }
}
