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
    pub(crate) fn spans(&self, scissor: &Scissor) -> Spans {
        Spans::new(self, scissor)
    }

    /// What varies linearly over it, for inks of one's own: values 0 … 2²⁴ − 1 at its corners, in their
    /// order; larger ones count as the largest.
    pub fn plane(&self, values: [u32; 3]) -> Plane {
        Planes::new(self).through(&values.map(|value| value.min((1 << 24) - 1) as i32))
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
    match area(&vertices) {
        0 => Ok(()), // R6
        area => Triangle::new(vertices, area, scissor).spans(scissor).try_for_each(span),
    }
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

/// The two stretches of a small triangle inside the scissor, above and below the middle corner: most triangles are that,
/// and their way is short, to be part of the loops that draw.
pub(crate) struct Halves {
    /// The ends of the side, or of two sides, with the middle corner, from the stretch on that is next.
    ends: [ScreenPoint; 3],
    /// The next row, and there the side between the first and the last corner.
    row: i32,
    long: Side,
    /// That the sides are counted from.
    column: i32,
    middle_left: bool,
}

impl Halves {
    /// `None` for all other triangles.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle, scissor: &Scissor) -> Option<Self> {
        let [p, q, r] = &triangle.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (ends, middle_left) = down(triangle);
        let [a, _, c] = &ends;
        // Ends lie within a column of the corners.
        let inside = left >= scissor.left * 256
            && right <= scissor.right * 256
            && a.y >= scissor.top * 256
            && c.y <= scissor.bottom * 256;
        let small = c.y - a.y < Side::SMALL && right - left < Side::WIDTH;
        if !(inside && small) {
            return None;
        }
        Some(Self { ends, row: first_row(a), long: Side::small(a, c, 0), column: column(a), middle_left })
    }

    /// Whether there is no row.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        let [_, _, last] = &self.ends;
        self.row >= first_row(last)
    }

    /// The next stretch, which may have no rows: to be asked for twice.
    #[inline(always)]
    pub(crate) fn stretch(&mut self) -> Stretch {
        let Self { ends: [p, q, last], row: y, long, column: origin, .. } = *self;
        let rows = first_row(&q) - y;
        let mut sides = [long; 2];
        if rows > 0 {
            let short = Side::small(&p, &q, column(&p) - origin);
            sides = if self.middle_left { [short, long] } else { [long, short] };
            self.long.at = long.at.wrapping_add(long.step.wrapping_mul(rows));
        }
        (self.ends, self.row) = ([q, last, last], y + rows);
        Stretch { x: origin + 1, y, rows, sides }
    }
}

/// The corners down the screen, and whether the middle one lies to the left of the edge between the others.
#[inline(always)]
fn down(triangle: &Triangle) -> ([ScreenPoint; 3], bool) {
    let [mut a, mut b, mut c] = triangle.corners;
    // Counter-clockwise with y up, a on top and c at the bottom: b lies to the left of a–c. Each exchange turns that over.
    let mut middle_left = triangle.area >= 0;
    if b.y < a.y {
        (a, b, middle_left) = (b, a, !middle_left);
    }
    if c.y < b.y {
        (b, c, middle_left) = (c, b, !middle_left);
        if b.y < a.y {
            (a, b, middle_left) = (b, a, !middle_left);
        }
    }
    ([a, b, c], middle_left)
}

/// The stretches of triangles that are high, large or cut by the scissor.
pub(crate) struct Many {
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
    pub(crate) fn new(triangle: &Triangle, scissor: &Scissor) -> Self {
        let reach = Scissor::of(&triangle.corners);
        let (corners, middle_left) = down(triangle);
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

    /// Whether there is no row left.
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// The next stretch.
    #[inline(never)]
    pub(crate) fn stretch(&mut self) -> Option<Stretch> {
        if self.is_empty() {
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

    /// Whether the last stretch was a piece of a row that goes on.
    fn is_within_row(&self) -> bool {
        self.resume != self.from
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

/// The rows of a triangle, span by span, on the way down.
pub(crate) struct Spans {
    stretch: Stretch,
    /// The lower one of two, if there are two.
    lower: Stretch,
    more: Option<Many>,
}

impl Spans {
    #[inline(never)]
    fn new(triangle: &Triangle, scissor: &Scissor) -> Self {
        match Halves::new(triangle, scissor) {
            Some(mut halves) => Self { stretch: halves.stretch(), lower: halves.stretch(), more: None },
            None => {
                let more = Some(Many::new(triangle, scissor));
                Self { stretch: Stretch::NONE, lower: Stretch::NONE, more }
            }
        }
    }

    /// Whether there is no span, before any was asked for.
    pub(crate) fn is_empty(&self) -> bool {
        self.stretch.rows <= 0 && self.lower.rows <= 0 && self.more.as_ref().is_none_or(Many::is_empty)
    }
}

impl Iterator for Spans {
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
                    let mut width = right - left;
                    if let Some(many) = &mut self.more {
                        while many.is_within_row() {
                            let Some(mut more) = many.stretch() else { break };
                            let (_, right) = more.row(); // from where the last piece ended
                            width += right;
                        }
                    }
                    return Some(Span { x: x + left, y, width, height: 1 });
                }
            }
            self.stretch = match &mut self.more {
                Some(many) => many.stretch()?,
                None if self.lower.rows > 0 => core::mem::replace(&mut self.lower, Stretch::NONE),
                None => return None,
            };
        }
    }
}
