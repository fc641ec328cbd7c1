//! The loops over the rows of a triangle in memory, for all that triangles are filled with, with depth and without.
//!
//! A triangle goes to the first tier that takes it, by the table in [`fast`](super). This file has no plain twin, gain or test of its
//! own: see the files that implement [`Fill`].

use super::{Low, RowOrigin, Rows, Small};
use crate::raster::{AnyTriangle, DepthTriangle, RowScratch, Scissor, Trapezoid, Triangle};
use crate::surface::{DepthBuffer, PixelRows, PixelStore};

/// A triangle, with the depths of its corners or without.
pub(super) trait Corners {
    fn triangle(&self) -> &Triangle<'_>;
}

impl Corners for Triangle<'_> {
    #[inline(always)]
    fn triangle(&self) -> &Triangle<'_> {
        self
    }
}

impl Corners for DepthTriangle<'_> {
    #[inline(always)]
    fn triangle(&self) -> &Triangle<'_> {
        &self.triangle
    }
}

/// The depths of the pixels, in the layout of the memory.
pub(super) trait Depths {
    fn values(&mut self) -> &mut [u16];
}

/// No depth buffer: every pixel is drawn.
pub(super) struct NoDepth;

impl Depths for NoDepth {
    #[inline(always)]
    fn values(&mut self) -> &mut [u16] {
        &mut []
    }
}

impl Depths for &mut DepthBuffer<'_> {
    #[inline(always)]
    fn values(&mut self) -> &mut [u16] {
        self.values_mut()
    }
}

/// What a triangle of type `T` is filled with.
pub(super) trait Fill<T, Cell> {
    /// Whether rows may be joined into one, where they follow each other in memory.
    const JOINS: bool = false;

    /// Whether the set-up costs so little that it is not worth a test whether the triangle has a row.
    const IS_FREE: bool = false;

    /// The fill, set up for the triangle: called if the triangle has a row.
    fn set_up(self, triangle: &T) -> impl FillRows<Cell>;
}

/// What the rows of a triangle are filled with.
pub(super) trait FillRows<Cell> {
    /// Prepares to fill rows of `cells` and `depths`, whose ends are counted from `start` on and which are at most `widest` sub-pixels
    /// wide, a constant. Called once per triangle for the tiers, and once per trapezoid for all other triangles.
    fn rows<'a>(
        &'a mut self,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        start: RowOrigin,
        widest: i32,
    ) -> impl FillRow
    where
        Cell: 'a;
}

/// Fills rows from top to bottom.
pub(super) trait FillRow {
    /// Fills the next row, from `left` up to but excluding `right`, both counted from index `start`; nothing if
    /// `right < left`.
    fn row(&mut self, start: usize, left: i32, right: i32);
}

/// Fills a triangle. `is_clipped`: the triangle probably has rows outside the scissor, so the [`Small`] tier is not tried.
#[inline(always)]
pub(super) fn fill_triangle<S: PixelStore, T: Corners, D: Depths, F: Fill<T, S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &T,
    scissor: &Scissor,
    is_clipped: bool,
    depths: D,
    fill: F,
) {
    match is_clipped {
        true => fill_low(memory, triangle, scissor, depths, fill),
        false => fill_small(memory, triangle, scissor, depths, fill),
    }
}

/// Fills a triangle of the [`Small`] tier; passes all others to [`fill_low`].
#[inline(never)] // its loop needs all registers
pub(super) fn fill_small<S: PixelStore, T: Corners, D: Depths, F: Fill<T, S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &T,
    scissor: &Scissor,
    mut depths: D,
    fill: F,
) {
    match Small::new(triangle.triangle(), scissor, memory.scratch()) {
        Some(small) => fill_rows(small, triangle, memory, depths.values(), fill),
        None => fill_low(memory, triangle, scissor, depths, fill),
    }
}

/// [`fill_small`] that declines all others: draws nothing and returns `false`.
#[inline(never)] // its loop needs all registers
pub(super) fn fill_only_small<S: PixelStore, T: Corners, F: Fill<T, S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &T,
    scissor: &Scissor,
    depths: &mut [u16],
    fill: F,
) -> bool {
    let Some(small) = Small::new(triangle.triangle(), scissor, memory.scratch()) else { return false };
    fill_rows(small, triangle, memory, depths, fill);
    true
}

/// Fills a triangle of the [`Low`] tier, which may be wide, and may begin or end beyond the scissor's rows; passes all others to
/// [`fill_any`].
#[inline(never)] // its loop needs all registers
pub(super) fn fill_low<S: PixelStore, T: Corners, D: Depths, F: Fill<T, S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &T,
    scissor: &Scissor,
    mut depths: D,
    fill: F,
) {
    match Low::new(triangle.triangle(), scissor, memory.scratch()) {
        Some(low) => fill_rows(low, triangle, memory, depths.values(), fill),
        // In close-ups, most triangles that `Low` declines lie beside the picture.
        None if triangle.triangle().is_beside(scissor) => {}
        None => fill_any(memory, triangle, scissor, depths, fill),
    }
}

#[inline(always)]
fn fill_rows<R: Rows, S: PixelStore, T, F: Fill<T, S::Cell>>(
    rows: R,
    triangle: &T,
    memory: &mut PixelRows<S>,
    depths: &mut [u16],
    fill: F,
) {
    if !F::IS_FREE && rows.is_empty() {
        return;
    }
    let start = rows.start(memory.scratch().layout);
    let mut fill = fill.set_up(triangle);
    // Borrowed after the set-up, which needs the registers: the other order costs 2 % of S3 with depth on an M3.
    let (cells, scratch) = memory.parts();
    let mut fill = fill.rows(cells, depths, start, R::WIDTH);
    rows.each(scratch, |start, left, right| fill.row(start, left, right));
}

/// Fills any triangle, trapezoid by trapezoid.
#[inline(never)] // rare, and most of its time is spent on pixels
fn fill_any<S: PixelStore, T: Corners, D: Depths, F: Fill<T, S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &T,
    scissor: &Scissor,
    mut depths: D,
    fill: F,
) {
    let mut trapezoids = AnyTriangle::new(triangle.triangle(), scissor);
    if !F::IS_FREE && trapezoids.is_empty() {
        return;
    }
    let (mut fill, depths) = (fill.set_up(triangle), depths.values());
    let (cells, &mut RowScratch { layout, .. }) = memory.parts();
    let mut trapezoid = Trapezoid::without_rows();
    while trapezoids.trapezoid(&mut trapezoid) {
        let origin @ RowOrigin { x, y, .. } = RowOrigin { x: trapezoid.x, y: trapezoid.y, shear: 0 };
        let mut rows = fill.rows(cells, depths, origin, i32::MAX);
        let start = layout.at(x, y);
        // A face wider than the picture is clipped at both sides: its rows join into one run.
        if F::JOINS
            && trapezoids.is_beyond
            && let Some((x, pixels)) = trapezoid.as_rectangle(layout.stride as i32)
        {
            rows.row(start, x, pixels.wrapping_add(x));
        } else {
            trapezoid.each(start, layout.stride, |start, left, right| rows.row(start, left, right));
        }
    }
}

/// Shortens the longer slice to the length of the other, so that one bounds check serves both.
#[inline(always)]
pub(super) fn same_length<'a, Cell>(
    cells: &'a mut [Cell],
    depths: &'a mut [u16],
) -> (&'a mut [Cell], &'a mut [u16]) {
    let length = cells.len().min(depths.len());
    match (cells.get_mut(..length), depths.get_mut(..length)) {
        (Some(cells), Some(depths)) => (cells, depths),
        _ => Default::default(),
    }
}
