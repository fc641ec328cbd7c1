//! Pixels that lie in memory, and the loops that fill them.

use super::DepthBuffer;
use crate::raster::{Plane, Rows, Scissor, ScreenPoint, Stretch};
use core::hint::black_box;

/// Pixels in memory, row by row; the first is the pixel at the origin.
#[derive(Debug)]
pub(super) struct Memory<'a, Cell> {
    cells: &'a mut [Cell],
    stride: usize,
}

impl<'a, Cell: Copy> Memory<'a, Cell> {
    #[inline(always)]
    pub(super) fn new(cells: &'a mut [Cell], stride: usize) -> Self {
        Self { cells, stride }
    }

    /// A row's pixels. Those of a row that does not lie inside are others, or none.
    #[inline(always)]
    pub(super) fn row(&mut self, x: i32, y: i32, width: i32) -> Option<&mut [Cell]> {
        let from = place(x, y, self.stride);
        self.cells.get_mut(from..from.wrapping_add(width as usize))
    }

    /// Fills a triangle.
    #[inline(never)] // its loop needs all registers
    pub(super) fn triangle(&mut self, corners: &[ScreenPoint; 3], front: bool, scissor: &Scissor, cell: Cell) {
        let two = pair(cell);
        let mut rows = Rows::new(corners, front, scissor);
        while let Some(&Stretch { x, y, rows, left, right }) = rows.stretch() {
            let mut stretch = Stretch { x, y, rows, left, right };
            let mut start = place(x, y, self.stride);
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

    /// Fills rows where they are nearer than what is held.
    #[inline(never)] // its loop needs all registers
    pub(super) fn nearer(&mut self, rows: &mut Rows, plane: &Plane, depth: &mut DepthBuffer<'_>, cell: Cell) {
        let step = plane.step();
        while let Some(&Stretch { x, y, rows, left, right }) = rows.stretch() {
            let mut stretch = Stretch { x, y, rows, left, right };
            let mut start = place(x, y, self.stride);
            while stretch.rows > 0 {
                let (left, right) = stretch.row();
                let (from, to) = (start.wrapping_add(left as usize), start.wrapping_add(right as usize));
                let held = depth.row(x + left, stretch.y, right - left);
                if let (Some(run), Some(held)) = (self.cells.get_mut(from..to), held) {
                    let mut z = plane.at(x + left, stretch.y);
                    for (pixel, held) in run.iter_mut().zip(held) {
                        if z >> 16 < u32::from(*held) {
                            *held = (z >> 16) as u16;
                            *pixel = cell;
                        }
                        z = z.wrapping_add(step);
                        black_box(()); // not unrolled: it would not be faster
                    }
                }
                start = start.wrapping_add(self.stride);
                stretch.y += 1;
                stretch.rows -= 1;
            }
        }
    }
}

/// Where a pixel stands; one that is not inside wraps.
#[inline(always)]
fn place(x: i32, y: i32, stride: usize) -> usize {
    (y as usize).wrapping_mul(stride).wrapping_add(x as usize)
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
