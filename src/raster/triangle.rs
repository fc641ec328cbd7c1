//! Exact triangles, row by row.
//!
//! A row's covered pixels lie between two edges, and both ends are `⌈X − ½⌉` of an edge's
//! crossing X with the row of centres: the left end included, the right end excluded. That is
//! the top-left rule (R2–R5), and as the end depends on the edge alone, neighbours share it (R8).
//! [`Side`] has it exactly, by one addition a row.

use super::edge::{column, first_row, Side, Wide};
use super::{Plane, Planes, Scissor, ScreenPoint, Span};
use crate::math::num::mul_wide;
use core::num::NonZeroU32;

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
    Rows::new(&vertices, area > 0, scissor).spans().try_for_each(span)
}

/// Rows that follow each other, between two sides that do not bend there and lie inside the scissor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// The column that the sides are counted from.
    pub(crate) x: i32,
    /// The next row.
    pub(crate) y: i32,
    /// How many: may be none, or less.
    pub(crate) rows: i32,
    /// Left and right.
    pub(crate) sides: [Side; 2],
}

impl Stretch {
    const NONE: Self = Self { x: 0, y: 0, rows: 0, sides: [Side::NONE; 2] };

    /// The covered pixels of the next row, from the column counted from; there may be none. Then to the row below.
    #[inline(always)]
    pub(crate) fn row(&mut self) -> (i32, i32) {
        let [left, right] = &mut self.sides;
        let ends = (left.at >> 20, right.at >> 20);
        left.at = left.at.wrapping_add(left.step);
        right.at = right.at.wrapping_add(right.step);
        ends
    }
}

/// The rows of a triangle, on the way down, in stretches or span by span.
pub struct Rows {
    /// Those above and below the middle corner, for most triangles.
    halves: [Stretch; 2],
    next: usize,
    /// What other triangles take.
    more: Option<Many>,
}

impl Rows {
    /// `front` tells whether [`area`] is positive; it is not zero.
    #[inline(never)]
    pub(crate) fn new(&[mut a, mut b, mut c]: &[ScreenPoint; 3], front: bool, scissor: &Scissor) -> Self {
        let (left, right) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
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
        let middle_left = !turned;
        // Ends lie within a column of the corners.
        let inside = left >= scissor.left * 256 && right <= scissor.right * 256;
        let (width, height) = (right - left, c.y - a.y);
        // All rows of these may be stepped through.
        if !(inside && height < 1 << 14 && width < Side::WIDTH) {
            return Self::of(Some(Many::new([a, b, c], middle_left, scissor)));
        }
        let (first, middle) = (first_row(&a), first_row(&b));
        let (row, end) = (first.max(scissor.top), first_row(&c).min(scissor.bottom));
        if row >= end {
            return Self::of(None);
        }
        let origin = column(&a);
        if width.max(height) < Side::TINY && row == first {
            halves(row, middle, end, origin, middle_left, |side, _| match side {
                Corners::Long => Side::tiny(&a, &c, 0),
                Corners::Upper => Side::tiny(&a, &b, 0),
                Corners::Lower => Side::tiny(&b, &c, column(&b) - origin),
            })
        } else {
            halves(row, middle, end, origin, middle_left, |side, row| match side {
                Corners::Long => Side::new(&a, &c, row, origin),
                Corners::Upper => Side::new(&a, &b, row, origin),
                Corners::Lower => Side::new(&b, &c, row, origin),
            })
        }
    }

    /// Without halves.
    #[cold]
    fn of(more: Option<Many>) -> Self {
        Self { halves: [Stretch::NONE; 2], next: 2, more }
    }

    /// Whether there is no row.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.next == 2 && self.more.as_ref().is_none_or(|many| many.row >= many.end)
    }

    /// Span by span.
    #[inline(always)]
    pub(crate) fn spans(&mut self) -> Spans<'_> {
        Spans { rows: self, stretch: Stretch::NONE }
    }

    /// The next stretch, which may have no rows.
    #[inline(always)]
    pub(crate) fn stretch(&mut self) -> Option<&Stretch> {
        let Self { halves, next, more } = self;
        let at = *next;
        if at < 2 {
            *next = at + 1;
        } else {
            *halves.first_mut()? = more.as_mut()?.advance()?;
        }
        halves.get(at & 1)
    }
}

/// Which corners a side connects: the first and the last down the screen, or one of these and the middle one.
enum Corners {
    Long,
    Upper,
    Lower,
}

/// The rows above the middle corner's, and those below.
#[inline(always)]
fn halves(
    row: i32,
    middle: i32,
    end: i32,
    origin: i32,
    middle_left: bool,
    side: impl Fn(Corners, i32) -> Side,
) -> Rows {
    let mut long = side(Corners::Long, row);
    let short_index = usize::from(!middle_left);
    let mut half = |row: i32, until: i32, corners: Corners| {
        let rows = until - row;
        let mut sides = [long; 2];
        if rows > 0 {
            sides[short_index & 1] = side(corners, row);
            long.at = long.at.wrapping_add(long.step.wrapping_mul(rows));
        }
        Stretch { x: origin + 1, y: row, rows, sides }
    };
    let upper = half(row, middle.min(end), Corners::Upper);
    let lower = half(row.max(middle), end, Corners::Lower);
    Rows { halves: [upper, lower], next: 0, more: None }
}

/// The stretches of triangles that are high, large or cut by the scissor.
struct Many {
    /// At `row`.
    left: Side,
    right: Side,
    /// The next row, the first at which a side is to be set up anew, the one at which the long side is, and the end.
    row: i32,
    until: i32,
    long_until: i32,
    end: i32,
    /// That the sides are counted from.
    column: i32,
    /// The scissor's columns.
    from: i32,
    to: i32,
    /// Too large for [`Side`].
    large: bool,
    /// Whether the middle corner lies to the left of the edge between the others.
    middle_left: bool,
    /// Down the screen.
    corners: [ScreenPoint; 3],
    /// The sides of a large triangle, and the column from which a row of it goes on.
    wide: [Wide; 2],
    resume: i32,
}

/// The widest piece that a stretch can hold.
const PIECE: i32 = 2047;

impl Many {
    #[inline(never)]
    fn new(corners: [ScreenPoint; 3], middle_left: bool, scissor: &Scissor) -> Self {
        let reach = Scissor::of(&corners);
        let [a, b, c] = &corners;
        let small = c.y - a.y < Side::HEIGHT && (b.x - a.x).abs().max((c.x - a.x).abs()) < Side::WIDTH;
        let beside = reach.left >= scissor.right || reach.right <= scissor.left;
        Self {
            left: Side::NONE,
            right: Side::NONE,
            row: reach.top.max(scissor.top),
            until: i32::MIN,
            long_until: i32::MIN,
            end: if beside { i32::MIN } else { reach.bottom.min(scissor.bottom) },
            column: column(a),
            from: scissor.left,
            to: scissor.right,
            large: !small,
            middle_left,
            corners,
            wide: [Wide::default(); 2],
            resume: scissor.left,
        }
    }

    #[inline(never)]
    fn advance(&mut self) -> Option<Stretch> {
        if self.row >= self.end {
            return None;
        }
        if self.large {
            return Some(self.large_row());
        }
        if self.row >= self.until {
            self.set_up();
        }
        let Self { left, right, row, until, column, .. } = *self;
        let stretch = self.inside(Stretch { x: column + 1, y: row, rows: until - row, sides: [left, right] });
        let rows = stretch.rows;
        self.row += rows;
        for side in [&mut self.left, &mut self.right] {
            side.at = side.at.wrapping_add(side.step.wrapping_mul(rows));
        }
        Some(stretch)
    }

    /// Sets up the sides for the rows that follow.
    fn set_up(&mut self) {
        let Self { left, right, corners: [a, b, c], row, column, .. } = self;
        let (row, column) = (*row, *column);
        let (short, long) = if self.middle_left { (left, right) } else { (right, left) };
        let (from, to, end) = short_side(a, b, c, row);
        *short = Side::new(from, to, row, column);
        // Where the sides bend, the long one goes on.
        if row >= self.long_until {
            *long = Side::new(a, c, row, column);
            self.long_until = row + Side::rows(c.y - a.y);
        }
        self.until = end.min(self.end).min(self.long_until);
    }

    /// The stretch cut to the scissor: what lies outside becomes a vertical side, as far as it stays outside.
    #[inline(never)]
    fn inside(&self, mut stretch: Stretch) -> Stretch {
        let Stretch { x, rows, sides: [left, right], .. } = &mut stretch;
        // They overlap the triangle's columns: less than 2¹¹ from its own, so that 12 bits hold what counts.
        let fixed = |column: i32| (column - *x).clamp(-PIECE, PIECE) << 20;
        let (from, to) = (fixed(self.from), fixed(self.to));
        // The rows on which a side stays on the side of `limit` where it is; there, if that is `outside`, it is the limit.
        let mut cut = |side: &mut Side, limit: i32, outside: bool| {
            let (below, step) = (side.at < limit, side.step);
            let ahead =
                if below { limit.wrapping_sub(1).wrapping_sub(side.at) } else { side.at.wrapping_sub(limit) };
            if step != 0 && below == (step > 0) {
                let step = NonZeroU32::new(step.unsigned_abs()).unwrap_or(NonZeroU32::MIN);
                // A distance in 12.20: 32 bits without a sign. There are fewer than 2¹⁶ rows.
                *rows = (*rows).min((ahead as u32 / step).min(1 << 16) as i32 + 1);
            }
            if below == outside {
                *side = Side { at: limit, step: 0 };
            }
        };
        cut(left, from, true);
        cut(right, to, false);
        stretch
    }

    /// A row of a large triangle, or a piece of it.
    #[inline(never)]
    fn large_row(&mut self) -> Stretch {
        let Self { corners: [a, b, c], row, from, to, .. } = *self;
        if row >= self.until {
            let [left, right] = &mut self.wide;
            let (short, long) = if self.middle_left { (left, right) } else { (right, left) };
            let (p, q, end) = short_side(&a, &b, &c, row);
            short.set(p, q, row);
            long.set(&a, &c, row);
            self.until = end.min(self.end).min(row + Wide::ROWS);
        }
        let [mut left, mut right] = self.wide;
        let x = left.next().max(self.resume);
        let width = right.next().min(to) - x;
        if width > PIECE {
            self.resume = x + PIECE;
        } else {
            (self.resume, self.row, self.wide) = (from, row + 1, [left, right]);
        }
        let right = Side { at: width.clamp(0, PIECE) << 20, step: 0 };
        Stretch { x, y: row, rows: 1, sides: [Side::NONE, right] }
    }
}

/// The ends of the side with the middle corner at this row, and the row where it ends.
#[inline(always)]
fn short_side<'p>(
    a: &'p ScreenPoint,
    b: &'p ScreenPoint,
    c: &'p ScreenPoint,
    row: i32,
) -> (&'p ScreenPoint, &'p ScreenPoint, i32) {
    let middle = first_row(b);
    if row < middle {
        (a, b, middle)
    } else {
        (b, c, i32::MAX)
    }
}

/// The spans of stretches.
pub(crate) struct Spans<'r> {
    rows: &'r mut Rows,
    stretch: Stretch,
}

impl Iterator for Spans<'_> {
    type Item = Span;

    /// Not part of the loops that draw: there are many of them.
    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        loop {
            while self.stretch.rows > 0 {
                let (left, right) = self.stretch.row();
                let Stretch { x, y, .. } = self.stretch;
                self.stretch.rows -= 1;
                self.stretch.y += 1;
                if right > left {
                    return Some(Span { x: x + left, y, width: right - left, height: 1 });
                }
            }
            self.stretch = *self.rows.stretch()?;
        }
    }
}
