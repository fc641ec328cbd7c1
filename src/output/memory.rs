//! Pixels that lie in memory, and the loops that fill them.

use crate::raster::{Plane, Rows, Scissor, ScreenPoint, Stretch};
use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;

/// Pixels in memory, row by row.
#[derive(Debug)]
pub(super) struct Memory<'a, Cell> {
    cells: &'a mut [Cell],
    /// Where the first one lies.
    left: i32,
    top: i32,
    stride: usize,
}

impl<'a, Cell: Copy> Memory<'a, Cell> {
    #[inline(always)]
    pub(super) fn new(cells: &'a mut [Cell], area: &Rectangle) -> Self {
        let Rectangle { top_left, size } = *area;
        Self { cells, left: top_left.x, top: top_left.y, stride: size.width as usize }
    }

    /// Where pixels stand; those that are not inside wrap.
    #[inline(always)]
    fn places(&self) -> impl Fn(i32, i32) -> usize + use<'a, Cell> {
        let Self { left, top, stride, .. } = *self;
        move |x, y| {
            let (column, row) = (x.wrapping_sub(left), y.wrapping_sub(top));
            (row as usize).wrapping_mul(stride).wrapping_add(column as usize)
        }
    }

    /// A row's pixels. Those of a row that does not lie inside are others, or none.
    #[inline(always)]
    pub(super) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [Cell]> {
        let from = self.places()(x, y);
        self.cells.get_mut(from..from.wrapping_add(width as usize))
    }

    /// Fills a triangle.
    #[inline(never)] // its loop needs all registers
    pub(super) fn triangle(
        &mut self,
        corners: &[ScreenPoint; 3],
        front: bool,
        scissor: &Scissor,
        cell: Cell,
    ) {
        let (two, place) = (pair(cell), self.places());
        let mut rows = Rows::new(corners, front, scissor);
        while let Some(&(mut stretch)) = rows.stretch() {
            let Stretch { x, y, .. } = stretch;
            let mut start = place(x, y);
            while stretch.rows > 0 {
                let (left, right) = stretch.row();
                let (from, to) = (start.wrapping_add(left as usize), start.wrapping_add(right as usize));
                // None where it ends before it begins.
                if let Some(run) = self.cells.get_mut(from..to) {
                    fill(run, cell, two);
                }
                start = start.wrapping_add(self.stride);
                stretch.rows -= 1;
            }
        }
    }

    /// Fills rows where they are nearer than what is held for the same pixels.
    #[inline(never)] // its loop needs all registers
    pub(super) fn nearer(&mut self, rows: &mut Rows, plane: &Plane, held: &mut [u16], cell: Cell) {
        let (two, step, stride) = (pair(cell), plane.step(), self.stride);
        let place = self.places();
        // One length for both.
        let length = self.cells.len().min(held.len());
        let cells = self.cells.get_mut(..length).unwrap_or_default();
        let held = held.get_mut(..length).unwrap_or_default();
        while let Some(&(mut stretch)) = rows.stretch() {
            let Stretch { x, y, .. } = stretch;
            let mut start = place(x, y);
            let mut z = plane.at(x, y);
            while stretch.rows > 0 {
                let (left, right) = stretch.row();
                let (from, to) = (start.wrapping_add(left as usize), start.wrapping_add(right as usize));
                if let (Some(run), Some(held)) = (cells.get_mut(from..to), held.get_mut(from..to)) {
                    fill_nearer(run, held, z.wrapping_add(step.wrapping_mul(left as u32)), step, two);
                }
                z = z.wrapping_add(plane.down());
                start = start.wrapping_add(stride);
                stretch.rows -= 1;
            }
        }
    }
}

/// Four pixels at a time where nothing is held yet, as is so of most.
#[inline(never)] // its loop needs all registers
fn fill_nearer<Cell: Copy>(run: &mut [Cell], held: &mut [u16], mut z: u32, step: u32, two: [Cell; 2]) {
    let [cell, _] = two;
    let many = run.len() & !3;
    let ((fours, rest), (held_fours, held_rest)) = (run.split_at_mut(many), held.split_at_mut(many));
    for (pixels, held) in fours.chunks_exact_mut(4).zip(held_fours.chunks_exact_mut(4)) {
        let ([p, q, r, s], [a, b, c, d]) = (pixels, held) else { return };
        // As pairs these are loaded at once.
        let pair = |a: u16, b: u16| u32::from(a) | u32::from(b) << 16;
        if pair(*a, *b) & pair(*c, *d) == u32::MAX {
            [[*p, *q], [*r, *s]] = [two; 2];
            for held in [a, b, c, d] {
                *held = (z >> 16) as u16;
                z = z.wrapping_add(step);
            }
        } else {
            for (pixel, held) in [(p, a), (q, b), (r, c), (s, d)] {
                one_nearer(pixel, held, z, cell);
                z = z.wrapping_add(step);
            }
        }
        black_box(()); // not unrolled
    }
    for (pixel, held) in rest.iter_mut().zip(held_rest) {
        one_nearer(pixel, held, z, cell);
        z = z.wrapping_add(step);
        black_box(());
    }
}

#[inline(always)]
fn one_nearer<Cell: Copy>(pixel: &mut Cell, held: &mut u16, z: u32, cell: Cell) {
    if z >> 16 < u32::from(*held) {
        (*held, *pixel) = ((z >> 16) as u16, cell);
    }
}

/// In pairs, which become one store where memory takes that at any address: many at a time in long runs, then eight,
/// and the rest at one go.
#[inline(always)]
pub(super) fn fill<Cell: Copy>(mut run: &mut [Cell], cell: Cell, two: [Cell; 2]) {
    if run.len() >= 64 {
        let (many, rest) = run.split_at_mut(run.len() & !31);
        for some in many.chunks_exact_mut(32) {
            some.chunks_exact_mut(2).for_each(|pixels| pixels.copy_from_slice(&two));
            black_box(()); // not unrolled
        }
        run = rest;
    }
    while let [a, b, c, d, e, f, g, h, rest @ ..] = run {
        [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [two; 4];
        run = rest;
        black_box(()); // not unrolled
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

/// Two of them, of which the compiler does not know that they are alike: it keeps them in one register.
#[inline(always)]
fn pair<Cell: Copy>(cell: Cell) -> [Cell; 2] {
    black_box([cell; 2])
}

/// All of them.
pub(super) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    fill(cells, cell, pair(cell));
}
