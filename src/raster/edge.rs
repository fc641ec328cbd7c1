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
//! `⌈a/(256·b)⌉ = ⌈⌈a/256⌉/b⌉`; so T is a multiple of 1/dy.
//!
//! An [`Edge`] has ⌈T⌉ as an integer t and an error term `e = t·dy − (m + n·dx)`, one of 0 … dy − 1. With `dx = s·dy + r`,
//! 0 ≤ r < dy, the next row has t + s and e − r, or, if that is negative, t + s + 1 and e − r + dy: no value is rounded. This is the
//! midpoint algorithm for lines, with integer steps s. (J. E. Bresenham, *Algorithm for computer control of a digital plotter*,
//! 1965.) `fast/edge20.rs` has rounded numbers in place of t and e, for triangles of few rows.

use super::ScreenPoint;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::keep_branch;
use crate::math::num::divide_floor;

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

/// An edge of any triangle inside the guard band.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The end of the span in the present row: c + t.
    column: i32,
    /// e, at most 2²² like dy.
    error: i32,
    /// s and r: the change of the column from a row to the next, and of the error.
    step: i32,
    rest: i32,
    dy: i32,
}

impl Edge {
    /// The most rows that a division passes over: 511·r < 2³¹, as r < 2²².
    const ROWS: i32 = 511;
    /// The most columns that a division passes over, less one: 510·dy + e < 2³¹.
    const COLUMNS: i32 = 510;

    /// Becomes the edge from `p` down to `q` at `row`, which is p's first row or below and above q's first row; so `q.y > p.y`.
    /// Columns are counted from the target's origin.
    #[inline(never)]
    pub(crate) fn set_up(&mut self, p: &ScreenPoint, q: &ScreenPoint, row: i32) {
        *self = Self::at_first_row(p, q, divide_floor);
        let below = row - first_row(p);
        if below > 0 {
            self.advance(below);
        }
    }

    /// The edge from `p` down to `q` at p's first row, given a function for ⌊n / d⌋ and its remainder.
    #[inline(always)]
    pub(crate) fn at_first_row(
        p: &ScreenPoint,
        q: &ScreenPoint,
        divide: impl Fn(i32, i32) -> (i32, i32),
    ) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (less, error) = divide(-numerator(distances_to_centre(p), dx, dy), dy);
        // Most edges of a fine mesh meet one row: they need no step.
        let (step, rest) = if first_row(q) - first_row(p) > 1 { divide(dx, dy) } else { (0, 0) };
        Self { column: base_column(p) - less, error, step, rest, dy }
    }

    /// The edge with columns as indices of a buffer, whose first row begins at `start` and whose rows are `stride` apart.
    #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
    #[inline(always)]
    pub(crate) fn as_indices(self, start: usize, stride: usize) -> Self {
        let (column, step) = (self.column.wrapping_add(start as i32), self.step.wrapping_add(stride as i32));
        Self { column, step, ..self }
    }

    /// A vertical edge: all spans end at `column`.
    pub(crate) fn vertical(column: i32) -> Self {
        Self { column, error: 0, step: 0, rest: 0, dy: 1 }
    }

    /// The end of the span in the present row.
    #[inline(always)]
    pub(crate) fn column(&self) -> i32 {
        self.column
    }

    /// Whether the spans of all rows end at the present column.
    #[inline(always)]
    pub(crate) fn is_vertical(&self) -> bool {
        self.step | self.rest == 0
    }

    /// Moves the edge down by `rows` rows, which it meets.
    #[inline(never)] // code size
    fn advance(&mut self, mut rows: i32) {
        loop {
            let part = rows.min(Self::ROWS);
            // As the edge meets these rows, |part·step| is at most 2²² + 2¹⁵.
            let (less, error) = divide_floor(self.error - part * self.rest, self.dy);
            self.column += part * self.step - less;
            self.error = error;
            rows -= part;
            if rows <= 0 {
                return;
            }
        }
    }

    /// The number of rows, at most `rows`, until the edge reaches `column` from the left, or passes it from the right.
    ///
    /// With D = column − 1 − c − t ≥ 0, the edge reaches the column in the first row k with `k·dx > D·dy + e`. With
    /// D = c + t − column ≥ 0, it passes the column in the first row k with `−k·dx > D·dy + dy − 1 − e`.
    pub(crate) fn rows_before(mut self, column: i32, rows: i32) -> i32 {
        let dx = self.step * self.dy + self.rest;
        let mut passed = 0;
        while passed < rows {
            let (distance, error) = match dx >= 0 {
                true => (column - 1 - self.column, self.error),
                false => (self.column - column, self.dy - 1 - self.error),
            };
            if dx == 0 || distance < 0 {
                // The edge never reaches the column, or reached it in the row that the edge has been moved to.
                return if passed == 0 { rows } else { passed };
            }
            let part = distance.min(Self::COLUMNS);
            let (less, _) = divide_floor(part * self.dy + error, dx.abs());
            let next = (less + 1).min(rows - passed);
            passed += next;
            if part == distance {
                break;
            }
            self.advance(next);
        }
        passed
    }
}

impl EdgeWalker for Edge {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let column = self.column;
        self.column = self.column.wrapping_add(self.step);
        let (error, borrows) = (self.error as u32).overflowing_sub(self.rest as u32);
        self.error = error as i32;
        // The carry flag of the subtraction says whether it borrows: S2 takes 4 % fewer instructions on an M3 than by the sign, and 5 % more
        // on an M0.
        let is_negative = if CORTEX_M0 { self.error < 0 } else { borrows };
        if is_negative {
            keep_branch();
            self.error += self.dy;
            self.column = self.column.wrapping_add(1);
        }
        column
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

    /// ⌈X − ½⌉ of a row in integers: X − ½ is in 2⁻⁸/dy pixel.
    fn end(p: &ScreenPoint, q: &ScreenPoint, row: i32) -> i32 {
        let (dx, dy) = (i64::from(q.x - p.x), i64::from(q.y - p.y));
        let x = (i64::from(p.x) - 128) * dy + (i64::from(row) * 256 + 128 - i64::from(p.y)) * dx;
        -(-x).div_euclid(256 * dy) as i32
    }

    /// Edges of all sizes in the guard band: walked from any row on, moved on by any number of rows, and where they meet a column.
    #[test]
    fn ends_of_rows_are_exact() {
        let random = &mut Random(10);
        let extents = [40, 300, 8192, 131_071, 1 << 20, 1 << 21];
        let (mut crossings, mut far) = (0, 0);
        for i in 0..60_000 {
            let (width, height) = (extents[i % 6], extents[i / 6 % 6]);
            let mut corner = |sign: i32| match i / 36 % 4 {
                0 => (sign * width as i32, sign.abs() * height as i32 * sign),
                1 => (-sign * width as i32, sign * height as i32),
                _ => (random.within(width), random.within(height)),
            };
            let [p, q] = [corner(-1), corner(1)].map(|(x, y)| ScreenPoint::inside(x, y));
            let (p, q) = if p.y < q.y { (p, q) } else { (q, p) };
            let (first, last) = (first_row(&p), first_row(&q) - 1);
            if first > last {
                continue;
            }
            let mut row = first + random.below(i64::from(last - first) + 1) as i32;
            let mut edge = Edge::vertical(0);
            edge.set_up(&p, &q, row);
            while row <= last {
                assert_eq!(edge.column(), end(&p, &q, row), "{p:?} {q:?} {row}");
                match random.below(8) {
                    0 => {
                        let rows = 1 + random.below(i64::from(last - row) + 1) as i32;
                        edge.advance(rows);
                        row += rows;
                    }
                    _ => {
                        assert_eq!(edge.next(), end(&p, &q, row));
                        row += 1;
                    }
                }
            }
            let mut edge = Edge::vertical(0);
            edge.set_up(&p, &q, first);
            let column = match i % 3 {
                0 => edge.column() + random.within(3),
                1 => random.within(9000),
                _ => end(&p, &q, first + random.below(i64::from(last - first) + 1) as i32) + random.within(1),
            };
            let rows = last - first + 1;
            let before = edge.rows_before(column, rows);
            // Ends of rows ascend or descend.
            let is_right = |row: i32| end(&p, &q, row) >= column;
            assert_eq!(is_right(first), is_right(first + before - 1), "{p:?} {q:?} {column} {before}");
            if before < rows {
                assert_ne!(is_right(first), is_right(first + before), "{p:?} {q:?} {column} {before}");
                crossings += 1;
                far += u32::from((edge.column() - column).abs() > 2 * Edge::COLUMNS);
            } else {
                assert_eq!(is_right(first), is_right(last));
            }
        }
        assert!(crossings > 10_000 && far > 1_000, "{crossings} {far}");
    }
}
