//! Exact triangles, row by row.
//!
//! A row's covered pixels lie between two edges, and both ends are `⌈X − ½⌉` of an edge's
//! crossing X with the row of centres: the left end included, the right end excluded. That is
//! the top-left rule (R2–R5), and as the end depends on the edge alone, neighbours share it (R8).
//! [`Edge`] has it exactly, by one addition a row.

use super::edge::{first_row, Edge};
use super::{Plane, Planes, Scissor, ScreenPoint, Span};
use crate::math::num::mul_wide;

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
    #[inline(always)]
    pub(crate) fn rows(&self, scissor: &Scissor) -> Rows {
        Rows::new(&self.corners, self.area > 0, scissor)
    }

    /// What varies linearly over it, for inks of one's own: values 0 … 2²⁴ − 1 at its corners, in their
    /// order; larger ones count as the largest.
    pub fn plane(&self, values: [u32; 3]) -> Plane {
        Planes::new(self).through(&values.map(|value| value.min((1 << 24) - 1) as i32))
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
    Rows::new(&vertices, area > 0, scissor).try_for_each(span)
}

/// The spans of a triangle, on the way down in stretches of rows between the same two edges.
pub(crate) struct Rows {
    /// At `row`.
    left: Edge,
    right: Edge,
    /// The scissor's columns.
    from: i32,
    to: i32,
    /// The next row, the end of the stretch, and that of the triangle or of the scissor.
    row: i32,
    until: i32,
    end: i32,
    /// Of the row before, its first covered pixel and how many there are.
    x: i32,
    width: i32,
    /// Whether the middle corner lies to the left of the edge between the others.
    middle_left: bool,
    /// Down the screen.
    corners: [ScreenPoint; 3],
}

impl Rows {
    /// `front` tells whether [`area`] is positive; it is not zero.
    #[inline(never)]
    fn new(&[mut a, mut b, mut c]: &[ScreenPoint; 3], front: bool, scissor: &Scissor) -> Self {
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
        Self {
            left: Edge::default(),
            right: Edge::default(),
            from: scissor.left,
            to: scissor.right,
            row: first_row(&a).max(scissor.top),
            until: i32::MIN,
            end: first_row(&c).min(scissor.bottom),
            x: 0,
            width: 0,
            // Counter-clockwise with y up, a on top and c at the bottom: b lies to the left of a–c.
            middle_left: !turned,
            corners: [a, b, c],
        }
    }

    /// Whether there is no row.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// To the next row with covered pixels; `false` when there is none. Not part of the loops that draw: these
    /// leave no registers for it, and there are many of them.
    #[inline(never)]
    fn advance(&mut self) -> bool {
        loop {
            while self.row < self.until {
                self.row += 1;
                self.x = self.left.pixel().max(self.from);
                self.width = self.right.pixel().min(self.to) - self.x;
                self.left.advance();
                self.right.advance();
                if self.width > 0 {
                    return true;
                }
            }
            if self.is_empty() {
                return false;
            }
            self.stretch();
        }
    }

    /// Sets up the edges for the rows that follow.
    #[inline(never)]
    fn stretch(&mut self) {
        let Self { left, right, corners: [a, b, c], row, .. } = self;
        let (row, middle) = (*row, first_row(b));
        let (short, long) = if self.middle_left { (left, right) } else { (right, left) };
        let (from, to, until) = if row < middle { (&*a, &*b, middle) } else { (&*b, &*c, self.end) };
        short.set(from, to, row);
        // Where the sides bend, the long edge goes on.
        if row != middle || row != self.until {
            long.set(a, c, row);
        }
        self.until = until.min(self.end).min(row + Edge::ROWS);
    }
}

impl Iterator for Rows {
    type Item = Span;

    #[inline(always)]
    fn next(&mut self) -> Option<Span> {
        self.advance().then(|| Span { x: self.x, y: self.row - 1, width: self.width, height: 1 })
    }
}
