//! Anti-aliased lines: which columns a line has, and where it lies in each.
//!
//! The line is a parallelogram: the points at most ½ pixel from the infinite line through both ends, between two pixel borders
//! across the major axis. A line between two pixels reaches from the border before the first pixel to the border after the last
//! one. An edge of a mesh has a column more at each end; `line_end.rs` says which part of the pixels around an end belongs to it.
//!
//! The coverage of a pixel is the area of the parallelogram in the pixel's square: an unweighted area sampling with a box filter
//! (Foley et al., 2nd ed., section 3.17.2; Gupta and Sproull, *Filtering edges for gray-scale displays*, 1981, use a cone, and a
//! table by the distance). Wu's two pixels per column have this area only for a horizontal line. The area depends on the slope
//! and on where the middle of the line lies in the column: `line_area.rs` computes it.

use super::{LineArea, Scissor, PIXELS};
use crate::math::num::{mul_wide, reciprocal};
use core::ops::Range;

/// An anti-aliased line. Coordinates are in the axes of the line: *columns* run along its major axis, rows along its minor axis.
#[derive(Clone, Debug)]
pub(crate) struct LineCoverage {
    /// Whether the major axis is y.
    pub(crate) tall: bool,
    /// Whether the line goes upwards from column to column. Then `row` and `fraction` describe its mirror image, whose rows are
    /// counted upwards: row r is row −1 − r of the picture.
    pub(crate) rises: bool,
    /// Whether no column has a pixel outside the scissor's rows.
    pub(crate) inside: bool,
    /// The columns that the line covers: `first` up to but excluding `end`.
    pub(crate) first: i32,
    pub(crate) end: i32,
    /// The row in which the middle of the line lies in the middle of column `first`, and where it lies in that row, in 2⁻³².
    pub(crate) row: i32,
    pub(crate) fraction: u32,
    /// The change of the middle per column in 2⁻²⁹, 0 … 2²⁹ − 1. It is at most 1½ units off, which over 2¹⁴ columns, the guard
    /// band, makes 2⁻¹⁴ pixel, and over 2¹⁶ columns 2⁻¹².
    slope: u32,
}

/// A column of a line: the first of the rows in which the line may cover a pixel, and the areas of their pixels in 2⁻¹⁶.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    pub(crate) column: i32,
    pub(crate) first: i32,
    pub(crate) areas: [i32; PIXELS],
}

impl LineCoverage {
    /// The line between two points with coordinates in 1/256 pixel, at most 2²³ in magnitude: from `beyond` columns, 0 or 1, before
    /// the column of one end to as many after that of the other end. [`inside`](Self::inside) is true if two pixels and `beyond` lie
    /// between the ends' pixels and the scissor's border, and false if the line has yet to be [clipped](Self::clipped): the middle of
    /// the line lies within ½ + `beyond` pixels of an end's pixel in each column, and the line reaches 1.21 pixels beyond its middle.
    #[inline(always)]
    pub(crate) fn new(ends: [[i32; 2]; 2], beyond: i32, scissor: &Scissor) -> Self {
        let columns = |from: i32, to: i32| ((from >> 8) - beyond, (to >> 8) + 1 + beyond);
        Self::with_columns(ends, beyond, columns, scissor)
    }

    /// The line of [`new`](Self::new) from end to end, for areas from a table: the columns whose middles lie between the ends, and whether
    /// half of the first column, and of the last one, belongs to the line: if the middle of the column lies at most ¼ pixel from the end.
    /// So lines that go straight on make up one line.
    #[inline(always)]
    pub(crate) fn between_ends(ends: [[i32; 2]; 2], scissor: &Scissor) -> (Self, [bool; 2]) {
        let mut halves = [false; 2];
        let columns = |from, to| {
            let column_at = |end: i32| {
                let column = (end + 63) >> 8; // the first one whose middle is not more than ¼ pixel before the end
                (column, 256 * column + 128 - end < 64)
            };
            let [(first, at_first), (last, at_last)] = [from, to].map(column_at);
            // Nothing belongs to a line that begins and ends around the middle of one column.
            halves = if at_first && first == last { [false; 2] } else { [at_first, at_last] };
            (first, last + i32::from(halves[1]))
        };
        (Self::with_columns(ends, 0, columns, scissor), halves)
    }

    /// The parts of a line of [`between_ends`](Self::between_ends): columns in half at its start, whole columns, columns in half at its end.
    pub(crate) fn split(&self, halves: [bool; 2]) -> [Self; 3] {
        let [start, end] = [self.first + i32::from(halves[0]), self.end - i32::from(halves[1])];
        [self.first..start, start..end, end..self.end].map(|columns| self.part(columns))
    }

    /// [`new`](Self::new), with a function that gives `first` and `end`, of both ends along the major axis, in 1/256 pixel.
    #[inline(always)]
    fn with_columns(
        [[ax, ay], [bx, by]]: [[i32; 2]; 2],
        beyond: i32,
        columns: impl FnOnce(i32, i32) -> (i32, i32),
        scissor: &Scissor,
    ) -> Self {
        let (left, right, top, bottom) = (ax.min(bx), ax.max(bx), ay.min(by), ay.max(by));
        let inside = left >> 8 > scissor.left + 1 + beyond
            && right >> 8 < scissor.right - 2 - beyond
            && top >> 8 > scissor.top + 1 + beyond
            && bottom >> 8 < scissor.bottom - 2 - beyond;
        let (width, height) = (right - left, bottom - top);
        let (tall, rises) = (height > width, (ax - bx) ^ (ay - by) < 0);
        let (from, length, low, rise) =
            if tall { (top, height, left, width) } else { (left, width, top, height) };
        // With `length` 0 `rise` is 0, too. 1/length = mantissa · 2^(shift − 61): this is rise/length · 2²⁹, as rise ≤ length < 2²⁵.
        let r = reciprocal(length);
        let slope = (((mul_wide(rise << r.shift, r.mantissa) + (1 << 31)) >> 32) as i32).min((1 << 29) - 1);
        let start = if rises { -(low + rise) } else { low };
        let (first, end) = columns(from, from + length);
        // From `from` to the middle of the first column: −383 … 191. The product is in 2⁻²⁹, below 2³⁰, and 2⁻²⁰ off.
        let change = (slope >> 8) * (256 * first + 128 - from);
        let sum = ((start & 0xff) << 21) + change; // −2²⁹ … 2³⁰
        Self {
            tall,
            rises,
            inside,
            first,
            end,
            row: (start >> 8) + (sum >> 29),
            fraction: (sum as u32) << 3,
            slope: slope as u32,
        }
    }

    /// The change of the middle per column in 2⁻³².
    #[inline(always)]
    pub(crate) fn slope(&self) -> u32 {
        self.slope << 3
    }

    /// The slope, prepared for the areas of the line's columns.
    #[inline(always)]
    pub(crate) fn area(&self) -> LineArea {
        LineArea::new(self.slope)
    }

    /// How far the middle moves over `columns` columns, in 2⁻³².
    #[inline(always)]
    pub(crate) fn distance(&self, columns: i32) -> i64 {
        mul_wide((self.slope << 2) as i32, 2 * columns) // 31 + 18 bits: shifted before, a product takes one instruction
    }

    /// The part of the line in the scissor's columns, without most of the columns whose pixels all lie outside the scissor's
    /// rows.
    #[inline(never)] // few lines, but for bands
    pub(crate) fn clipped(self, scissor: &Scissor) -> Self {
        let (columns, rows) = self.axes(scissor);
        let (first, end) = (self.first.max(columns.start), self.end.min(columns.end));
        if first >= end {
            return Self { end: self.first, ..self };
        }
        let line = self.part(first..end);
        // A column has a pixel in the rows if its middle lies in one of them or at most two rows beyond. The middle lies anywhere in
        // the first row.
        let [enters, leaves] = line.columns_of([rows.start - 3 - line.row, rows.end + 2 - line.row]);
        let start = (first + enters - 1).clamp(first, end);
        let mut line = line.part(start..(first + leaves + 2).clamp(start, end));
        let last = (line.middle(line.end - 1) >> 32) as i32;
        line.inside = line.row > rows.start + 1 && last < rows.end - 2;
        line
    }

    /// Whether a pixel of the line may lie in the scissor.
    #[inline(always)]
    pub(crate) fn meets(&self, scissor: &Scissor) -> bool {
        let (columns, rows) = self.axes(scissor);
        let last = (self.middle(self.end) >> 32) as i32;
        self.first < columns.end
            && self.end > columns.start
            && self.row - 2 < rows.end
            && last + 2 >= rows.start
    }

    /// The columns whose pixels all lie in the scissor's rows; a few of the outermost ones may be missing.
    #[inline(always)]
    pub(crate) fn interior(&self, scissor: &Scissor) -> Self {
        let (_, rows) = self.axes(scissor);
        let [enters, leaves] = self.columns_of([rows.start + 2 - self.row, rows.end - 3 - self.row]);
        let start = (self.first + enters + 2).min(self.end);
        Self { inside: true, ..self.part(start..(self.first + leaves).clamp(start, self.end)) }
    }

    /// The numbers of columns in which the middle moves by these numbers of rows, at most 2¹⁷: within 1, and 0 for rows below 0.
    #[inline(always)]
    fn columns_of(&self, rows: [i32; 2]) -> [i32; 2] {
        // 1/slope = mantissa · 2^(shift − 61) in 2²⁹, and `shift` is at least 2: 17 + 31 bits.
        let r = reciprocal(self.slope as i32);
        rows.map(|rows| (mul_wide(rows.max(0), r.mantissa) >> (32 - r.shift)).min(1 << 17) as i32)
    }

    /// The middle of the line in the middle of a column, in 2⁻³².
    #[inline(always)]
    fn middle(&self, column: i32) -> i64 {
        (i64::from(self.row) << 32) + i64::from(self.fraction) + self.distance(column - self.first)
    }

    /// These columns of the line.
    #[inline(always)]
    pub(crate) fn part(&self, columns: Range<i32>) -> Self {
        let middle = self.middle(columns.start);
        let (row, fraction) = ((middle >> 32) as i32, middle as u32);
        Self { row, fraction, first: columns.start, end: columns.end, ..*self }
    }

    /// The scissor's range along the major axis, and that along the minor axis in the line's rows.
    #[inline(always)]
    fn axes(&self, scissor: &Scissor) -> (Range<i32>, Range<i32>) {
        let (columns, rows) =
            if self.tall { (scissor.rows(), scissor.columns()) } else { (scissor.columns(), scissor.rows()) };
        (columns, if self.rises { -rows.end..-rows.start } else { rows })
    }

    /// The columns of the line, with the areas that a function gives for a fraction, as [`LineArea::column`] does. Rows may lie outside the
    /// scissor that the line was clipped to.
    #[inline(always)]
    pub(crate) fn columns_by<F: Fn(u32) -> [i32; PIXELS]>(
        &self,
        areas: F,
    ) -> impl Iterator<Item = Column> + use<F> {
        let (mut middle, slope) = (self.middle(self.first), i64::from(self.slope()));
        (self.first..self.end).map(move |column| {
            let first = (middle >> 32) as i32 - 2;
            let column = Column { column, first, areas: areas(middle as u32) };
            middle = middle.wrapping_add(slope);
            column
        })
    }

    /// The columns of the line, with exact areas.
    #[cfg(test)]
    pub(crate) fn columns(&self, area: &LineArea) -> impl Iterator<Item = Column> + use<> {
        let area = *area;
        self.columns_by(move |fraction| area.column(fraction))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::math::random::Random;
    use crate::raster::{areas_at, line_table, rests_of};
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
    fn parallelogram(a: [f64; 2], b: [f64; 2], beyond: f64) -> Option<[[f64; 2]; 4]> {
        let (a, b) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        let (first, end) = (a[0].floor() - beyond, b[0].floor() + 1.0 + beyond);
        let slope = (b[1] - a[1]) / (b[0] - a[0]);
        let half = (1.0 + slope * slope).sqrt() / 2.0;
        let y = |x: f64| a[1] + slope * (x - a[0]);
        let corners =
            [[first, y(first) - half], [end, y(end) - half], [end, y(end) + half], [first, y(first) + half]];
        (a[0] < b[0]).then_some(corners)
    }

    /// Larger than every line.
    const ALL: Scissor = Scissor::unclamped(-9000, -9000, 9000, 9000);

    #[test]
    fn areas_are_those_of_the_parallelogram_in_the_pixels() {
        let random = &mut Random(31);
        let (mut errors, mut partial) = ([0.0_f64; 4], 0);
        let tables = [8, 5].map(|bits| (line_table(bits), bits));
        for i in 0..20_000 {
            let reach = [700, 3_000, 12_000, 2_000_000, 8_388_000][i % 5];
            let mut ends = [(); 2].map(|()| [random.within(reach), random.within(reach)]);
            match i / 5 % 5 {
                0 => ends[1][1] = ends[0][1] + random.within(40), // almost level
                1 => ends[1] = [ends[0][0] + (ends[1][1] - ends[0][1]), ends[1][1]], // diagonal
                2 => ends[1][1] = ends[0][1],
                _ => {}
            }
            let clamped = |v: i32| v.clamp(-8_388_480, 8_388_480);
            let ends = ends.map(|[x, y]| [clamped(x), clamped(y)]);
            let beyond = (i / 25 % 2) as i32;
            let line = LineCoverage::new(ends, beyond, &ALL);
            let axes = |[x, y]: [i32; 2]| if line.tall { [y, x] } else { [x, y] };
            let [a, b] = ends.map(|end| axes(end).map(|v| f64::from(v) / 256.0));
            let Some(polygon) = parallelogram(a, b, beyond.into()) else { continue };
            assert_eq!((line.first, line.end), (polygon[0][0] as i32, polygon[1][0] as i32), "{ends:?}");
            let step = (line.end - line.first) as usize / 40 + 1;
            let offset = random.below(step as i64) as usize;
            let sample = (line.first..line.end).skip(offset).step_by(step);
            for column in sample.flat_map(|column| line.part(column..column + 1).columns(&line.area())) {
                let (fraction, slope) = (line.part(column.column..line.end).fraction, line.slope());
                let rough = tables.map(|(table, bits)| areas_at(rests_of(&table, slope)[0], fraction, bits));
                // Two more pixels on either side, where nothing is covered.
                for row in column.first - 2..column.first + 7 {
                    let slot = usize::try_from(row - column.first).ok();
                    let own = slot.and_then(|slot| column.areas.get(slot)).copied().unwrap_or(0);
                    let row = if line.rises { !row } else { row };
                    let exact = area_in_pixel(&polygon, column.column.into(), row.into());
                    assert!((0..=65536 + 8).contains(&own));
                    let by_table =
                        rough.map(|areas| slot.and_then(|slot| areas.get(slot)).copied().unwrap_or(0));
                    for (kind, own) in [(usize::from(i % 5 == 4), own), (2, by_table[0]), (3, by_table[1])] {
                        errors[kind] = errors[kind].max((f64::from(own) / 65536.0 - exact).abs());
                    }
                    partial += i32::from(exact > 0.01 && exact < 0.99);
                }
            }
        }
        // In the guard band, and up to 2¹⁶ columns; from the table of shares in 1/256, and in 1/32.
        for (largest, bound) in errors.into_iter().zip([1.0 / 4096.0, 1.0 / 4096.0, 0.03, 0.04]) {
            assert!(largest <= bound && 2.0 * largest > bound, "{errors:?}");
        }
        assert!(partial > 100_000, "{partial}");
    }

    #[test]
    fn a_clipped_line_has_the_columns_of_the_line() {
        let random = &mut Random(32);
        let (mut compared, mut interiors) = (0, 0);
        for i in 0..15_000 {
            let reach = [2_000, 20_000, 2_000_000][i % 3];
            let mut point = || [random.within(reach), random.within(reach)];
            let line = LineCoverage::new([point(), point()], (i % 2) as i32, &ALL);
            let [left, top] = [0; 2].map(|_| random.within(60));
            let (width, height) = (random.below(40) as i32 + 1, random.below(40) as i32 + 1);
            let scissor = Scissor::new(left, top, left + width, top + height);
            let (columns, rows) = line.axes(&scissor);
            let pixels = |column: Column| {
                let rows = rows.clone();
                let covered = (column.first..).zip(column.areas);
                let rows = covered.filter(move |(row, _)| rows.contains(row));
                rows.filter(|&(_, area)| area != 0).map(move |(row, area)| (column.column, row, area))
            };
            let all = line.columns(&line.area()).filter(|column| columns.contains(&column.column));
            let exact: Vec<_> = all.flat_map(pixels).collect();
            let clipped = line.clone().clipped(&scissor);
            let own: Vec<_> = clipped.columns(&line.area()).flat_map(pixels).collect();
            assert_eq!(own, exact);
            compared += exact.len();
            // Clipping leaves out most columns of which nothing lies in the scissor.
            let visited = i64::from(clipped.end - clipped.first);
            let mut useful: Vec<_> = exact.iter().map(|(column, ..)| column).collect();
            useful.dedup();
            let per_row = (1_i64 << 29) / i64::from(line.slope.max(1)) + 1;
            assert!(
                visited <= useful.len() as i64 + 16 * per_row + 16,
                "{visited} {} {per_row}",
                useful.len()
            );
            // All five pixels of a column of the interior, or of a line that is inside, lie in the scissor's rows: loops rely on
            // this.
            let within = |column: Column| column.first >= rows.start && column.first + 5 <= rows.end;
            assert!(!clipped.inside || clipped.columns(&line.area()).all(within));
            let interior = clipped.interior(&scissor);
            assert!(interior.columns(&line.area()).all(within));
            interiors += interior.columns(&line.area()).count();
            let [before, after] =
                [clipped.first..interior.first, interior.end..clipped.end].map(|part| clipped.part(part));
            let parts = before
                .columns(&line.area())
                .chain(interior.columns(&line.area()))
                .chain(after.columns(&line.area()));
            assert!(parts
                .map(|column| (column.column, column.areas))
                .eq(clipped.columns(&line.area()).map(|c| (c.column, c.areas))));
        }
        assert!(compared > 20_000 && interiors > 5_000, "{compared} {interiors}");
    }

    /// A line that is inside before clipping has no pixel outside the scissor.
    #[test]
    fn a_line_two_pixels_and_beyond_from_the_border_is_inside() {
        let random = &mut Random(33);
        let mut inside = 0;
        for _ in 0..40_000 {
            let scissor = Scissor::new(3, 5, 3 + 12, 5 + 11);
            let mut point = || [random.below(16 * 256) as i32, random.below(16 * 256) as i32];
            for beyond in [0, 1] {
                let line = LineCoverage::new([point(), point()], beyond, &scissor);
                if line.inside {
                    inside += 1;
                    let (columns, rows) = line.axes(&scissor);
                    assert!(columns.start <= line.first && line.end <= columns.end);
                    for column in line.columns(&line.area()) {
                        let mut covered = (column.first..).zip(column.areas).filter(|&(_, area)| area != 0);
                        assert!(covered.all(|(row, _)| rows.contains(&row)), "{line:?}");
                    }
                }
            }
        }
        assert!(inside > 1_000, "{inside}");
    }
}
