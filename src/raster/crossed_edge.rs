//! The pixels that an edge between two faces crosses: which part of each lies beyond the edge, as seen from the pixel's centre.
//!
//! Along its major axis an edge goes through columns of pixels; in a column it changes the two pixels whose centres lie on both sides of its
//! middle, as its slope is at most 1: no other pixel has a part beyond the edge. Let the middle lie f below the centre of the first of these
//! pixels, 0 ≤ f < 1, and the edge reach h above and below it, h ≤ ½. With d = ½ − f, the part of the first pixel below the edge is
//! d while d ≥ h, and 0 while d ≤ −h; between, the edge goes from one pixel to the other, and the part is a triangle of (d + h)²/4h. The part of
//! the second pixel above the edge is smaller by d. Where the edge ends in the column, d and h count for its part of the column. Areas are within
//! 2⁻¹³ pixel, and 2⁻²⁷ pixel more for each column of the edge.

use super::line_area::{inverse_of_slope, triangle};
use super::{Scissor, ScreenPoint};
use crate::math::hints::{keep_rolled, opaque};
use crate::math::num::{mul_wide, reciprocal_called};

/// Depths along an edge are in 2⁻¹⁴ step: 30 bits and the sign.
const DEPTH_BITS: u32 = 14;

/// An edge on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CrossedEdge {
    /// Whether the major axis is y.
    pub(crate) tall: bool,
    /// Whether the ends changed places.
    flipped: bool,
    /// The ends along the major axis in 2⁻⁸ pixel, in ascending order.
    from: i32,
    to: i32,
    /// The minor coordinates of the ends.
    minor: i32,
    end: i32,
    /// The depth of the first end in 2⁻⁸ step, and in the middle of column 0 in 2⁻¹⁴ step, modulo 2³².
    from_depth: i32,
    depth: i32,
    /// Half a pixel above the middle of column 0, moved by the error of the slope (see `new`), in 2⁻³² pixel.
    origin: i64,
    /// The change per column in 2⁻³⁰ pixel: at most 2³⁰.
    slope: i32,
    /// [`inverse_of_slope`] of the slope, or 0 if it is below 2⁻¹⁰.
    inverse: u32,
    /// The change of depth per column in 2⁻¹⁴ step: at most 2²⁹.
    climb: i32,
    /// Half of the slope, in 2⁻¹⁶: h.
    reach: i32,
    /// The first column in which the edge has its whole width, unless it ends there.
    whole: i32,
}

/// The pixels of a column that an edge changes: they follow each other along the minor axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CrossedPair {
    /// Along the major axis, and along the minor axis of the first pixel.
    pub(crate) major: i32,
    pub(crate) minor: i32,
    /// How far the middle of the edge lies beyond the first pixel's centre, in 2⁻³² pixel.
    pub(crate) offset: u32,
}

/// The pairs that are looked for, by the axes of tall edges, or of wide ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// The first column, and the end of the columns.
    pub(crate) start: i32,
    pub(crate) end: i32,
    /// The first row, and the number of further rows in which pairs may begin: at least −1.
    pub(crate) top: i32,
    pub(crate) most: i32,
    /// 1 if pairs begin in every other row only: then `top` is such a row.
    pub(crate) every: u32,
}

impl Window {
    /// The window of the pixels in `scissor` for edges that are tall or wide: of wide edges pairs begin in rows of the parity of `odd`.
    pub(crate) fn new(&Scissor { left, top, right, bottom }: &Scissor, is_tall: bool, odd: i32) -> Self {
        match is_tall {
            true => Self { start: top, end: bottom, top: left, most: right - left - 2, every: 0 },
            false => {
                let top = top + ((top ^ odd) & 1);
                Self { start: left, end: right, top, most: (bottom - top - 2).max(-1), every: 1 }
            }
        }
    }
}

impl CrossedEdge {
    pub(crate) const EMPTY: Self = Self {
        tall: false,
        flipped: false,
        from: 0,
        to: 0,
        minor: 0,
        end: 0,
        from_depth: 0,
        depth: 0,
        origin: 0,
        slope: 0,
        inverse: 0,
        climb: 0,
        reach: 0,
        whole: 0,
    };

    /// The edge between two points with depths in 16.8. `None` if it has no length along its major axis.
    #[inline(always)] // called by one function: the result is not copied
    pub(crate) fn new([a, b]: [ScreenPoint; 2], [za, zb]: [i32; 2]) -> Option<Self> {
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
        // In 2⁻³⁰. At most `to − from`, which the shift brings to 31 bits.
        let slope = (mul_wide((end - minor) << r.shift.min(30), r.mantissa) >> 31) as i32;
        // In 2⁻¹⁴ step per pixel: 25 + 31 bits, down by 17 … 47.
        let climb = mul_wide(end_depth - depth, r.mantissa) >> (47 - r.shift.min(30));
        let climb = climb.clamp(-(1 << 29), 1 << 29) as i32;
        // Without triangles if they have less than 2⁻¹³ pixel.
        let steep = (slope.unsigned_abs() >> 1).min((1 << 29) - 1);
        let inverse = if steep < 1 << 19 { 0 } else { inverse_of_slope(steep) };
        let into = 128 - from; // to the middle of column 0: 24 bits
        let (from_depth, in_column) = (depth, (mul_wide(climb, into) >> 8) as i32);
        let depth = (from_depth << (DEPTH_BITS - 8)).wrapping_add(in_column);
        // A pixel whose centre lies on the edge counts as right of it or, if the edge is level, as below it (rules R3 and R4). So the edge is moved
        // away from those pixels by more than its error, at most 12 units a column.
        let belongs_to_high = tall || end <= minor;
        let error = i64::from(((to - from) >> 8) + 2) << 4;
        let origin = (i64::from(minor) << 24) - (1 << 31) + (mul_wide(slope, into) >> 6);
        let origin = if belongs_to_high { origin - error } else { origin + error };
        let (reach, whole) = ((slope.unsigned_abs() >> 15) as i32, (from + 255) >> 8);
        Some(Self {
            tall,
            flipped,
            from,
            to,
            minor,
            end,
            from_depth,
            depth,
            origin,
            slope,
            inverse,
            climb,
            reach,
            whole,
        })
    }

    /// The ends, in the order in which they were given.
    pub(crate) fn ends(&self) -> [ScreenPoint; 2] {
        let (first, last) = ([self.from, self.minor], [self.to, self.end]);
        let ends = if self.flipped { [last, first] } else { [first, last] };
        ends.map(|[along, aside]| {
            if self.tall {
                ScreenPoint::inside(aside, along)
            } else {
                ScreenPoint::inside(along, aside)
            }
        })
    }

    /// The row below those that it crosses.
    #[inline(always)]
    pub(crate) fn bottom(&self) -> i32 {
        let lowest = if self.tall { self.to } else { self.minor.max(self.end) };
        (lowest >> 8) + 1
    }

    /// Whether points whose [`area`](super::area) with the edge is negative, or else positive, have larger minor coordinates than the edge.
    #[inline(always)]
    pub(crate) fn is_high(&self, is_negative: bool) -> bool {
        is_negative ^ self.flipped ^ self.tall
    }

    /// The change of depth per pixel of the minor axis, in 2⁻⁸ step, of the plane through the edge and a point with a depth in 16.8; clamped to
    /// 2²¹, which is an eighth of all depths.
    #[inline(never)] // once for each face beside an edge
    pub(crate) fn gradient(&self, point: ScreenPoint, depth: i32) -> i32 {
        let (along, aside) = if self.tall { (point.y, point.x) } else { (point.x, point.y) };
        let by = along - self.from; // 23 bits and the sign
        let away = aside - self.minor - (mul_wide(self.slope, by) >> 30) as i32; // 24 bits: points lie in the guard band
        let climb = i64::from(depth - self.from_depth) - (mul_wide(self.climb, by) >> DEPTH_BITS);
        // A face thinner than 2⁻⁸ pixel counts as that thick.
        let r = reciprocal_called(away.abs().max(1));
        let climb = climb.clamp(-(1 << 30), 1 << 30) as i32;
        let gradient =
            (mul_wide(climb, r.mantissa) >> (53 - r.shift.min(30))).clamp(-(1 << 21), 1 << 21) as i32;
        if away < 0 {
            -gradient
        } else {
            gradient
        }
    }

    /// Of the edge's columns, the first and the last one that may have a pair of pixels in a window. `None` if no pair lies there.
    #[inline(always)]
    pub(crate) fn columns_within(&self, window: &Window) -> Option<[i32; 2]> {
        let &Window { start, end, top, most, every } = window;
        // The first rows of pairs. The middles of columns lie up to half of the slope beyond the ends, and less than 2⁻⁷ pixel for the rounding of
        // the slope and the shift in `new`.
        let beyond = (self.reach >> 8) + 2;
        let low = ((self.minor.min(self.end) - beyond - 128) >> 8).max(top);
        let high = ((self.minor.max(self.end) + beyond - 128) >> 8).min(top + most);
        if low > high || low == high && (low - top) & every as i32 != 0 {
            return None;
        }
        let mut first = (self.from >> 8).max(start);
        let mut last = ((self.to - 1) >> 8).min(end - 1);
        // Of short edges, and of flat ones, which stay in few rows, all columns are looked at. 2⁻⁷ pixel per column.
        if last - first > 8 && self.reach >> 8 != 0 {
            // The column of a minor coordinate, within 2: the distance has 22 bits in 2⁻⁸ pixel, the inverse 22 in 2⁻¹⁵.
            let column = |row: i32| {
                let away = ((row << 8) - self.minor).clamp(-(1 << 22), 1 << 22);
                let by = (mul_wide(away, self.inverse as i32) >> 15) as i32;
                ((if self.end < self.minor { -by } else { by }) + self.from) >> 8
            };
            let ends = [column(top), column(top + most + 2)];
            first = first.max(ends[0].min(ends[1]) - 2);
            last = last.min(ends[0].max(ends[1]) + 2);
        }
        (first <= last).then_some([first, last])
    }

    /// Calls `visit` with each pair of pixels in columns `first` to `last` that lies in a window.
    #[inline(always)]
    pub(crate) fn each_pair(
        &self,
        [first, last]: [i32; 2],
        window: &Window,
        mut visit: impl FnMut(CrossedPair),
    ) {
        let &Window { top, most, every, .. } = window;
        let most = most as u32 >> every; // no pair begins in a window without rows: `columns_within`
        let slope = i64::from(self.slope) << 2;
        let mut middle = self.origin + slope * i64::from(first);
        let mut column = first;
        while column <= last {
            keep_rolled();
            let minor = (middle >> 32) as i32;
            // A row in which no pair begins becomes at least 2³¹.
            if (minor.wrapping_sub(top) as u32).rotate_right(every) <= most {
                // Hidden: LLVM would advance all that depends on the column, too, with each column.
                visit(CrossedPair { major: opaque(column), minor, offset: middle as u32 });
            }
            (middle, column) = (middle + slope, column + 1);
        }
    }

    /// The depth of the edge in the middle of a column, in 2⁻⁸ step.
    #[inline(always)]
    pub(crate) fn depth(&self, column: i32) -> i32 {
        self.climb.wrapping_mul(column).wrapping_add(self.depth) >> (DEPTH_BITS - 8)
    }

    /// The part of each pixel of a pair on the side of the other one, in 2⁻¹⁶.
    #[inline(always)]
    pub(crate) fn shares(&self, pair: &CrossedPair) -> [i32; 2] {
        let d = (pair.offset as i32 ^ i32::MAX) >> 16; // an offset of 0 is ½ − 2⁻¹⁶
        let (mut d, mut part, mut reach) = (d, d, self.reach);
        if pair.major < self.whole || pair.major >= self.to >> 8 {
            [d, part, reach] = self.in_part(pair.major, d);
        }
        let crossed = reach - d.abs();
        let both = if crossed > 0 { triangle(crossed, self.inverse) } else { 0 };
        [both + part.max(0), both + (-part).max(0)]
    }

    /// In a column of which the edge takes a part: d in the middle of this part, its product with the width of the part, and h.
    #[inline(never)] // twice for each edge
    fn in_part(&self, column: i32, d: i32) -> [i32; 3] {
        let [left, right] = [self.from.max(column << 8), self.to.min((column + 1) << 8)];
        let (aside, width) = (left + right - (column << 9) - 256, right - left); // 1 … 255 wide
        let d = d - (((self.slope >> 14) * aside) >> 9); // within ±1: 17 bits and 9
        [d, (d * width) >> 8, (self.reach * width) >> 8]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    extern crate std;
    use std::vec::Vec;

    fn pairs(edge: &CrossedEdge, columns: [i32; 2], window: &Window) -> Vec<CrossedPair> {
        let mut pairs = Vec::new();
        edge.each_pair(columns, window, |pair| pairs.push(pair));
        pairs
    }

    /// The parts of pixels beyond the edge, by integrals in f64, for edges of all lengths and slopes; and no other pixel has such a part.
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
            let (first, last) = (edge.from >> 8, (edge.to - 1) >> 8);
            let last = last.min(first + 700);
            let found = [0, 1].map(|odd| {
                let every = u32::from(!edge.tall);
                let anywhere = Window { start: 0, end: 0, top: i32::MIN / 2 + odd, most: i32::MAX, every };
                let pairs = pairs(&edge, [first, last], &anywhere);
                assert!(pairs.iter().all(|pair| edge.tall || (pair.minor ^ odd) & 1 == 0));
                pairs
            });
            let all = if edge.tall { found[0].clone() } else { found.concat() };
            assert_eq!(all.len(), (last - first + 1) as usize);
            for pair in all {
                let (shares, depth) = (edge.shares(&pair), edge.depth(pair.major));
                let column = f64::from(pair.major);
                let (left, right) = (from.0[0].max(column), to.0[0].min(column + 1.0));
                // The part of a pixel below the edge by Simpson's rule between the points at which the edge goes in or out: exact for lines.
                let below = |minor: i32| {
                    let depth_in = |major: f64| (at(major) - f64::from(minor)).clamp(0.0, 1.0);
                    let corners = [0.0, 1.0].map(|v| from.0[0] + (f64::from(minor) + v - from.0[1]) / slope);
                    let mut cuts =
                        [left, right, corners[0].clamp(left, right), corners[1].clamp(left, right)];
                    cuts.sort_by(f64::total_cmp);
                    let part = |w: &[f64]| (w[1] - w[0]) * (depth_in(w[0]) + depth_in(w[1])) / 2.0;
                    right - left - cuts.windows(2).map(part).sum::<f64>()
                };
                let wide = right - left;
                for (minor, expected) in [
                    (pair.minor - 1, 0.0),
                    (pair.minor, f64::from(shares[0]) / 65_536.0),
                    (pair.minor + 1, wide - f64::from(shares[1]) / 65_536.0),
                    (pair.minor + 2, wide),
                ] {
                    largest = largest.max((below(minor) - expected).abs());
                }
                let middle = at(column + 0.5) - f64::from(pair.minor) - 0.5;
                assert!(
                    (f64::from(pair.offset) / 4_294_967_296.0 - middle).abs() < 0.01,
                    "{a:?} {b:?} {pair:?}"
                );
                if to.0[0] - from.0[0] > 2.0 && column + 0.5 > from.0[0] && column + 0.5 < to.0[0] {
                    let along = (column + 0.5 - from.0[0]) / (to.0[0] - from.0[0]);
                    let expected = f64::from(from.1) + along * f64::from(to.1 - from.1);
                    farthest = farthest.max((f64::from(depth) - expected).abs());
                }
            }
        }
        // 2⁻¹³ pixel, and 1/16 of a step over 700 pixels.
        assert!(largest < 1.2e-4 && farthest < 16.0, "{largest} {farthest}");
    }

    /// The columns for some rows have all pairs of these rows, and few more.
    #[test]
    fn columns_within_rows_have_all_of_their_pairs() {
        let mut random = Random(4);
        for i in 0..4_000 {
            let reach = [300, 3_000, 60_000, 200_000][i % 4];
            let mut point = || ScreenPoint::inside(random.within(reach), random.within(reach));
            let Some(edge) = CrossedEdge::new([point(), point()], [0; 2]) else { continue };
            let (top, odd) = (random.within(reach) >> 8, i as i32 & 1);
            let scissor = if edge.tall {
                Scissor::unclamped(top, -300, top + 9, 300)
            } else {
                Scissor::unclamped(-300, top, 300, top + 9)
            };
            let window = Window::new(&scissor, edge.tall, odd);
            let found = edge.columns_within(&window);
            let all = [(edge.from >> 8).max(-300), ((edge.to - 1) >> 8).min(299)];
            for pair in pairs(&edge, all, &window) {
                assert!(found.is_some_and(|[first, last]| (first..=last).contains(&pair.major)));
            }
            if let Some([first, last]) = found
                && edge.slope.abs() > 1 << 28
            {
                assert!(last - first < 9 * 4 + 10);
            }
        }
    }
}
