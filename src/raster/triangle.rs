//! Exact triangles, row by row.
//!
//! A row's covered pixels lie between two edges, and both ends are `⌈X − ½⌉` of an edge's
//! crossing X with the row of centres: the left end included, the right end excluded. That is
//! the top-left rule (R2–R5), and as the end depends on the edge alone, neighbours share it (R8).
//! `side.rs` has it exactly, by one addition a row, and on a Cortex-M0 `walk.rs`.

use super::edge::{first_row, Edge32};
use super::{Gradient, GradientSetup, Inside, Kept, Low, RowScratch, Scissor, ScreenPoint, Span, Trapezoid};
use crate::math::num::{mul_wide, CORTEX_M0};
use core::borrow::Borrow;

/// Twice the signed area in square sub-pixels: positive when the vertices run counter-clockwise
/// as seen with y up, which is what faces the viewer. Exact: |area| ≤ 2⁴⁵.
#[inline(always)]
pub fn area([a, b, c]: &[ScreenPoint; 3]) -> i64 {
    // Differences below 2²³, products below 2⁴⁵.
    let (x1, y1, x2, y2) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    // On a Cortex-M0 wide products are long. Of −2¹⁵ … 2¹⁵ − 1 they are at most 2³⁰, not both with the same sign.
    if CORTEX_M0 {
        let above = |v: i32| (v + (1 << 15)) as u32;
        if (above(x1) | above(y1) | above(x2) | above(y2)) >> 16 == 0 {
            return (x2 * y1).wrapping_sub(x1 * y2).into();
        }
    }
    // A sum: most cores have one instruction for a product and what it is added to.
    mul_wide(x2, y1) + mul_wide(-x1, y2)
}

/// A triangle about to be drawn, as a custom [`SpanShader`](crate::SpanShader) gets it.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Triangle<'v> {
    pub(crate) corners: [ScreenPoint; 3],
    /// [`area`]; not zero.
    pub(crate) area: i64,
    pub(crate) viewport: &'v Scissor,
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
    pub(crate) fn each_span(&self, scissor: &Scissor, draw: impl FnMut(Span)) {
        let columns = &mut RowScratch::of_columns();
        match Inside::new(self, scissor, columns) {
            Some(inside) => inside.each_span(columns, draw),
            None => self.spans(scissor).for_each(draw),
        }
    }

    /// The plane through a value at each corner, in their order, 0 … 2²⁴ − 1 (larger ones count as that), for
    /// custom inks.
    pub fn plane(&self, values: [u32; 3]) -> Gradient {
        GradientSetup::new(self).through(&values.map(|value| value.min((1 << 24) - 1) as i32))
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

/// The corners down the screen, and whether the middle one lies to the left of the edge between the others.
#[inline(always)]
pub(crate) fn down<P: Borrow<ScreenPoint>>(corners: [P; 3], area: i64) -> ([P; 3], bool) {
    let [mut a, mut b, mut c] = corners;
    let is_above = |p: &P, q: &P| p.borrow().y < q.borrow().y;
    // Counter-clockwise with y up, a on top and c at the bottom: b lies to the left of a–c. Each exchange turns that over.
    let mut turn = (area >> 32) as i32;
    if is_above(&b, &a) {
        (a, b, turn) = (b, a, !turn);
    }
    if is_above(&c, &b) {
        (b, c, turn) = (c, b, !turn);
        if is_above(&b, &a) {
            (a, b, turn) = (b, a, !turn);
        }
    }
    ([a, b, c], turn >= 0)
}

/// The stretches of all other triangles, inside the scissor.
pub(crate) struct AnyTriangle {
    /// The next row, and the end.
    row: i32,
    end: i32,
    /// The side or the two sides with the middle corner, and the one from the first corner to the last, at the next row;
    /// and the rows from which on they are to be set up anew.
    short: Edge32,
    long: Edge32,
    until: [i32; 2],
    /// The scissor's columns.
    from: i32,
    to: i32,
    /// Whether the middle corner lies to the left of the edge between the others.
    middle_left: bool,
    /// Down the screen.
    corners: [ScreenPoint; 3],
}

impl AnyTriangle {
    #[inline(never)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let reach = Scissor::of(&triangle.corners);
        let (corners, middle_left) = down(triangle.corners, triangle.area);
        let beside = reach.left >= scissor.right || reach.right <= scissor.left;
        Self {
            row: reach.top.max(scissor.top),
            end: if beside { i32::MIN } else { reach.bottom.min(scissor.bottom) },
            short: Edge32::default(),
            long: Edge32::default(),
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

    /// The next stretch, of one row at least, if there is one. It is made where it stays: it is large.
    #[inline(never)]
    pub(crate) fn stretch(&mut self, stretch: &mut Trapezoid<Edge32>) -> bool {
        if self.is_empty() {
            return false;
        }
        self.set_up();
        self.take(stretch);
        true
    }

    /// As far down as both sides go, and are not cut.
    #[inline(never)] // its frame is not there while sides are set up
    fn take(&mut self, stretch: &mut Trapezoid<Edge32>) {
        let Self { row: y, short, long, until: [short_until, long_until], .. } = *self;
        let rows = self.end.min(short_until).min(long_until) - y;
        let sides = if self.middle_left { [short, long] } else { [long, short] };
        *stretch = Trapezoid { x: 0, y, rows, sides };
        stretch.cut(self.from, self.to);
        self.short.skip(stretch.rows);
        self.long.skip(stretch.rows);
        self.row += stretch.rows;
    }

    /// Sets up the sides that end here.
    #[inline(never)]
    fn set_up(&mut self) {
        let Self { row, corners: [a, b, c], until: [short_until, long_until], .. } = *self;
        let further = row + Edge32::ROWS;
        if row >= short_until {
            let middle = first_row(&b);
            let (p, q, end) = if row < middle { (a, b, middle.min(further)) } else { (b, c, further) };
            self.short = Edge32::new(&p, &q, row);
            self.until = [end, long_until];
        }
        if row >= long_until {
            self.long = Edge32::new(&a, &c, row);
            let [short_until, _] = self.until;
            self.until = [short_until, further];
        }
    }
}

/// The rows of a triangle, span by span, on the way down.
pub(crate) enum Spans {
    /// Those of a low triangle.
    Low(Kept),
    /// The rows left of a stretch, and what is below.
    AnyTriangle(Trapezoid<Edge32>, AnyTriangle),
}

impl Spans {
    #[inline(never)]
    fn new(triangle: &Triangle<'_>, scissor: &Scissor) -> Self {
        let mut columns = RowScratch::of_columns();
        match Low::new(triangle, scissor, &mut columns) {
            Some(low) => Self::Low(Kept::new(low, columns)),
            None => Self::AnyTriangle(Trapezoid::default(), AnyTriangle::new(triangle, scissor)),
        }
    }

    /// Whether there is no row, before any was asked for.
    pub(crate) fn is_empty(&self) -> bool {
        match self {
            Self::Low(kept) => kept.is_empty(),
            Self::AnyTriangle(_, large) => large.is_empty(),
        }
    }
}

impl Iterator for Spans {
    type Item = Span;

    /// Not part of the loops that draw: there are many of them.
    #[inline(never)]
    fn next(&mut self) -> Option<Span> {
        match self {
            Self::Low(kept) => kept.span(),
            Self::AnyTriangle(stretch, large) => loop {
                if let Some(span) = stretch.span() {
                    return Some(span);
                }
                if !large.stretch(stretch) {
                    return None;
                }
            },
        }
    }
}
