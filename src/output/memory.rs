//! Pixels that lie in memory, and the loops that fill them.

use crate::raster::{Rows, Stretch};

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
    #[inline(always)]
    pub(crate) fn fill(self, rows: &mut Rows, cell: Cell) {
        while rows.advance() {
            let mut stretch = rows.stretch;
            let mut start = self.start(&stretch);
            for _ in 0..stretch.rows {
                let (left, right) = stretch.row();
                let (from, to) = (start.wrapping_add(left as usize), start.wrapping_add(right as usize));
                // None where it ends before it begins.
                if let Some(run) = self.cells.get_mut(from..to) {
                    fill(run, cell);
                }
                start = start.wrapping_add(self.stride);
            }
        }
    }
}

/// Eight at a time, and the rest at one go: most runs are short.
#[inline(always)]
pub(super) fn fill<Cell: Copy>(mut run: &mut [Cell], cell: Cell) {
    while let [a, b, c, d, e, f, g, h, rest @ ..] = run {
        for pixel in [a, b, c, d, e, f, g, h] {
            *pixel = cell;
        }
        run = rest;
        core::hint::black_box(()); // not unrolled
    }
    match run {
        [] => {}
        [a] => *a = cell,
        [a, b] => [a, b].into_iter().for_each(|pixel| *pixel = cell),
        [a, b, c] => [a, b, c].into_iter().for_each(|pixel| *pixel = cell),
        [a, b, c, d] => [a, b, c, d].into_iter().for_each(|pixel| *pixel = cell),
        [a, b, c, d, e] => [a, b, c, d, e].into_iter().for_each(|pixel| *pixel = cell),
        [a, b, c, d, e, f] => [a, b, c, d, e, f].into_iter().for_each(|pixel| *pixel = cell),
        [a, b, c, d, e, f, g, ..] => [a, b, c, d, e, f, g].into_iter().for_each(|pixel| *pixel = cell),
    }
}

/// All of them.
pub(super) fn clear<Cell: Copy>(cells: &mut [Cell], cell: Cell) {
    let (few, many) = cells.split_at_mut(cells.len() % 32);
    fill(few, cell);
    for some in many.chunks_exact_mut(32) {
        some.fill(cell);
        core::hint::black_box(()); // not taken for the library's `memset`, which is slower
    }
}
