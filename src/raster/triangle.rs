//! Exact triangles, row by row.
//!
//! A row's covered pixels lie between two edges, and both ends are `⌈X − ½⌉` of an edge's
//! crossing X with the row of centres: the left end included, the right end excluded. That is
//! the top-left rule (R2–R5), and as the end depends on the edge alone, neighbours share it (R8).
//!
//! For an edge from p to q, `dy > 0`, at the n-th row of centres below p,
//!
//! ```text
//!     ⌈X − ½⌉ = c + ⌈(m + n·dx) / dy⌉,   m = ⌈(xr·dy + yr·dx) / 256⌉
//! ```
//!
//! where `p.x − 128 = 256·c + xr`, and yr in 0 … 255 leads from p to its first row of centres:
//! numerators on the lattice 1/256 may be rounded up first, since `⌈a/(256·b)⌉ = ⌈⌈a/256⌉/b⌉`. So
//! what is stepped, `T = (m + n·dx)/dy`, lies on the lattice of 1/dy. A fixed-point step whose sum
//! strays less than half a lattice unit rounds up exactly when half a unit is held back: the
//! proofs stand at [`Small`] (10.22, for triangles within 64 pixels) and [`Large`] (32.32). No
//! division, no 64-bit product per row.

use super::{Plane, Scissor, ScreenPoint, Span};
use crate::math::num::{mul_wide, reciprocal};

/// Twice the signed area in square sub-pixels: positive when the vertices run counter-clockwise
/// as seen with y up, which is what faces the viewer. Exact: |area| ≤ 2⁴⁵.
pub fn area([a, b, c]: &[ScreenPoint; 3]) -> i64 {
    // Differences below 2²³, products below 2⁴⁵.
    mul_wide(c.x - a.x, b.y - a.y) - mul_wide(b.x - a.x, c.y - a.y)
}

/// A triangle ready to be drawn.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Triangle {
    pub(super) corners: [ScreenPoint; 3],
    /// [`area`]; not zero.
    pub(super) area: i64,
    pub(super) viewport: Scissor,
}

impl Triangle {
    /// `area` is that of the corners, and not zero; pixels outside the viewport will not be asked for.
    #[inline(always)]
    pub(crate) fn new(corners: [ScreenPoint; 3], area: i64, viewport: &Scissor) -> Self {
        Self { corners, area, viewport: *viewport }
    }

    /// Its covered pixels inside the scissor, row by row.
    #[inline]
    pub(crate) fn fill<E>(
        &self,
        scissor: &Scissor,
        span: impl FnMut(Span) -> Result<(), E>,
    ) -> Result<(), E> {
        fill(self.corners, self.area > 0, scissor, span)
    }

    /// What varies linearly over it, for inks of one's own: values 0 … 2²⁴ − 1 at its corners, in their
    /// order; larger ones count as the largest.
    pub fn plane(&self, values: [u32; 3]) -> Plane {
        Plane::new(self, values.map(|value| value.min((1 << 24) - 1) as i32))
    }

    /// Whether all its edges are shorter than 512 pixels.
    pub(super) fn is_small(&self) -> bool {
        self.extent() < 1 << 17
    }

    /// A number with as many bits as the largest difference from its first corner has, in sub-pixels.
    pub(super) fn extent(&self) -> u32 {
        let [a, b, c] = self.corners;
        let (dx1, dy1) = (b.x - a.x, b.y - a.y);
        let (dx2, dy2) = (c.x - a.x, c.y - a.y);
        (dx1.abs() | dx2.abs() | dy1.abs() | dy2.abs()).unsigned_abs()
    }
}

/// Walks the covered pixels inside the scissor, one span a row, top to bottom: rules R1 to R9.
///
/// # Errors
///
/// The first error of `span`, which ends the walk.
///
/// ```
/// use pinhole::raster::{triangle, Scissor, ScreenPoint};
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let scissor = Scissor::new(0, 0, 16, 16);
/// let mut rows = Vec::new();
/// triangle([corner(0, 0), corner(4, 0), corner(0, 4)], &scissor, |s| -> Result<(), ()> {
///     rows.push((s.y, s.x, s.width));
///     Ok(())
/// })?;
/// // The slanted edge passes through centres and is a right edge: they are not covered.
/// assert_eq!(rows, [(0, 0, 3), (1, 0, 2), (2, 0, 1)]);
/// # Ok::<(), ()>(())
/// ```
pub fn triangle<E>(
    vertices: [ScreenPoint; 3],
    scissor: &Scissor,
    span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    let area = area(&vertices);
    if area == 0 {
        return Ok(()); // R6
    }
    fill(vertices, area > 0, scissor, span)
}

/// [`triangle`] for callers that know the winding: `front` tells whether [`area`] is positive; it
/// is not zero.
#[inline]
fn fill<E>(
    [mut a, mut b, mut c]: [ScreenPoint; 3],
    front: bool,
    scissor: &Scissor,
    span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    // Down the screen; each exchange turns the winding over.
    let mut turned = !front;
    if b.y < a.y {
        (a, b, turned) = (b, a, !turned);
    }
    if c.y < b.y {
        (b, c, turned) = (c, b, !turned);
        if b.y < a.y {
            (a, b, turned) = (b, a, !turned);
        }
    }
    // Counter-clockwise with y up, a on top and c at the bottom: b lies to the left of a–c.
    let b_left = !turned;
    // Both others within half of it from a: then no edge is wider than all of it.
    let wide = (b.x - a.x).abs().max((c.x - a.x).abs());
    if c.y - a.y < Small::REACH && wide < Small::REACH / 2 {
        walk::<Small, E>([a, b, c], b_left, scissor, span)
    } else {
        walk::<Large, E>([a, b, c], b_left, scissor, span)
    }
}

/// Row by row from a, on top, to c.
#[inline(always)]
fn walk<S: Edge, E>(
    [a, b, c]: [ScreenPoint; 3],
    b_left: bool,
    scissor: &Scissor,
    mut span: impl FnMut(Span) -> Result<(), E>,
) -> Result<(), E> {
    let middle = first_row(b);
    let end = first_row(c).min(scissor.bottom);
    let mut row = first_row(a).max(scissor.top);
    while row < end {
        let stretch = end.min(row + S::ROWS);
        let long = S::new(a, c, row);
        let (mut left, mut right) = (long, long);
        for (from, to, until) in [(a, b, middle.min(stretch)), (b, c, stretch)] {
            if row >= until {
                continue;
            }
            let short = S::new(from, to, row);
            if b_left {
                left = short;
            } else {
                right = short;
            }
            while row < until {
                let x = left.pixel().max(scissor.left);
                let width = right.pixel().min(scissor.right) - x;
                if width > 0 {
                    span(Span { x, y: row, width, height: 1 })?;
                }
                left.advance();
                right.advance();
                row += 1;
            }
        }
    }
    Ok(())
}

/// The first row whose centres are not above the point: `⌈y − ½⌉`.
fn first_row(p: ScreenPoint) -> i32 {
    (p.y + 127) >> 8
}

/// An edge on its way down.
trait Edge: Copy {
    /// How many rows it may be stepped: beyond, it is set up anew.
    const ROWS: i32;

    /// The edge from `p` down to `q` at `row`, which lies at or below p's first row and above
    /// q's; so `q.y > p.y`.
    fn new(p: ScreenPoint, q: ScreenPoint, row: i32) -> Self;

    /// The end of the row's span.
    fn pixel(&self) -> i32;

    /// To the next row.
    fn advance(&mut self);
}

/// c, m and the number of rows from p's first one: see the head of this file.
#[inline(always)]
fn lattice(p: ScreenPoint, (dx, dy): (i32, i32), row: i32) -> (i32, i32, i32) {
    let (column, xr) = ((p.x - 128) >> 8, (p.x - 128) & 255);
    let first = first_row(p);
    let yr = first * 256 + 128 - p.y; // 0 … 255
    let m = (xr * dy + yr * dx + 255) >> 8; // two products of at most 255·2²²: below 2³¹
    (column, m, row - first) // 0 … 2¹⁴ rows
}

/// An edge of a triangle within 64 pixels, in 32 bits.
///
/// |dx|, dy < 2¹⁴, hence n ≤ 65, |m| < 2¹⁵ and |T| < 2⁷. With the reciprocal's relative error of
/// 2⁻²⁸ and one rounding each, the start is off by less than `|m|/dy·2⁻²⁸ + 2⁻²²` and the step by
/// less than `|dx|/dy·2⁻²⁸ + 2⁻²²`. After n rows the sum is off by less than
/// `((|m| + n·|dx|)·2⁻²⁸ + (n + 1)·dy·2⁻²²) / dy < (2⁻⁷·⁸ + 0.26) / dy`, and half a lattice unit,
/// `½ / dy`, is rounded by less than `2⁻²² + 2⁻²⁹/dy`, which is `2⁻⁷·⁹ / dy`. Where the step leaves
/// 32 bits the edge ends in its first row, and it is not used.
#[derive(Clone, Copy)]
struct Small {
    /// T and one whole, less half a lattice unit: 10.22.
    x: i32,
    step: i32,
    column: i32,
}

impl Small {
    /// In sub-pixels.
    const REACH: i32 = 1 << 14;
}

impl Edge for Small {
    const ROWS: i32 = i32::MAX >> 1; // all of them

    #[inline(always)]
    fn new(p: ScreenPoint, q: ScreenPoint, row: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y);
        let (column, m, below) = lattice(p, (dx, dy), row);
        let r = reciprocal(dy);
        // 1/dy in 2⁻²² is mantissa · 2^(shift − 39), 17 ≤ shift ≤ 30.
        let by_dy = |v: i32| (mul_wide(v, r.mantissa) >> (39 - r.shift.min(30))) as i32;
        let half = r.mantissa >> (40 - r.shift.min(30)).min(31);
        let step = by_dy(dx);
        let start = by_dy(m).wrapping_add(step.wrapping_mul(below));
        Self { x: start.wrapping_add((1 << 22) - half), step, column }
    }

    #[inline(always)]
    fn pixel(&self) -> i32 {
        self.column + (self.x >> 22)
    }

    #[inline(always)]
    fn advance(&mut self) {
        self.x = self.x.wrapping_add(self.step);
    }
}

/// Any edge inside the guard band, in 64 bits.
#[derive(Clone, Copy)]
struct Large {
    /// The end of the current row's span is the integer part: 32.32.
    x: i64,
    /// Per row.
    step: i64,
}

impl Edge for Large {
    const ROWS: i32 = 512;

    /// **Short edges** (|dx|, dy < 2¹⁷, that is 512 pixels, hence n ≤ 513). With the reciprocal's
    /// relative error of 2⁻²⁸ and one rounding each, the start is off by less than
    /// `|m|/dy · 2⁴ + 1` and the step by less than `|dx|/dy · 2⁴ + 1`, in 2⁻³². After n rows the
    /// sum is off by less than `((|m| + n·|dx|) · 2⁴ + (n + 1)·dy) / dy`, where |m| ≤ 2¹⁸,
    /// n·|dx| < 2²⁶·⁰¹ and (n + 1)·dy < 2²⁶·⁰¹: less than `2³⁰·² / dy`. Half a lattice unit is
    /// `2³¹ / dy`, and its own rounding takes less than `(2³ + dy) / dy` of it.
    ///
    /// **Long edges** start and step by exact division, each rounded down: off by less than n + 1
    /// after n ≤ 512 rows, where half a lattice unit is at least 2³¹/2²² = 512 = 2⁹. The first
    /// row is exact and the last is n = 511.
    #[inline]
    fn new(p: ScreenPoint, q: ScreenPoint, row: i32) -> Self {
        let (dx, dy) = (q.x - p.x, q.y - p.y); // |dx|, dy ≤ 2²²
        let (column, m, below) = lattice(p, (dx, dy), row);
        const SHORT: i32 = 1 << 17;
        let r = reciprocal(dy); // 1/dy = mantissa · 2^(shift − 61)
                                // Half a lattice unit held back from one whole: ⌊T + 1 − 1/(2·dy)⌋ = ⌈T⌉.
        let half = i64::from(r.mantissa >> (30 - r.shift.min(30)));
        let bias = (1 << 32) - half;
        let (start, step) = if dx.abs() < SHORT && dy < SHORT {
            // 1/dy in 2⁻³² is mantissa · 2^(shift − 29); products of 18 + 31 bits, dy ≥ 1 and so
            // shift ≤ 30. Shifted left by 1 first, the right shift is never negative.
            let by_dy = |v: i32| (mul_wide(v, r.mantissa) << 1) >> (30 - r.shift.min(30));
            let step = by_dy(dx);
            // Rows that the scissor skips: |step| < 2⁵⁰, below ≤ 513. |T| < 2¹⁸ keeps the sum small.
            (by_dy(m) + if below == 0 { 0 } else { step * i64::from(below) }, step)
        } else {
            let at_row = i64::from(m) + i64::from(dx) * i64::from(below); // < 2³⁷
            (divide_32_32(at_row, dy), divide_32_32(i64::from(dx), dy))
        };
        Self { x: (i64::from(column) << 32) + start + bias, step }
    }

    #[inline(always)]
    fn pixel(&self) -> i32 {
        (self.x >> 32) as i32
    }

    #[inline(always)]
    fn advance(&mut self) {
        self.x = self.x.wrapping_add(self.step);
    }
}

/// `⌊n · 2³² / d⌋` for |n| < 2³⁸ and d > 0, by long division: 70 steps, for edges that are rare.
#[cold]
fn divide_32_32(n: i64, d: i32) -> i64 {
    let (d, magnitude) = (u64::from(d.unsigned_abs()), n.unsigned_abs());
    let (mut quotient, mut rest) = (0u64, 0u64);
    for bit in (-32..38).rev() {
        let digit = if bit >= 0 { (magnitude >> bit) & 1 } else { 0 };
        rest = (rest << 1) | digit; // rest < 2·d
        quotient = quotient.wrapping_shl(1); // |n|/d < 2³¹ for all edges: no bit is lost
        if rest >= d {
            rest = rest.wrapping_sub(d);
            quotient |= 1;
        }
    }
    let quotient = quotient as i64;
    if n < 0 {
        -quotient - i64::from(rest > 0)
    } else {
        quotient
    }
}
