//! Triangles of one colour that continue below a band: edges, depth and colour are carried to the next band, which sets nothing up.
//!
//! - **Plain twins**: `solid_fill::triangle` and `solid_fill::triangle_nearer`, with a band as the scissor.
//! - **Domain**: all corners between the scissor's columns and within 32 × 30 pixels, the first row not above the scissor; on a target
//!   whose pixels lie in memory, with depth only where the depth buffer is laid out as the memory is. Nothing on a Cortex-M0.
//! - **Gain**: on an M3, S3 in bands of 8 rows takes 790 000 instructions with depth in place of 965 000, and 480 000 in place of 607 000
//!   without (`tools/bench/run cells S3 active8-z M3`). A Cortex-M0, which has no division, walks other edges.
//! - **Test**: `tests/pipeline/bands.rs`, and `by_every_call` in `tests/support/src/bridge/ways.rs`.

use super::edge20::{Divisor, Edge20, OneDivision, TwoDivisions};
use super::fill_rows::{same_length, FillRow};
use super::put_run::Equal;
use super::solid_fill::{EqualRows, NearerRows};
use super::{depth_gradient, memory_of};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::keep_rolled;
use crate::raster::edge::{base_column, first_row};
use crate::raster::triangle::sort_by_y;
use crate::raster::{DepthTriangle, RowScratch, Scissor, ScreenPoint, Trapezoid};
use crate::surface::block_fill::pair;
use crate::surface::{PixelRows, PixelStore, Surface};
use core::ops::Range;

/// What fills rows with equal cells, given a row's base index and its ends. The ends of the first row are counted from the column at which
/// `depth` is.
#[inline(always)]
fn rows<'a, Cell: Copy, const WORDS: usize>(
    fill: &'a mut Equal<Cell>,
    depth: [u32; WORDS],
    cells: &'a mut [Cell],
    depths: &'a mut [u16],
) -> impl FnMut(usize, i32, i32) + use<'a, Cell, WORDS> {
    let equal = *fill;
    let ([z, step, down], own, (cells, depths)) = match depth[..] {
        [z, step, down] => ([z, step, down], Default::default(), same_length(cells, depths)),
        _ => ([0; 3], cells, Default::default()),
    };
    let mut nearer = NearerRows { fill, cells, depths, step, down, z };
    let mut equal = EqualRows { cells: own, equal, may_be_long: false };
    move |start, left, right| match WORDS {
        0 => equal.row(start, left, right),
        _ => nearer.row(start, left, right),
    }
}

/// Moves depth down by some rows.
#[inline(always)]
fn advance(depth: &mut [u32], rows: i32) {
    if let [z, _, down] = depth {
        *z = z.wrapping_add(down.wrapping_mul(rows as u32));
    }
}

/// A triangle that continues below the last band, at the row below that band.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried<C, const WORDS: usize> {
    /// The two edges at the next row, and the edge below the middle corner at its first row.
    left: Edge20,
    right: Edge20,
    lower: Edge20,
    /// The column that edges are counted from.
    x: i16,
    /// The number of rows from the next one down to the middle corner, or down to the end if the middle corner lies above.
    rows: i8,
    /// The number of rows below the middle corner, negative if the edge below it is the right one; 0 if no edge changes any more.
    rows_below: i8,
    /// `None` before a triangle is stored.
    color: Option<C>,
    /// Depth at the origin that the ends of the next row are counted from, and its change from a pixel to its right neighbour and from row
    /// to row; nothing without a depth buffer.
    depth: [u32; WORDS],
}

/// The rows of a triangle below a band.
#[derive(PartialEq, Eq)]
pub(crate) enum Rest {
    Nothing,
    Carried,
    /// All of it: the triangle is outside of the domain, and nothing was drawn.
    Declined,
}

/// Whether triangles can be carried: the target's pixels lie in memory.
#[inline(always)]
pub(crate) fn has_memory<T: Surface>(target: &mut T) -> bool {
    !CORTEX_M0 && memory_of(target).is_some()
}

/// Fills the rows of a triangle that lie in a scissor. If rows are left below, stores them in `to`, if there is room.
#[inline(always)]
pub(crate) fn begin<T: Surface, const WORDS: usize>(
    to: Option<&mut Carried<T::Color, WORDS>>,
    triangle: &DepthTriangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    depths: &mut [u16],
    target: &mut T,
) -> Rest {
    match memory_of(target) {
        Some(memory) => Carried::begin(to, triangle, color, scissor, memory, depths),
        None => Rest::Declined,
    }
}

/// Fills the `rows` of a band with a triangle that is carried into it. Returns whether the triangle ends there.
#[inline(always)]
pub(crate) fn fill<T: Surface, const WORDS: usize>(
    carried: &mut Carried<T::Color, WORDS>,
    rows: Range<i32>,
    depths: &mut [u16],
    target: &mut T,
) -> bool {
    memory_of(target).is_none_or(|memory| carried.fill(rows.start, rows.end, memory, depths))
}

impl<C: Copy, const WORDS: usize> Carried<C, WORDS> {
    pub(crate) const EMPTY: Self = Self {
        left: Edge20::EMPTY,
        right: Edge20::EMPTY,
        lower: Edge20::EMPTY,
        x: 0,
        rows: 0,
        rows_below: 0,
        color: None,
        depth: [0; WORDS],
    };

    #[inline(never)] // its loop needs all registers
    fn begin<S: PixelStore>(
        to: Option<&mut Self>,
        triangle: &DepthTriangle<'_>,
        color: C,
        scissor: &Scissor,
        memory: &mut PixelRows<S>,
        depths: &mut [u16],
    ) -> Rest
    where
        C: StoredPixel<S::Cell>,
    {
        if CORTEX_M0 || cfg!(pinhole_plain) {
            return Rest::Declined;
        }
        let [p, q, r] = &triangle.triangle.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let ([a, b, c], middle_is_left) = sort_by_y(triangle.triangle.corners, triangle.triangle.area);
        // The sign bit is set if a difference is negative: one test for all comparisons, as in `small_triangle.rs`.
        let mut room = (left - (scissor.left << 8)) | ((scissor.right << 8) - right);
        room |= (TwoDivisions::WIDTH - 1 - (right - left)) | (TwoDivisions::HEIGHT - 1 - (c.y - a.y));
        let is_small =
            (OneDivision::WIDTH - 1 - (right - left)) | (OneDivision::HEIGHT - 1 - (c.y - a.y)) >= 0;
        let edge = |p: &ScreenPoint, q: &ScreenPoint, from: i32| match is_small {
            true => Edge20::new::<OneDivision>(p, q, from),
            false => Edge20::new::<TwoDivisions>(p, q, from),
        };
        let (mut row, last) = (first_row(&a), first_row(&c));
        if room | (row - scissor.top) < 0 {
            return Rest::Declined;
        }
        if row >= last {
            return Rest::Nothing;
        }
        let (column, bottom) = (base_column(&a), scissor.bottom);
        let mut long = edge(&a, &c, 0);
        let mut depth = [0; WORDS];
        if let [z, step, down] = &mut depth[..] {
            let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
            (*z, *step, *down) = (gradient.at(column + 1, row), gradient.step(), gradient.row_step());
        }
        let above = bottom - row;
        let (cells, &mut RowScratch { layout, .. }) = memory.parts();
        let (mut start, mut equal) = (layout.at(column + 1, row), Equal(pair(color.stored())));
        let mut fill = rows(&mut equal, depth, cells, depths);
        let (mut from, mut end) = (&a, &b);
        let short = loop {
            keep_rolled();
            let end_row = first_row(end);
            if end_row > row {
                let short = edge(from, end, base_column(from) - column);
                let edges = if middle_is_left { [short, long] } else { [long, short] };
                let rows = end_row.min(bottom) - row;
                let mut trapezoid = Trapezoid { x: 0, y: row, rows, edges };
                start = trapezoid.each(start, layout.stride, &mut fill);
                let [left, right] = trapezoid.edges;
                let short = if middle_is_left { left } else { right };
                long.advance(rows);
                if end_row > bottom {
                    break (short, end_row);
                }
            }
            if end_row >= last {
                return Rest::Nothing;
            }
            (row, from, end) = (end_row, end, &c);
        };
        let (short, end_row) = short;
        if let Some(to) = to {
            advance(&mut depth, above);
            (to.left, to.right) = if middle_is_left { (short, long) } else { (long, short) };
            // All of these are at most 30 rows.
            (to.rows, to.rows_below) = ((end_row - bottom) as i8, (last - end_row) as i8);
            if last > end_row {
                to.lower = edge(&b, &c, base_column(&b) - column);
                to.rows_below = if middle_is_left { to.rows_below } else { -to.rows_below };
            }
            // Inside the guard band.
            (to.x, to.color, to.depth) = ((column + 1) as i16, Some(color), depth);
        }
        Rest::Carried
    }

    /// Fills the rows from `y` up to but excluding `bottom`; `y` is the row below the last ones. Returns whether the triangle ends there.
    #[inline(always)]
    fn fill<S: PixelStore>(
        &mut self,
        y: i32,
        bottom: i32,
        memory: &mut PixelRows<S>,
        depths: &mut [u16],
    ) -> bool
    where
        C: StoredPixel<S::Cell>,
    {
        let Some(color) = self.color else { return true };
        let (cells, &mut RowScratch { layout, .. }) = memory.parts();
        let (mut start, mut equal) = (layout.at(self.x.into(), y), Equal(pair(color.stored())));
        let mut fill = rows(&mut equal, self.depth, cells, depths);
        let mut room = bottom - y;
        let ends = loop {
            keep_rolled();
            let rows = i32::from(self.rows).min(room);
            let mut trapezoid = Trapezoid { x: 0, y, rows, edges: [self.left, self.right] };
            start = trapezoid.each(start, layout.stride, &mut fill);
            [self.left, self.right] = trapezoid.edges;
            room -= rows;
            self.rows -= rows as i8; // at most `self.rows`
            if self.rows > 0 {
                break false;
            }
            match self.rows_below {
                0 => break true,
                1.. => self.left = self.lower,
                _ => self.right = self.lower,
            }
            (self.rows, self.rows_below) = (self.rows_below.abs(), 0); // at most 30
            if room == 0 {
                break false;
            }
        };
        advance(&mut self.depth, bottom - y);
        ends
    }
}
