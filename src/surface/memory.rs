//! Pixels that lie in memory, and the loops that fill them.

use super::depth::DepthBuffer;
use crate::fast::depth_fill::{one_nearer, DepthFill, RowFill};
use crate::fast::{self, Low, RowOrigin, Rows, Small};
use crate::math::num::CORTEX_M0;
use crate::raster::{
    AnyTriangle, DepthTriangle, PixelLayout, RowScratch, Scissor, Span, Trapezoid, Triangle,
};
use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;

/// Pixels in memory, row by row.
#[derive(Debug)]
pub(crate) struct Memory<'a, Cell> {
    pub(crate) cells: &'a mut [Cell],
    /// Where the first one lies.
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) scratch: RowScratch,
}

impl<'a, Cell: Copy> Memory<'a, Cell> {
    #[inline(always)]
    pub(crate) fn new(cells: &'a mut [Cell], area: &Rectangle) -> Self {
        let Rectangle { top_left, size } = *area;
        let (left, top, stride) = (top_left.x, top_left.y, size.width as usize);
        Self { cells, left, top, scratch: RowScratch::new(PixelLayout::new(left, top, stride)) }
    }

    /// A row's pixels. Those of a row that does not lie inside are others, or none.
    #[inline(always)]
    pub(crate) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [Cell]> {
        let from = self.scratch.layout.at(x, y);
        self.cells.get_mut(from..from.wrapping_add(width as usize))
    }

    /// Fills a triangle. `two` is the same cell twice; the compiler must not know, or it would use two registers.
    #[inline(never)] // its loop needs all registers
    pub(crate) fn triangle(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        match Small::new(triangle, scissor, &mut self.scratch) {
            Some(small) => self.rows(small, two),
            None => self.cut(triangle, scissor, two),
        }
    }

    /// One that is cut, wide or large.
    #[inline(never)]
    fn cut(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        match Low::new(triangle, scissor, &mut self.scratch) {
            Some(low) => self.rows(low, two),
            None => self.large(triangle, scissor, two),
        }
    }

    #[inline(always)]
    fn rows<R: Rows>(&mut self, rows: R, two: [Cell; 2]) {
        let (cells, scratch) = (&mut *self.cells, &mut self.scratch);
        let long = R::WIDTH > LONG << 8;
        rows.each(scratch, |start, left, right| fill_row(cells, start, left, right, two, long));
    }

    #[inline(never)] // its loop needs all registers
    fn large(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        let (mut large, mut stretch) = (AnyTriangle::new(triangle, scissor), Trapezoid::default());
        while large.trapezoid(&mut stretch) {
            match stretch.as_rectangle(self.scratch.layout.stride as i32) {
                // All of so many rows, as where a large face is cut on both sides: one run.
                Some((x, pixels)) => {
                    if let Some(run) = self.row(x, stretch.y, pixels) {
                        fill(run, two);
                    }
                }
                None => {
                    let start = self.scratch.layout.at(stretch.x, stretch.y);
                    let (cells, stride) = (&mut *self.cells, self.scratch.layout.stride);
                    stretch.each(start, stride, |start, left, right| {
                        fill_row(cells, start, left, right, two, true)
                    });
                }
            }
        }
    }

    /// Fills a triangle where it is nearer than what is held for the same pixels.
    #[inline(never)] // its loop needs all registers
    pub(crate) fn nearer<F: DepthFill<Cell>>(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        depth: &mut DepthBuffer<'_>,
        filling: F,
    ) {
        match Small::new(&piece.triangle, scissor, &mut self.scratch) {
            Some(small) => self.rows_nearer(small, piece, depth.held(), filling),
            None => self.cut_nearer(piece, scissor, depth, filling),
        }
    }

    /// One that is cut, wide or large.
    #[inline(never)]
    fn cut_nearer<F: DepthFill<Cell>>(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        depth: &mut DepthBuffer<'_>,
        filling: F,
    ) {
        match Low::new(&piece.triangle, scissor, &mut self.scratch) {
            Some(low) => self.rows_nearer(low, piece, depth.held(), filling),
            None => self.large_nearer(piece, scissor, depth, filling),
        }
    }

    #[inline(always)]
    fn rows_nearer<F: DepthFill<Cell>>(
        &mut self,
        rows: impl Rows,
        piece: &DepthTriangle<'_>,
        held: &mut [u16],
        filling: F,
    ) {
        if !rows.is_empty() {
            let start = rows.start(self.scratch.layout);
            let mut over = filling.over(piece);
            let (cells, scratch) = (&mut *self.cells, &mut self.scratch);
            let mut filled = filling.rows(&mut over, cells, held, start);
            rows.each(scratch, |start, left, right| filled.row(start, left, right));
        }
    }

    #[inline(never)] // rare, and most of it a row's pixels
    fn large_nearer<F: DepthFill<Cell>>(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        depth: &mut DepthBuffer<'_>,
        filling: F,
    ) {
        let mut large = AnyTriangle::new(&piece.triangle, scissor);
        if large.is_empty() {
            return;
        }
        let (mut over, held) = (filling.over(piece), depth.held());
        let Self { cells, scratch: RowScratch { layout, .. }, .. } = self;
        let mut stretch = Trapezoid::default();
        while large.trapezoid(&mut stretch) {
            let start @ RowOrigin { x, y, .. } = RowOrigin { x: stretch.x, y: stretch.y, shear: 0 };
            let mut filled = filling.rows(&mut over, cells, held, start);
            stretch.each(layout.at(x, y), layout.stride, |start, left, right| filled.row(start, left, right));
        }
    }

    /// Fills a triangle with cells of its own.
    #[inline(never)] // its loop needs all registers
    pub(crate) fn shaded<R: Iterator<Item = Cell>>(
        &mut self,
        triangle: &Triangle<'_>,
        scissor: &Scissor,
        run: impl Fn(Span) -> R,
    ) {
        fast::each_span(triangle, scissor, |span| {
            if let Some(cells) = self.row(span.x, span.y, span.width) {
                cells.iter_mut().zip(run(span)).for_each(|(pixel, cell)| *pixel = cell);
            }
        });
    }

    /// The same where it is nearer than what is held for the same pixels.
    #[inline(never)] // its loop needs all registers
    pub(crate) fn shaded_nearer<R: Iterator<Item = Cell>>(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        held: &mut [u16],
        run: impl Fn(Span) -> R,
    ) {
        let plane = fast::depth_gradient(&piece.triangle, &piece.depths);
        let step = plane.step();
        fast::each_span(&piece.triangle, scissor, |span| {
            let from = self.scratch.layout.at(span.x, span.y);
            let to = from.wrapping_add(span.width as usize);
            if let (Some(cells), Some(held)) = (self.cells.get_mut(from..to), held.get_mut(from..to)) {
                let mut z = plane.at(span.x, span.y);
                for ((pixel, held), cell) in cells.iter_mut().zip(held).zip(run(span)) {
                    one_nearer(pixel, held, z, cell);
                    z = z.wrapping_add(step);
                    black_box(()); // not unrolled
                }
            }
        });
    }
}

/// Fills a row, if it does not end before it begins.
#[inline(always)]
fn fill_row<Cell: Copy>(cells: &mut [Cell], start: usize, left: i32, right: i32, two: [Cell; 2], long: bool) {
    let from = start.wrapping_add(left as usize);
    // More than there are where it ends before it begins.
    let width = right.wrapping_sub(left) as usize;
    // On a Cortex-M0 most rows were walked: their ends are at hand.
    if CORTEX_M0 {
        if let Some(run) = cells.get_mut(from..from.wrapping_add(width)) {
            fill_any(run, two, long);
        }
    } else if let Some(run) = cells.get_mut(from..) {
        if let Some(run) = run.get_mut(..width) {
            fill_any(run, two, long);
        }
    }
}

/// From so many pixels on a run is long.
const LONG: i32 = 64;

/// In pairs, which become one store where memory takes that at any address: many at a time in long runs, then eight,
/// and the rest at one go. `long`: runs may be; in a short one eight more stand for the many, so that the compiler keeps no
/// other place at hand, where rows are gone through, than the one where a run begins.
#[inline(always)]
fn fill_any<Cell: Copy>(mut run: &mut [Cell], two: [Cell; 2], long: bool) {
    let [cell, _] = two;
    if run.len() >= 8 {
        if long && run.len() >= LONG as usize {
            let (many, rest) = run.split_at_mut(run.len() & !31);
            for some in many.chunks_exact_mut(32) {
                some.chunks_exact_mut(2).for_each(|pixels| pixels.copy_from_slice(&two));
                black_box(()); // not unrolled
            }
            run = rest;
        }
        if !long && run.len() >= 16 {
            let (some, rest) = run.split_at_mut(8);
            some.chunks_exact_mut(2).for_each(|pixels| pixels.copy_from_slice(&two));
            run = rest;
        }
        while let [a, b, c, d, e, f, g, h, rest @ ..] = run {
            [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [two; 4];
            run = rest;
            black_box(()); // not unrolled
        }
    }
    match run {
        [] => {}
        [a] => *a = cell,
        [a, b] => [*a, *b] = two,
        [a, b, c] => ([*a, *b], *c) = (two, cell),
        [a, b, c, d] => [[*a, *b], [*c, *d]] = [two; 2],
        [a, b, c, d, e] => ([[*a, *b], [*c, *d]], *e) = ([two; 2], cell),
        [a, b, c, d, e, f] => [[*a, *b], [*c, *d], [*e, *f]] = [two; 3],
        [a, b, c, d, e, f, g, ..] => ([[*a, *b], [*c, *d], [*e, *f]], *g) = ([two; 3], cell),
    }
}

/// The same for runs of any length.
#[inline(always)]
pub(crate) fn fill<Cell: Copy>(run: &mut [Cell], two: [Cell; 2]) {
    fill_any(run, two, true);
}

/// Two of them, of which the compiler does not know that they are alike: it keeps them in one register.
#[inline(always)]
pub(crate) fn pair<Cell: Copy>(cell: Cell) -> [Cell; 2] {
    black_box([cell; 2])
}

/// All of them.
pub(crate) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    fill(cells, pair(cell));
}
