//! Pixels that lie in memory, and the loops that fill them.

use super::depth::DepthBuffer;
use super::nearer::{one_nearer, Nearer, Rows};
use crate::math::num::keep_apart;
use crate::raster::{Divisor, Halves, Large, Low, Piece, Scissor, Small, Span, Step, Stretch, Triangle};
use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;

/// Pixels in memory, row by row.
#[derive(Debug)]
pub(super) struct Memory<'a, Cell> {
    pub(super) cells: &'a mut [Cell],
    /// Where the first one lies.
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) stride: usize,
    /// Where the pixel in column 0 and row 0 would stand, wrapping.
    origin: usize,
}

impl<'a, Cell: Copy> Memory<'a, Cell> {
    #[inline(always)]
    pub(super) fn new(cells: &'a mut [Cell], area: &Rectangle) -> Self {
        let Rectangle { top_left, size } = *area;
        let (left, top, stride) = (top_left.x, top_left.y, size.width as usize);
        Self { cells, left, top, stride, origin: place(left, top, stride).wrapping_neg() }
    }

    /// Where pixels stand; those that are not inside wrap.
    #[inline(always)]
    fn places(&self) -> impl Fn(i32, i32) -> usize + use<'a, Cell> {
        let Self { origin, stride, .. } = *self;
        move |x, y| place(x, y, stride).wrapping_add(origin)
    }

    /// A row's pixels. Those of a row that does not lie inside are others, or none.
    #[inline(always)]
    pub(super) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [Cell]> {
        let from = self.places()(x, y);
        self.cells.get_mut(from..from.wrapping_add(width as usize))
    }

    /// Fills a triangle. With two cells alike, of which the compiler does not know that here: it keeps them in one register.
    #[inline(never)] // its loop needs all registers
    pub(super) fn triangle(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        match Small::new(triangle, scissor) {
            Some(halves) => self.halves(halves, two),
            None => self.cut(triangle, scissor, two),
        }
    }

    /// One that is cut, wide or large.
    #[inline(never)]
    fn cut(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        match Low::new(triangle, scissor) {
            Some(halves) => self.halves(halves, two),
            None => self.large(triangle, scissor, two),
        }
    }

    #[inline(never)] // its loop needs all registers
    fn large(&mut self, triangle: &Triangle<'_>, scissor: &Scissor, two: [Cell; 2]) {
        let mut large = Large::new(triangle, scissor);
        while let Some(stretch) = large.stretch() {
            match stretch.upright(self.stride as i32) {
                // All of so many rows, as where a large face is cut on both sides: one run.
                Some((x, pixels)) => {
                    if let Some(run) = self.row(x, stretch.y, pixels) {
                        fill(run, two);
                    }
                }
                None => {
                    let start = self.places()(stretch.x, stretch.y);
                    self.stretch(stretch, start, two, true);
                }
            }
        }
    }

    #[inline(always)]
    fn halves<D: Divisor, const CUT: bool>(&mut self, halves: Halves<D, CUT>, two: [Cell; 2]) {
        let (x, y) = halves.first();
        let mut start = self.places()(x, y);
        let long = D::WIDTH > LONG << 8;
        halves.each(|stretch| start = self.stretch(stretch, start, two, long));
    }

    /// From where the first row starts, to where the one below does. `long`: rows may be.
    #[inline(always)]
    fn stretch<S: Step>(
        &mut self,
        mut stretch: Stretch<S>,
        mut start: usize,
        two: [Cell; 2],
        long: bool,
    ) -> usize {
        let stride = self.stride;
        let cells = &mut *self.cells;
        while stretch.rows > 0 {
            let (left, right) = stretch.row();
            let from = start.wrapping_add(left as usize);
            // More than there are where it ends before it begins.
            let width = right.wrapping_sub(left) as usize;
            if let Some(run) = cells.get_mut(from..) {
                keep_apart();
                if let Some(run) = run.get_mut(..width) {
                    fill_any(run, two, long);
                }
            }
            start = start.wrapping_add(stride);
            stretch.rows -= 1;
        }
        start
    }

    /// Fills a triangle where it is nearer than what is held for the same pixels.
    #[inline(never)] // its loop needs all registers
    pub(super) fn nearer<F: Nearer<Cell>>(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        depth: &mut DepthBuffer<'_>,
        filling: F,
    ) {
        match Small::new(&piece.triangle, scissor) {
            Some(halves) => self.halves_nearer(halves, piece, depth.held(), filling),
            None => self.cut_nearer(piece, scissor, depth, filling),
        }
    }

    /// One that is cut, wide or large.
    #[inline(never)]
    fn cut_nearer<F: Nearer<Cell>>(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        depth: &mut DepthBuffer<'_>,
        filling: F,
    ) {
        if let Some(halves) = Low::new(&piece.triangle, scissor) {
            return self.halves_nearer(halves, piece, depth.held(), filling);
        }
        let large = Large::new(&piece.triangle, scissor);
        if !large.is_empty() {
            self.large_nearer(large, &filling.over(piece), depth.held(), filling);
        }
    }

    #[inline(always)]
    fn halves_nearer<D: Divisor, F: Nearer<Cell>, const CUT: bool>(
        &mut self,
        halves: Halves<D, CUT>,
        piece: &Piece<'_>,
        held: &mut [u16],
        filling: F,
    ) {
        if !halves.is_empty() {
            let over = filling.over(piece);
            let (x, y) = halves.first();
            let mut start = self.places()(x, y);
            let mut rows = filling.rows(&over, self.cells, held, (x, y));
            halves.each(|stretch| start = stretch_nearer(stretch, start, self.stride, &mut rows));
        }
    }

    #[inline(never)] // rare, and most of it a row's pixels
    fn large_nearer<F: Nearer<Cell>>(
        &mut self,
        mut large: Large,
        over: &F::Over,
        held: &mut [u16],
        filling: F,
    ) {
        while let Some(stretch) = large.stretch() {
            let from @ (x, y) = (stretch.x, stretch.y);
            let (start, stride) = (self.places()(x, y), self.stride);
            stretch_nearer(stretch, start, stride, &mut filling.rows(over, self.cells, held, from));
        }
    }

    /// Fills a triangle with cells of its own.
    #[inline(never)] // its loop needs all registers
    pub(super) fn shaded<R: Iterator<Item = Cell>>(
        &mut self,
        triangle: &Triangle<'_>,
        scissor: &Scissor,
        run: impl Fn(Span) -> R,
    ) {
        triangle.each_span(scissor, |span| {
            if let Some(cells) = self.row(span.x, span.y, span.width) {
                cells.iter_mut().zip(run(span)).for_each(|(pixel, cell)| *pixel = cell);
            }
        });
    }

    /// The same where it is nearer than what is held for the same pixels.
    #[inline(never)] // its loop needs all registers
    pub(super) fn shaded_nearer<R: Iterator<Item = Cell>>(
        &mut self,
        piece: &Piece<'_>,
        scissor: &Scissor,
        held: &mut [u16],
        run: impl Fn(Span) -> R,
    ) {
        let plane = piece.plane();
        let (places, step) = (self.places(), plane.step());
        piece.triangle.each_span(scissor, |span| {
            let from = places(span.x, span.y);
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

/// From where the first row starts, to where the one below does.
#[inline(always)]
fn stretch_nearer<S: Step>(
    mut stretch: Stretch<S>,
    mut start: usize,
    stride: usize,
    rows: &mut impl Rows,
) -> usize {
    while stretch.rows > 0 {
        let (left, right) = stretch.row();
        rows.row(start, left, right);
        rows.below();
        start = start.wrapping_add(stride);
        stretch.rows -= 1;
    }
    start
}

/// Where a pixel stands; one that is not inside wraps.
#[inline(always)]
pub(super) fn place(x: i32, y: i32, stride: usize) -> usize {
    (y as usize).wrapping_mul(stride).wrapping_add(x as usize)
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
pub(super) fn fill<Cell: Copy>(run: &mut [Cell], two: [Cell; 2]) {
    fill_any(run, two, true);
}

/// Two of them, of which the compiler does not know that they are alike: it keeps them in one register.
#[inline(always)]
pub(super) fn pair<Cell: Copy>(cell: Cell) -> [Cell; 2] {
    black_box([cell; 2])
}

/// All of them.
pub(super) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    fill(cells, pair(cell));
}
