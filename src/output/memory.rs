//! Pixels that lie in memory, and the loops that fill them.

use crate::raster::{Rows, Scissor, ScreenPoint, Stretch};

/// Pixels in memory, row by row.
pub struct Memory<'a, Cell> {
    cells: &'a mut [Cell],
    left: i32,
    top: i32,
    stride: usize,
}

impl<'a, Cell: Copy> Memory<'a, Cell> {
    /// Whose first is the pixel at (left, top).
    #[inline(always)]
    pub(super) fn new(cells: &'a mut [Cell], left: i32, top: i32, stride: usize) -> Self {
        Self { cells, left, top, stride }
    }

    /// Where the column that a stretch counts from stands in its first row: before the start, perhaps, as what is covered
    /// is not. Wraps.
    #[inline(always)]
    fn start(&self, stretch: &Stretch) -> usize {
        let row = stretch.y.wrapping_sub(self.top) as usize;
        row.wrapping_mul(self.stride).wrapping_add(stretch.x.wrapping_sub(self.left) as usize)
    }

    /// Fills a triangle's rows.
    #[inline(never)] // its loop needs all registers
    pub(crate) fn fill(self, corners: &[ScreenPoint; 3], front: bool, scissor: &Scissor, cell: Cell) {
        let two = pair(cell);
        let mut rows = Rows::new(corners, front, scissor);
        while let Some(mut stretch) = rows.stretch() {
            let mut start = self.start(&stretch);
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
}

/// Eight at a time, in pairs, which become one store where memory takes that at any address; and the rest at one go.
#[inline(always)]
pub(super) fn fill<Cell: Copy>(mut run: &mut [Cell], cell: Cell, two: [Cell; 2]) {
    while let [a, b, c, d, e, f, g, h, rest @ ..] = run {
        [[*a, *b], [*c, *d], [*e, *f], [*g, *h]] = [two; 4];
        run = rest;
        core::hint::black_box(()); // not unrolled
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
pub(super) fn pair<Cell: Copy>(cell: Cell) -> [Cell; 2] {
    core::hint::black_box([cell; 2])
}

/// All of them.
pub(super) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    let (few, many) = cells.split_at_mut(cells.len() % 32);
    fill(few, cell, pair(cell));
    for some in many.chunks_exact_mut(32) {
        some.fill(cell);
        core::hint::black_box(()); // not taken for the library's `memset`, which is slower
    }
}
