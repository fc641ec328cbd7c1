//! Low triangles where a division is one instruction: two stretches of rows, above and below the middle corner.

use super::edge20::{ByDivision, Divisor, Edge20};
use crate::math::num::keep_rolled;
use crate::raster::edge::{column, first_row};
use crate::raster::pixel_layout::{PixelLayout, RowOrigin, RowScratch, Rows};
use crate::raster::triangle::down;
use crate::raster::{Scissor, ScreenPoint, Span, Trapezoid, Triangle};
use core::hint::black_box;
use core::marker::PhantomData;

/// The two stretches of a small triangle between the scissor's columns, above and below the middle corner: most triangles
/// are that, and their way is short, to be part of the loops that draw. `CUT`: there may be rows above and below the
/// scissor's.
pub(crate) struct SmallTriangle<D, const CUT: bool> {
    /// The ends of the side, or of two sides, with the middle corner, from the stretch on that is next.
    ends: [ScreenPoint; 3],
    /// The next row, and there the side between the first and the last corner.
    row: i32,
    long: Edge20,
    /// That the sides are counted from.
    column: i32,
    middle_left: bool,
    /// The scissor's rows, where it is `CUT`.
    top: i32,
    bottom: i32,
    /// How its sides are divided.
    divisor: PhantomData<D>,
}

impl<D: Divisor, const CUT: bool> SmallTriangle<D, CUT> {
    /// `None` for all other triangles.
    #[inline(always)]
    pub(crate) fn new(triangle: &Triangle<'_>, scissor: &Scissor, _: &mut RowScratch) -> Option<Self> {
        let [p, q, r] = &triangle.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (ends, middle_left) = down(triangle.corners, triangle.area);
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
        let (row, column, long) = (first_row(a), column(a), Edge20::new::<D>(a, c, 0));
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

    /// The next stretch, which may have no rows: to be asked for twice.
    #[inline(always)]
    fn stretch(&mut self) -> Trapezoid<Edge20> {
        let Self { ends: [p, q, last], row: y, long, column: origin, .. } = *self;
        let end = first_row(&q);
        let rows = end - y;
        let mut sides = [long; 2];
        if rows > 0 {
            let short = Edge20::new::<D>(&p, &q, column(&p) - origin);
            sides = if self.middle_left { [short, long] } else { [long, short] };
            self.long.skip(rows);
        }
        (self.ends, self.row) = ([q, last, last], end);
        let mut stretch = Trapezoid { x: origin + 1, y, rows, sides };
        if CUT {
            let above = (self.top - y).clamp(0, rows.max(0));
            stretch.y += above;
            stretch.rows = end.min(self.bottom) - stretch.y;
            stretch.sides.iter_mut().for_each(|side| side.skip(above));
        }
        stretch
    }

    /// All that have pixels.
    #[inline(always)]
    pub(crate) fn each_span(mut self, _: &mut RowScratch, mut draw: impl FnMut(Span)) {
        // A loop of loops stays one: small is better.
        for _ in 0..black_box(2) {
            let mut stretch = self.stretch();
            while let Some(span) = stretch.span() {
                draw(span);
            }
        }
    }
}

impl<D: Divisor, const CUT: bool> Rows for SmallTriangle<D, CUT> {
    const WIDTH: i32 = D::WIDTH;

    #[inline(always)]
    fn is_empty(&self) -> bool {
        let [_, _, last] = &self.ends;
        let end = first_row(last);
        match CUT {
            true => self.row.max(self.top) >= end.min(self.bottom),
            false => self.row >= end,
        }
    }

    #[inline(always)]
    fn start(&self, _: PixelLayout) -> RowOrigin {
        RowOrigin { x: self.column + 1, y: if CUT { self.row.max(self.top) } else { self.row }, shear: 0 }
    }

    // Where it is `CUT`, small is better than fast, and the loop over both stretches stays one.
    #[inline(always)]
    fn each(mut self, ground: &mut RowScratch, mut row: impl FnMut(usize, i32, i32)) {
        // Every stretch begins where the one before ends.
        let RowOrigin { x, y, .. } = self.start(ground.places);
        let mut start = ground.places.at(x, y);
        for _ in 0..if CUT { black_box(2) } else { 2 } {
            keep_rolled();
            start = self.stretch().each(start, ground.places.stride, &mut row);
        }
    }
}

/// The rows of a low triangle: those of the next stretch, and of the one below, without rows if there is none.
pub(crate) struct Kept([Trapezoid<Edge20>; 2]);

const NONE: Trapezoid<Edge20> = Trapezoid { x: 0, y: 0, rows: 0, sides: [Edge20::NONE; 2] };

impl Kept {
    #[inline(always)]
    pub(crate) fn new(mut low: SmallTriangle<ByDivision, true>, _: RowScratch) -> Self {
        let mut stretches = [NONE; 2];
        for stretch in stretches.iter_mut().take(black_box(2)) {
            *stretch = low.stretch(); // not unrolled: small is better
        }
        Self(stretches)
    }

    pub(crate) fn is_empty(&self) -> bool {
        let Self(stretches) = self;
        stretches.iter().all(|stretch| stretch.rows <= 0)
    }

    /// The next one that has pixels.
    #[inline(always)]
    pub(crate) fn span(&mut self) -> Option<Span> {
        let Self([upper, lower]) = self;
        upper.span().or_else(|| lower.span())
    }
}
