//! Exact triangles, row by row.
//!
//! A row's covered pixels lie between two edges, and both ends are `⌈X − ½⌉` of an edge's
//! crossing X with the row of centres: the left end included, the right end excluded. That is
//! the top-left rule (R2–R5), and as the end depends on the edge alone, neighbours share it (R8).
//! [`Side`] has it exactly, by one addition a row.

use super::edge::{column, first_row, Any, Divisor, Quick, Side, Step, Wide};
use super::{Plane, Planes, Scissor, ScreenPoint, Span};
use crate::math::num::{keep_rolled, mul_wide};
use core::hint::black_box;
use core::marker::PhantomData;

/// Twice the signed area in square sub-pixels: positive when the vertices run counter-clockwise
/// as seen with y up, which is what faces the viewer. Exact: |area| ≤ 2⁴⁵.
#[inline(always)]
pub fn area([a, b, c]: &[ScreenPoint; 3]) -> i64 {
    // Differences below 2²³, products below 2⁴⁵.
    let (x1, y1, x2, y2) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    // On a Cortex-M0 wide products are long. Of −2¹⁵ … 2¹⁵ − 1 they are at most 2³⁰, not both with the same sign.
    if cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
        let above = |v: i32| (v + (1 << 15)) as u32;
        if (above(x1) | above(y1) | above(x2) | above(y2)) >> 16 == 0 {
            return (x2 * y1).wrapping_sub(x1 * y2).into();
        }
    }
    // A sum: most cores have one instruction for a product and what it is added to.
    mul_wide(x2, y1) + mul_wide(-x1, y2)
}

/// A triangle ready to be drawn: what an [`InkFor`](crate::InkFor) of one's own is made ready for.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Triangle<'v> {
    pub(super) corners: [ScreenPoint; 3],
    /// [`area`]; not zero.
    pub(super) area: i64,
    pub(super) viewport: &'v Scissor,
}

impl<'v> Triangle<'v> {
    /// `area` is that of the corners, and not zero; pixels outside the viewport will not be asked for.
    #[inline(always)]
    pub(crate) fn new(corners: [ScreenPoint; 3], area: i64, viewport: &'v Scissor) -> Self {
        Self { corners, area, viewport }
    }

    /// Takes other corners, and their area.
    #[inline(always)]
    pub(crate) fn put(&mut self, corners: [ScreenPoint; 3], area: i64) {
        (self.corners, self.area) = (corners, area);
    }

    #[inline(always)]
    pub(crate) fn corners(&self) -> &[ScreenPoint; 3] {
        &self.corners
    }

    /// Its covered pixels inside the scissor, row by row.
    #[inline(always)]
    pub(crate) fn spans(&self, scissor: &Scissor) -> Spans {
        Spans::new(self, scissor)
    }

    /// The same where the loop is to be part of what draws.
    #[inline(always)]
    pub(crate) fn each_span(&self, scissor: &Scissor, mut draw: impl FnMut(Span)) {
        match Halves::<Any, false>::new(self, scissor) {
            Some(mut halves) => {
                // A loop of loops stays one: small is better.
                for _ in 0..black_box(2) {
                    let mut stretch = halves.stretch();
                    while let Some(span) = stretch.span() {
                        draw(span);
                    }
                }
            }
            None => self.spans(scissor).for_each(draw),
        }
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
pub(crate) struct Stretch<S = Side> {
    /// The column that the sides are counted from.
    pub(crate) x: i32,
    /// The next row.
    pub(crate) y: i32,
    /// How many: may be none, or less.
    pub(crate) rows: i32,
    /// Left and right.
    sides: [S; 2],
}

impl Stretch {
    const NONE: Self = Self { x: 0, y: 0, rows: 0, sides: [Side::NONE; 2] };
}

impl<S: Step> Stretch<S> {
    /// The covered pixels of the next row, from the column counted from; there may be none. Then to the row below.
    #[inline(always)]
    pub(crate) fn row(&mut self) -> (i32, i32) {
        let [left, right] = &mut self.sides;
        (left.next(), right.next())
    }
}

/// The two stretches of a small triangle between the scissor's columns, above and below the middle corner: most triangles
/// are that, and their way is short, to be part of the loops that draw. `CUT`: there may be rows above and below the
/// scissor's.
pub(crate) struct Halves<D, const CUT: bool> {
    /// The ends of the side, or of two sides, with the middle corner, from the stretch on that is next.
    ends: [ScreenPoint; 3],
    /// The next row, and there the side between the first and the last corner.
    row: i32,
    long: Side,
    /// That the sides are counted from.
    column: i32,
    middle_left: bool,
    /// The scissor's rows, where it is `CUT`.
    top: i32,
    bottom: i32,
    /// How its sides are divided.
    divisor: PhantomData<D>,
}

/// Those within 32 by 30 pixels (on a Cortex-M0 much wider ones too), inside the scissor.
pub(crate) type Small = Halves<Quick, false>;

/// Those within 32 rows (31 on a Cortex-M0), between the scissor's columns.
pub(crate) type Low = Halves<Any, true>;

impl<D: Divisor, const CUT: bool> Halves<D, CUT> {
    /// `None` for all other triangles.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Option<Self> {
        let [p, q, r] = &triangle.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (ends, middle_left) = down(triangle);
        let [a, _, c] = &ends;
        // Negative where one of these is: below 2²⁴, all of them. Ends lie within a column of the corners.
        let mut room = (left - (scissor.left << 8)) | ((scissor.right << 8) - right);
        room |= (D::WIDTH - 1 - (right - left)) | (D::HEIGHT - 1 - (c.y - a.y));
        if !CUT {
            room |= (a.y - (scissor.top << 8)) | ((scissor.bottom << 8) - c.y);
        }
        if room < 0 {
            return None;
        }
        let (row, column, long) = (first_row(a), column(a), Side::new::<D>(a, c, 0));
        Some(Self {
            ends,
            row,
            long,
            column,
            middle_left,
            top: scissor.top,
            bottom: scissor.bottom,
            divisor: PhantomData,
        })
    }

    /// Whether there is no row.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        let [_, _, last] = &self.ends;
        let end = first_row(last);
        match CUT {
            true => self.row.max(self.top) >= end.min(self.bottom),
            false => self.row >= end,
        }
    }

    /// The column that its sides are counted from, and the first row. Every stretch begins where the one before ends.
    #[inline(always)]
    pub(crate) fn first(&self) -> (i32, i32) {
        (self.column + 1, if CUT { self.row.max(self.top) } else { self.row })
    }

    /// Both stretches. Where it is `CUT`, small is better than fast, and their loop stays one.
    #[inline(always)]
    pub(crate) fn each(mut self, mut draw: impl FnMut(Stretch)) {
        for _ in 0..if CUT { black_box(2) } else { 2 } {
            keep_rolled();
            draw(self.stretch());
        }
    }

    /// The next stretch, which may have no rows: to be asked for twice.
    #[inline(always)]
    fn stretch(&mut self) -> Stretch {
        let Self { ends: [p, q, last], row: y, long, column: origin, .. } = *self;
        let end = first_row(&q);
        let rows = end - y;
        let mut sides = [long; 2];
        if rows > 0 {
            let short = Side::new::<D>(&p, &q, column(&p) - origin);
            sides = if self.middle_left { [short, long] } else { [long, short] };
            self.long.skip(rows);
        }
        (self.ends, self.row) = ([q, last, last], end);
        let mut stretch = Stretch { x: origin + 1, y, rows, sides };
        if CUT {
            let above = (self.top - y).clamp(0, rows.max(0));
            stretch.y += above;
            stretch.rows = end.min(self.bottom) - stretch.y;
            stretch.sides.iter_mut().for_each(|side| side.skip(above));
        }
        stretch
    }
}

/// The corners down the screen, and whether the middle one lies to the left of the edge between the others.
#[inline(always)]
fn down(triangle: &Triangle<'_>) -> ([ScreenPoint; 3], bool) {
    let [mut a, mut b, mut c] = triangle.corners;
    // Counter-clockwise with y up, a on top and c at the bottom: b lies to the left of a–c. Each exchange turns that over.
    let mut turn = (triangle.area >> 32) as i32;
    if b.y < a.y {
        (a, b, turn) = (b, a, !turn);
    }
    if c.y < b.y {
        (b, c, turn) = (c, b, !turn);
        if b.y < a.y {
            (a, b, turn) = (b, a, !turn);
        }
    }
    ([a, b, c], turn >= 0)
}

/// The stretches of all other triangles, inside the scissor.
pub(crate) struct Large {
    /// The next row, and the end.
    row: i32,
    end: i32,
    /// The side or the two sides with the middle corner, and the one from the first corner to the last, at the next row;
    /// and the rows from which on they are to be set up anew.
    short: Wide,
    long: Wide,
    until: [i32; 2],
    /// The scissor's columns.
    from: i32,
    to: i32,
    /// Whether the middle corner lies to the left of the edge between the others.
    middle_left: bool,
    /// Down the screen.
    corners: [ScreenPoint; 3],
}

impl Large {
    #[inline(never)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let reach = Scissor::of(&triangle.corners);
        let (corners, middle_left) = down(triangle);
        let beside = reach.left >= scissor.right || reach.right <= scissor.left;
        Self {
            row: reach.top.max(scissor.top),
            end: if beside { i32::MIN } else { reach.bottom.min(scissor.bottom) },
            short: Wide::default(),
            long: Wide::default(),
            until: [i32::MIN; 2],
            from: scissor.left,
            to: scissor.right,
            middle_left,
            corners,
        }
    }

    /// Whether there is no row left.
    pub(crate) fn is_empty(&self) -> bool {
        self.row >= self.end
    }

    /// The next stretch, of one row at least.
    #[inline(never)]
    pub(crate) fn stretch(&mut self) -> Option<Stretch<Wide>> {
        if self.is_empty() {
            return None;
        }
        self.set_up();
        let Self { row: y, short, long, until: [short_until, long_until], .. } = *self;
        let rows = self.end.min(short_until).min(long_until) - y;
        let sides = if self.middle_left { [short, long] } else { [long, short] };
        let stretch = Stretch { x: 0, y, rows, sides }.between(self.from, self.to);
        self.short.skip(stretch.rows);
        self.long.skip(stretch.rows);
        self.row += stretch.rows;
        Some(stretch)
    }

    /// Sets up the sides that end here.
    fn set_up(&mut self) {
        let Self { row, corners: [a, b, c], until: [short_until, long_until], .. } = *self;
        let further = row + Wide::ROWS;
        if row >= short_until {
            let middle = first_row(&b);
            let (p, q, end) = if row < middle { (a, b, middle.min(further)) } else { (b, c, further) };
            self.short = Wide::new(&p, &q, row);
            self.until = [end, long_until];
        }
        if row >= long_until {
            self.long = Wide::new(&a, &c, row);
            let [short_until, _] = self.until;
            self.until = [short_until, further];
        }
    }
}

impl Stretch<Wide> {
    /// Its column and how many pixels it has, if it is a rectangle of this width.
    #[inline(always)]
    pub(crate) fn upright(&self, width: i32) -> Option<(i32, i32)> {
        let [left, right] = &self.sides;
        let is_upright = right.first() - left.first() == width && left.is_vertical() && right.is_vertical();
        is_upright.then(|| (left.first(), width.wrapping_mul(self.rows)))
    }

    /// Cut to these columns: what of a side lies outside becomes vertical, and the stretch is as long as either does.
    #[inline(always)]
    fn between(mut self, from: i32, to: i32) -> Self {
        let Self { rows, sides: [left, right], .. } = &mut self;
        let mut cut = |side: &mut Wide, limit: i32, is_outside: fn(i32, i32) -> bool| {
            let outside = |row: i32| is_outside(side.pixel(row), limit);
            let begins_outside = outside(0);
            if outside(*rows - 1) != begins_outside {
                // By bisection: the first row is as at the beginning, the last one is not.
                let (mut same, mut other) = (0, *rows - 1);
                while other - same > 1 {
                    let middle = (same + other) >> 1;
                    *(if outside(middle) == begins_outside { &mut same } else { &mut other }) = middle;
                }
                *rows = other;
            }
            if begins_outside {
                *side = Wide::vertical(limit);
            }
        };
        cut(left, from, |x, limit| x < limit);
        cut(right, to, |x, limit| x > limit);
        self
    }
}

/// The rows of a triangle, span by span, on the way down.
pub(crate) enum Spans {
    /// The next stretch, and the one below, without rows if there is none.
    Small([Stretch; 2]),
    /// The rows left of a stretch, and what is below.
    Large(Option<Stretch<Wide>>, Large),
}

impl Spans {
    #[inline(never)]
    fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        match Low::new(triangle, scissor) {
            Some(mut halves) => {
                let mut stretches = [Stretch::NONE; 2];
                for stretch in stretches.iter_mut().take(black_box(2)) {
                    *stretch = halves.stretch(); // not unrolled: small is better
                }
                Self::Small(stretches)
            }
            None => Self::Large(None, Large::new(triangle, scissor)),
        }
    }

    /// Whether there is no row, before any was asked for.
    pub(crate) fn is_empty(&self) -> bool {
        match self {
            Self::Small(stretches) => stretches.iter().all(|stretch| stretch.rows <= 0),
            Self::Large(_, large) => large.is_empty(),
        }
    }
}

impl<S: Step> Stretch<S> {
    /// The next row that has pixels.
    #[inline(always)]
    fn span(&mut self) -> Option<Span> {
        while self.rows > 0 {
            let (x, y, (left, right)) = (self.x, self.y, self.row());
            self.y += 1;
            self.rows -= 1;
            if left < right {
                return Some(Span { x: x + left, y, width: right - left, height: 1 });
            }
        }
        None
    }
}

impl Iterator for Spans {
    type Item = Span;

    /// Not part of the loops that draw: there are many of them.
    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        match self {
            Self::Small([upper, lower]) => upper.span().or_else(|| lower.span()),
            Self::Large(stretch, large) => loop {
                if let Some(span) = stretch.as_mut().and_then(Stretch::span) {
                    return Some(span);
                }
                *stretch = Some(large.stretch()?);
            },
        }
    }
}
