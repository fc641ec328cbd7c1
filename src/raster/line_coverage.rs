//! Anti-aliased lines: how much of each pixel a line of one pixel's width covers.
//!
//! The line is a parallelogram: the points at most ½ pixel from the infinite line through both ends, between two pixel borders,
//! those nearest to the ends along the major axis. So it is a rectangle of width 1 but for its ends, which lie on pixel borders:
//! lines that follow one another along one axis, as the edges of a curve do, share no pixel column and leave none out.
//!
//! The coverage of a pixel is the area of the parallelogram in the pixel's square: an unweighted area sampling with a box filter
//! (Foley et al., 2nd ed., section 3.17.2; Gupta and Sproull, *Filtering edges for gray-scale displays*, 1981, use a cone).
//! Wu's two pixels per column have the area only of a horizontal line.
//!
//! In one column of a line with slope m ≤ 1, an edge of the parallelogram crosses at most one grid line between two pixels, if
//! it passes that grid line at a distance d < m/2 in the middle of the column. Then a triangle of area (m/2 − d)²/2m lies beyond
//! the grid line; all else is as if the edge were level with its middle.

use super::{Pixel, Scissor, ScreenPoint};
use crate::math::num::{divide, mul_wide, reciprocal};

/// The parallelogram of a line. Coordinates are in the axes of the line: *columns* run along its major axis.
pub(crate) struct LineCoverage {
    /// Whether the major axis is y.
    pub(crate) tall: bool,
    /// The columns that the line covers: `first` up to but excluding `end`.
    first: i32,
    end: i32,
    /// The major and the minor extent in 1/256 pixel: `length` ≥ |`rise`|, at most 2²⁴.
    length: i32,
    rise: i32,
    /// The column in whose middle the upper edge is at `top`, in 2⁻³².
    from: i32,
    top: i64,
    /// The change of `top` per column: at most 2³² in magnitude. Its relative error is 2⁻²⁹, which over 2¹⁴ columns, the guard
    /// band, makes 2⁻¹⁵ pixel, and over 2¹⁶ columns 2⁻¹³.
    slope: i64,
    /// The height of the parallelogram in a column, √(1 + m²), in 2⁻¹⁶: 65536 … 92682.
    thickness: u32,
    /// Half the slope's magnitude in 2⁻¹⁶, or 0 if the slope is below 2⁻¹⁰: then triangles have less than 2⁻¹³ pixel.
    half_slope: u32,
    /// 1/m in 2⁻¹²: below 2²³.
    inverse: u32,
}

/// A column of a line: `top` is the upper edge in its middle, in 2⁻³².
#[derive(Clone, Copy)]
pub(crate) struct Column {
    pub(crate) column: i32,
    top: i64,
}

impl Column {
    /// The row of the first of the five pixels that the line may cover.
    #[inline(always)]
    pub(crate) fn first(&self) -> i32 {
        (self.top >> 32) as i32 - 1
    }
}

impl LineCoverage {
    /// The line between two points.
    #[inline(always)]
    pub(crate) fn new(ends: [ScreenPoint; 2]) -> Self {
        Self::between(ends.map(|p| [p.x, p.y]))
    }

    /// The line between the centres of two pixels, both included: it ends at their outer borders.
    #[inline(always)]
    pub(crate) fn between_pixels(ends: [Pixel; 2]) -> Self {
        let line = Self::between(ends.map(|p| [p.x, p.y].map(|v| 256 * i32::from(v) + 128)));
        // The nearest border of the first centre, where two are equally near, is the one beyond it.
        Self { first: line.from, ..line }
    }

    /// The line between two points with coordinates in 1/256 pixel, at most 2²³ in magnitude.
    #[inline(never)]
    fn between([a, b]: [[i32; 2]; 2]) -> Self {
        let tall = (a[1] - b[1]).abs() > (a[0] - b[0]).abs();
        let along = |[x, y]: [i32; 2]| if tall { (y, x) } else { (x, y) };
        // Sorted along the major axis, and with equal coordinates there is no column.
        let (a, b) = if along(a).0 <= along(b).0 { (along(a), along(b)) } else { (along(b), along(a)) };
        let (length, rise) = (b.0 - a.0, b.1 - a.1); // 0 ≤ length ≤ 2²⁴, |rise| ≤ length
                                                     // 1/length = mantissa · 2^(shift − 61): the slope in 2⁻³² is rise · mantissa · 2^(shift − 29). 25 + 31 + 2 bits.
        let r = reciprocal(length);
        let slope = (mul_wide(rise, r.mantissa) << 2) >> (31 - r.shift.min(30));
        let m = ((slope.unsigned_abs() + (1 << 15)) >> 16) as u32; // at most 2¹⁶
        let (mut half_slope, mut inverse) = (0, 0);
        if m >= 1 << 6 {
            half_slope = m >> 1;
            // length/rise · 2¹² = length · mantissa · 2^(shift − 49): 25 + 31 bits, below 2²³.
            let r = reciprocal(rise.abs());
            inverse = (mul_wide(length, r.mantissa) >> (49 - r.shift.min(30))) as u32;
        }
        let thickness = thickness(m);
        let from = a.0 >> 8;
        let middle = 256 * from + 128 - a.0; // −127 … 128
                                             // 24 + 24 bits, and 33 + 8 bits.
        let top = (i64::from(a.1) << 24) + ((slope * i64::from(middle)) >> 8) - (i64::from(thickness) << 15);
        let border = |p: i32| (p + 128) >> 8;
        Self {
            tall,
            first: border(a.0),
            end: border(b.0),
            length,
            rise,
            from,
            top,
            slope,
            thickness,
            half_slope,
            inverse,
        }
    }

    /// What the line covers of each column of the scissor, in the direction of the major axis. Rows of a column may lie outside
    /// the scissor.
    #[inline(always)]
    pub(crate) fn columns(&self, scissor: &Scissor) -> Columns {
        let (columns, rows) = self.axes(scissor);
        let (mut first, mut end) = (self.first.max(columns.start), self.end.min(columns.end));
        if first < end {
            (first, end) = self.clipped_to_rows(first, end, rows);
        }
        // |first − from| ≤ 2¹⁶, times 2³².
        let top = self.top.wrapping_add(self.slope.wrapping_mul(i64::from(first - self.from)));
        Columns { slope: self.slope, column: first, end, top }
    }

    /// The scissor's range along the major and along the minor axis.
    #[inline(always)]
    pub(crate) fn axes(&self, scissor: &Scissor) -> (core::ops::Range<i32>, core::ops::Range<i32>) {
        if self.tall {
            (scissor.rows(), scissor.columns())
        } else {
            (scissor.columns(), scissor.rows())
        }
    }

    /// Columns `first` up to but excluding `end` without most of those in which the line lies outside of these rows.
    #[inline(never)]
    fn clipped_to_rows(&self, first: i32, end: i32, rows: core::ops::Range<i32>) -> (i32, i32) {
        let row = |column: i32| {
            let top = self.top.wrapping_add(self.slope.wrapping_mul(i64::from(column - self.from)));
            (top >> 32) as i32
        };
        // A column has pixels in rows `row` − 1 to `row` + 3; one more row on either side covers the error of `slope`.
        let (low, high) = (rows.start - 4, rows.end + 1);
        let (a, b) = (row(first), row(end - 1));
        if a.max(b) < low || a.min(b) > high || rows.is_empty() {
            return (first, first);
        }
        // The number of columns from `first` in which the edge moves by `distance` rows, rounded down: 25 + 24 bits.
        let columns = |distance: i32| {
            let product = u64::from(distance.unsigned_abs() * 256) * u64::from(self.length.unsigned_abs());
            (divide(product, self.rise.unsigned_abs()).0 >> 8).min(1 << 20) as i32
        };
        let (enters, leaves) = if self.rise > 0 { (low - a, high - a) } else { (a - high, a - low) };
        // `row` is rounded down, so the edge may have moved by a row less or more: hence the further row. If the line enters
        // or leaves, it is not level: `rise` is not 0.
        let start = if enters > 1 { first + columns(enters - 1) } else { first };
        let stop = if a.min(b) < low || a.max(b) > high {
            if leaves >= 0 {
                end.min(first + columns(leaves + 1) + 2)
            } else {
                first
            }
        } else {
            end
        };
        (start.min(end), stop)
    }

    /// The triangle beyond a grid line, in 2⁻¹⁶ pixel, if the edge passes it at this distance in the middle of the column.
    #[inline(always)]
    fn beyond(&self, distance: u32) -> i32 {
        let Some(reach) = self.half_slope.checked_sub(distance) else { return 0 };
        // `reach` ≤ 2¹⁵ and reach/m ≤ ½, in 2⁻²⁸ below 2²⁸. Their product, halved, is in 2⁻³³.
        let width = reach.wrapping_mul(self.inverse) >> 12;
        (reach.wrapping_mul(width) >> 17) as i32
    }

    /// The coverage of the five pixels of a column, in 1/256 pixel.
    #[inline(never)] // for columns that are clipped: most are not
    pub(crate) fn coverage(&self, column: &Column) -> [i32; 5] {
        let mut coverage = [0; 5];
        self.each_pixel(column, |pixel, covered| {
            if let Some(coverage) = coverage.get_mut(pixel) {
                *coverage = covered;
            }
        });
        coverage
    }

    /// Calls `put` with 0 … 4, for the pixel this many rows below a column's [first](Column::first), and its coverage in 1/256
    /// pixel: for pixels 1 and 2, and for others if the line covers them.
    #[inline(always)]
    pub(crate) fn each_pixel(&self, column: &Column, mut put: impl FnMut(usize, i32)) {
        const ONE: i32 = 1 << 16;
        const HALF: u32 = 1 << 15;
        // Rounded to nearest; an area of −2⁻¹⁶, from rounding, becomes 0.
        let rounded = |area: i32| (area + 128) >> 8;
        let upper = (column.top as u32) >> 16; // the part of pixel 1 above the edge
        let lower = upper + self.thickness; // 65536 … 158217: the lower edge is in pixel 2 or 3
        let mut second = ONE - upper as i32;
        let mut third = ONE;
        if upper < HALF {
            let beyond = self.beyond(upper);
            if rounded(beyond) != 0 {
                put(0, rounded(beyond));
            }
            second -= beyond;
        } else {
            let beyond = self.beyond(ONE as u32 - upper);
            second += beyond;
            third -= beyond;
        }
        let part = lower & 0xffff;
        let is_low = part < HALF;
        let beyond = self.beyond(if is_low { part } else { ONE as u32 - part });
        let (above, below) = if is_low { (beyond, 0) } else { (0, beyond) };
        let area = part as i32 + above - below;
        let mut fourth = area;
        if lower < 2 << 16 {
            second -= above;
            third += area - ONE;
            fourth = below;
        } else {
            third -= above;
            if rounded(below) != 0 {
                put(4, rounded(below));
            }
        }
        put(1, rounded(second));
        put(2, rounded(third));
        if rounded(fourth) != 0 {
            put(3, rounded(fourth));
        }
    }
}

/// √(1 + m²) in 2⁻¹⁶ for m in 2⁻¹⁶, at most 1: a polynomial of m², within 2⁻¹⁴.
#[inline(always)]
fn thickness(m: u32) -> u32 {
    let s = ((m * (m >> 1)) >> 16) as i32; // m² in 2⁻¹⁵: m·m/2 ≤ 2³¹
                                           // Interpolated at the Chebyshev nodes of 0 … 1, in 2⁻¹⁶; no factor has more than 16 bits.
    let sum = [2919, -7833, 32726].into_iter().fold(-668, |sum, term| term + ((s * sum) >> 15));
    ((1 << 16) + ((s * sum) >> 15)) as u32
}

/// An iterator over the columns of a line.
pub(crate) struct Columns {
    slope: i64,
    column: i32,
    end: i32,
    top: i64,
}

impl Iterator for Columns {
    type Item = Column;

    #[inline(always)]
    fn next(&mut self) -> Option<Column> {
        if self.column >= self.end {
            return None;
        }
        let column = Column { column: self.column, top: self.top };
        self.column += 1;
        self.top = self.top.wrapping_add(self.slope);
        Some(column)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use std::vec;
    use std::vec::Vec;

    /// The area of a convex polygon in the unit square whose first corner is (x, y): cut by four half-planes, then the shoelace
    /// formula.
    fn area_in_pixel(polygon: &[[f64; 2]], x: f64, y: f64) -> f64 {
        let mut points: Vec<[f64; 2]> = polygon.iter().map(|p| [p[0] - x, p[1] - y]).collect();
        let sides: [fn([f64; 2]) -> f64; 4] = [|p| p[0], |p| 1.0 - p[0], |p| p[1], |p| 1.0 - p[1]];
        for side in sides {
            let mut cut = Vec::new();
            for (i, &p) in points.iter().enumerate() {
                let q = points[(i + 1) % points.len()];
                let (u, v) = (side(p), side(q));
                if u >= 0.0 {
                    cut.push(p);
                }
                if (u >= 0.0) != (v >= 0.0) {
                    let t = u / (u - v);
                    cut.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
                }
            }
            points = cut;
        }
        let next = |i: usize| points[(i + 1) % points.len()];
        let twice: f64 = points.iter().enumerate().map(|(i, p)| p[0] * next(i)[1] - next(i)[0] * p[1]).sum();
        twice.abs() / 2.0
    }

    /// The parallelogram of the definition, in pixels; x is the major axis.
    fn parallelogram(a: [f64; 2], b: [f64; 2]) -> Option<[[f64; 2]; 4]> {
        let (a, b) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        let border = |x: f64| (x + 0.5).floor();
        let (first, end) = (border(a[0]), border(b[0]));
        let slope = (b[1] - a[1]) / (b[0] - a[0]);
        let half = (1.0 + slope * slope).sqrt() / 2.0;
        let y = |x: f64| a[1] + slope * (x - a[0]);
        let corners =
            [[first, y(first) - half], [end, y(end) - half], [end, y(end) + half], [first, y(first) + half]];
        (first < end).then_some(corners)
    }

    #[test]
    fn coverage_is_the_area_of_the_parallelogram_in_the_pixel() {
        let random = &mut Random(31);
        let (mut largest, mut partial) = (0.0_f64, 0);
        for i in 0..20_000 {
            let reach = [700, 3_000, 12_000, 2_000_000][i % 4];
            let mut ends = [(); 2].map(|()| [random.within(reach), random.within(reach)]);
            match i / 4 % 5 {
                0 => ends[1][1] = ends[0][1] + random.within(40), // almost level
                1 => ends[1] = [ends[0][0] + (ends[1][1] - ends[0][1]), ends[1][1]], // diagonal
                2 => ends[1][1] = ends[0][1],
                _ => {}
            }
            let clamped = |v: i32| v.clamp(-2_097_152, 2_097_152);
            let ends = ends.map(|[x, y]| [clamped(x), clamped(y)]);
            let line = LineCoverage::new(ends.map(|[x, y]| ScreenPoint::inside(x, y)));
            let axes = |[x, y]: [i32; 2]| if line.tall { [y, x] } else { [x, y] };
            let [a, b] = ends.map(|end| axes(end).map(|v| f64::from(v) / 256.0));
            let Some(polygon) = parallelogram(a, b) else {
                assert!(line.first >= line.end, "{ends:?}");
                continue;
            };
            assert_eq!((line.first, line.end), (polygon[0][0] as i32, polygon[1][0] as i32), "{ends:?}");
            let all = Scissor::unclamped(-9000, -9000, 9000, 9000);
            let step = (line.end - line.first) as usize / 40 + 1;
            let offset = random.below(step as i64) as usize;
            for column in line.columns(&all).skip(offset).step_by(step) {
                // Two more pixels on either side, where nothing is covered.
                let covered = line.coverage(&column);
                for row in column.first() - 2..column.first() + 7 {
                    let slot = usize::try_from(row - column.first()).ok();
                    let own = slot.and_then(|slot| covered.get(slot)).copied().unwrap_or(0);
                    let exact = area_in_pixel(&polygon, column.column.into(), row.into());
                    assert!((0..=256).contains(&own));
                    largest = largest.max((f64::from(own) / 256.0 - exact).abs());
                    partial += i32::from(exact > 0.01 && exact < 0.99);
                }
            }
        }
        // 2⁻⁹ for rounding to 1/256, and 2⁻¹² for all else.
        let bound = 1.0 / 512.0 + 1.0 / 4096.0;
        assert!(largest <= bound && largest > bound / 2.0, "{largest}");
        assert!(partial > 100_000, "{partial}");
    }

    #[test]
    fn a_clipped_line_has_the_columns_of_the_line() {
        let random = &mut Random(32);
        let mut compared = 0;
        for i in 0..15_000 {
            let reach = [2_000, 20_000, 2_000_000][i % 3];
            let mut point = || ScreenPoint::clamped(random.within(reach), random.within(reach));
            let line = LineCoverage::new([point(), point()]);
            let [left, top] = [0; 2].map(|_| random.within(60));
            let (width, height) = (random.below(40) as i32 + 1, random.below(40) as i32 + 1);
            let scissor = Scissor::new(left, top, left + width, top + height);
            let (columns, rows) = line.axes(&scissor);
            let all = line.columns(&Scissor::GUARD_BAND);
            let pixels = |column: Column| {
                let rows = rows.clone();
                let covered = (column.first()..).zip(line.coverage(&column));
                let rows = covered.filter(move |(row, _)| rows.contains(row));
                rows.filter(|&(_, c)| c != 0).map(move |(row, c)| (column.column, row, c))
            };
            let exact = all.filter(|column| columns.contains(&column.column)).flat_map(pixels);
            let exact: Vec<_> = exact.collect();
            let clipped: Vec<_> = line.columns(&scissor).flat_map(pixels).collect();
            assert_eq!(clipped, exact);
            compared += exact.len();
            // Clipping leaves out most columns of which nothing lies in the scissor.
            let visited = line.columns(&scissor).count() as i64;
            let useful = exact.iter().map(|(column, ..)| column).fold(vec![], |mut all, column| {
                if all.last() != Some(column) {
                    all.push(*column);
                }
                all
            });
            let per_row = i64::from(line.length) / i64::from(line.rise.abs().max(1)) + 1;
            assert!(
                visited <= useful.len() as i64 + 16 * per_row + 16,
                "{visited} {} {per_row}",
                useful.len()
            );
        }
        assert!(compared > 20_000, "{compared}");
    }

    /// The sum over a column is the height of the parallelogram, so a line is equally bright in all directions.
    #[test]
    fn a_line_covers_its_length_times_its_width() {
        for (x, y) in [(40, 0), (40, 3), (40, 17), (40, 40), (17, 40), (3, -40), (-40, 9)] {
            let end = ScreenPoint::inside(x * 256, y * 256);
            let line = LineCoverage::new([ScreenPoint::ORIGIN, end]);
            let columns = line.columns(&Scissor::GUARD_BAND);
            let sum: i32 = columns.map(|column| line.coverage(&column).iter().sum::<i32>()).sum();
            let area = f64::from(sum) / 256.0;
            assert!((area - f64::from(x).hypot(f64::from(y))).abs() < 0.05, "{area}");
        }
    }
}
