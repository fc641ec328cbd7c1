//! What pixels are filled with where they are nearer than what is held.

use super::RowOrigin;
use crate::fast;
use crate::math::num::CORTEX_M0;
use crate::raster::{DepthTriangle, Gradient};
use core::hint::black_box;

/// What a triangle is filled with.
pub(crate) trait DepthFill<Cell>: Copy {
    /// Depth, and what else runs over it.
    type Over;

    /// Over a triangle.
    fn over(self, piece: &DepthTriangle<'_>) -> Self::Over;

    /// Begins filling these cells at `start`; the depths of the same pixels are held. Called once per triangle if
    /// there is shear, else once per stretch.
    fn rows<'a>(
        self,
        over: &'a mut Self::Over,
        cells: &'a mut [Cell],
        held: &'a mut [u16],
        start: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
        Self: 'a;
}

/// Rows that follow each other.
pub(crate) trait RowFill {
    /// Fills the next row, whose ends are counted from the cell at `start`; it may end before it begins.
    fn row(&mut self, start: usize, left: i32, right: i32);
}

/// One cell, given twice: of both the compiler does not know that they are alike.
impl<Cell: Copy> DepthFill<Cell> for [Cell; 2] {
    type Over = Gradient;

    #[inline(always)]
    fn over(self, piece: &DepthTriangle<'_>) -> Gradient {
        fast::depth_gradient(&piece.triangle, &piece.depths)
    }

    #[inline(always)]
    fn rows<'a>(
        self,
        depth: &'a mut Gradient,
        cells: &'a mut [Cell],
        held: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
    {
        let (cells, held) = as_long(cells, held);
        let depth = depth.sheared(shear);
        OneCell { two: self, cells, held, step: depth.step(), down: depth.row_step(), z: depth.at(x, y) }
    }
}

/// One length for both.
#[inline(always)]
pub(crate) fn as_long<'a, Cell>(
    cells: &'a mut [Cell],
    held: &'a mut [u16],
) -> (&'a mut [Cell], &'a mut [u16]) {
    let length = cells.len().min(held.len());
    match (cells.get_mut(..length), held.get_mut(..length)) {
        (Some(cells), Some(held)) => (cells, held),
        _ => Default::default(),
    }
}

/// Rows of one cell.
struct OneCell<'a, Cell> {
    two: [Cell; 2],
    cells: &'a mut [Cell],
    held: &'a mut [u16],
    step: u32,
    down: u32,
    /// Where the next row is counted from.
    z: u32,
}

impl<Cell: Copy> RowFill for OneCell<'_, Cell> {
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let Self { two, cells, held, step, down, z } = self;
        let from = start.wrapping_add(left as usize);
        let first = z.wrapping_add(step.wrapping_mul(left as u32));
        // More than there are where it ends before it begins.
        let width = right.wrapping_sub(left) as usize;
        if let (Some(run), Some(held)) = (cells.get_mut(from..), held.get_mut(from..)) {
            if let (Some(run), Some(held)) = (run.get_mut(..width), held.get_mut(..width)) {
                fill_row_nearer(run, held, first, *step, *two);
            }
        }
        *z = z.wrapping_add(*down);
    }
}

#[inline(always)]
fn fill_row_nearer<Cell: Copy>(run: &mut [Cell], held: &mut [u16], first: u32, step: u32, two: [Cell; 2]) {
    let [cell, _] = two;
    if run.len() >= MANY {
        fill_nearer(run, held, first, step, two);
    } else if CORTEX_M0 {
        fill_few_nearer(run, held, first, step, cell);
    } else {
        fill_short_nearer(run, held, first, step, cell);
    }
}

/// Fewer than [`MANY`], without a loop.
#[inline(always)]
fn fill_few_nearer<Cell: Copy>(run: &mut [Cell], held: &mut [u16], first: u32, step: u32, cell: Cell) {
    let mut z = black_box(first); // else each would be a product
    for i in 0..MANY - 1 {
        let (Some(pixel), Some(held)) = (run.get_mut(i), held.get_mut(i)) else { return };
        one_nearer(pixel, held, z, cell);
        z = z.wrapping_add(step);
    }
}

/// So many pixels at a time are faster than one by one.
pub(crate) const MANY: usize = 8;

#[inline(always)]
fn fill_short_nearer<Cell: Copy>(
    run: &mut [Cell],
    held: &mut [u16],
    mut z: u32,
    step: u32,
    cell: Cell,
) -> u32 {
    for (pixel, held) in run.iter_mut().zip(held) {
        one_nearer(pixel, held, z, cell);
        z = z.wrapping_add(step);
        black_box(()); // not unrolled
    }
    z
}

/// Many pixels at a time where nothing is held yet, as is so of most.
#[inline(never)] // its loop needs all registers
fn fill_nearer<Cell: Copy>(run: &mut [Cell], held: &mut [u16], mut z: u32, step: u32, two: [Cell; 2]) {
    let [cell, _] = two;
    // They are as long; here that is said.
    let Some(held) = held.get_mut(..run.len()) else { return };
    let ((many, rest), (held_many, held_rest)) = (run.as_chunks_mut::<MANY>(), held.as_chunks_mut::<MANY>());
    for (pixels, held) in many.iter_mut().zip(held_many) {
        if nothing_is_held(held) {
            pixels.as_chunks_mut::<2>().0.iter_mut().for_each(|pixels| *pixels = two);
            for held in held {
                *held = (z >> 16) as u16;
                z = z.wrapping_add(step);
            }
        } else {
            // Loaded anew: the way above needs the registers.
            z = fill_short_nearer(pixels, black_box(held), z, step, cell);
        }
        black_box(()); // not unrolled
    }
    fill_short_nearer(rest, held_rest, z, step, cell);
}

/// Whether that is so of all these.
#[inline(always)]
pub(crate) fn nothing_is_held(held: &[u16; MANY]) -> bool {
    if CORTEX_M0 {
        return held.iter().fold(u16::MAX, |all, &held| all & held) == u16::MAX;
    }
    // As pairs they are loaded at once.
    let pairs = held.as_chunks::<2>().0.iter().map(|&[a, b]| u32::from(a) | u32::from(b) << 16);
    pairs.fold(u32::MAX, |all, pair| all & pair) == u32::MAX
}

#[inline(always)]
pub(crate) fn one_nearer<Cell: Copy>(pixel: &mut Cell, held: &mut u16, z: u32, cell: Cell) {
    if z >> 16 < u32::from(*held) {
        (*held, *pixel) = ((z >> 16) as u16, cell);
    }
}
