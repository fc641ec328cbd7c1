//! Triangles of one colour against a depth buffer, into memory.
//!
//! - **Plain twin**: `pipeline::fill::fill_nearer`: `DepthBuffer::test` for each span, and `Target::fill` for each run of
//!   visible pixels.
//! - **Domain**: every triangle, on a target whose pixels lie in memory, where the depth buffer is laid out as the memory is.
//! - **Gain**: depth and colour are written in one loop, eight pixels at once where the depth buffer is still clear, the common
//!   case. Not measured alone: all fast paths together halve the time of S3.
//! - **Test**: `by_every_call` in `tests/support/src/bridge/ways.rs`.
//!
//! The loops over triangles and rows also serve [table lookup](super::table_fill): what differs is behind the trait
//! [`DepthFill`].

use super::{depth_gradient, memory_of, Low, RowOrigin, Rows, Small};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::{keep_rolled, opaque};
use crate::math::unrolled::each8;
use crate::raster::{AnyTriangle, DepthTriangle, Gradient, RowScratch, Scissor, Trapezoid};
use crate::surface::block_fill::fill_eight;
use crate::surface::{DepthBuffer, DepthTarget, PixelRows, PixelStore, Target};

/// What the pixels of a triangle are set to where they are nearer than the depth buffer.
pub(crate) trait DepthFill<Cell>: Copy {
    /// The gradient of depth, and those of other values that vary over the triangle.
    type Gradients;

    /// Sets up the gradients for a triangle.
    fn set_up(self, triangle: &DepthTriangle<'_>) -> Self::Gradients;

    /// Prepares to fill rows of `cells` and `depths`, whose ends are counted from `start` on. Called once per triangle on a
    /// Cortex-M0, where the row ends have a [shear](RowOrigin::shear), and once per trapezoid on other cores.
    fn rows<'a>(
        self,
        gradients: &'a mut Self::Gradients,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        start: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
        Self: 'a;
}

/// Fills rows from top to bottom.
pub(crate) trait RowFill {
    /// Fills the next row, from `left` up to but excluding `right`, both counted from index `start`; nothing if
    /// `right < left`.
    fn row(&mut self, start: usize, left: i32, right: i32);
}

/// Fills a triangle where it is nearer than the depth buffer, if the target's pixels lie in memory and the depth buffer
/// [has their layout](DepthTarget::is_aligned); otherwise draws nothing and returns `false`. `is_clipped`: the
/// triangle probably has rows outside the scissor, so the [`Small`] tier is not tried.
#[inline(always)]
pub(crate) fn triangle_nearer<T: Target>(
    triangle: &DepthTriangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let cell: <T::Store as PixelStore>::Cell = color.stored();
    fill_nearer(triangle, [cell; 2], scissor, is_clipped, depth, target)
}

/// [`triangle_nearer`] with any [`DepthFill`] in place of one colour.
#[inline(always)]
pub(super) fn fill_nearer<T: Target, F: DepthFill<<T::Store as PixelStore>::Cell>>(
    triangle: &DepthTriangle<'_>,
    fill: F,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    match is_clipped {
        true => fill_low(memory, triangle, scissor, depth.buffer, fill),
        false => fill_small(memory, triangle, scissor, depth.buffer, fill),
    }
    true
}

/// Fills a triangle of the [`Small`] tier; passes all others to [`fill_low`].
#[inline(never)] // its loop needs all registers
fn fill_small<S: PixelStore, F: DepthFill<S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    fill: F,
) {
    match Small::new(&triangle.triangle, scissor, memory.scratch()) {
        Some(small) => fill_rows(small, triangle, memory, depth.values_mut(), fill),
        None => fill_low(memory, triangle, scissor, depth, fill),
    }
}

/// Fills a triangle of the [`Low`] tier, which may be wide, and may begin or end beyond the scissor's rows; passes all others to
/// [`fill_any`].
#[inline(never)]
fn fill_low<S: PixelStore, F: DepthFill<S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    fill: F,
) {
    match Low::new(&triangle.triangle, scissor, memory.scratch()) {
        Some(low) => fill_rows(low, triangle, memory, depth.values_mut(), fill),
        // In close-ups, most triangles that `Low` declines lie beside the picture.
        None if triangle.triangle.is_beside(scissor) => {}
        None => fill_any(memory, triangle, scissor, depth, fill),
    }
}

#[inline(always)]
pub(super) fn fill_rows<S: PixelStore, F: DepthFill<S::Cell>>(
    rows: impl Rows,
    triangle: &DepthTriangle<'_>,
    memory: &mut PixelRows<S>,
    depths: &mut [u16],
    fill: F,
) {
    if !rows.is_empty() {
        let start = rows.start(memory.scratch().layout);
        let mut gradients = fill.set_up(triangle);
        // Borrowed after the set-up, which needs the registers: the other order costs 2 % of S3 with depth on an M3.
        let (cells, scratch) = memory.parts();
        let mut filler = fill.rows(&mut gradients, cells, depths, start);
        rows.each(scratch, |start, left, right| filler.row(start, left, right));
    }
}

/// Fills any triangle, trapezoid by trapezoid.
#[inline(never)] // rare, and most of its time is spent on pixels
fn fill_any<S: PixelStore, F: DepthFill<S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthBuffer<'_>,
    fill: F,
) {
    let mut trapezoids = AnyTriangle::new(&triangle.triangle, scissor);
    if trapezoids.is_empty() {
        return;
    }
    let (mut gradients, depths) = (fill.set_up(triangle), depth.values_mut());
    let (cells, RowScratch { layout, .. }) = memory.parts();
    let mut trapezoid = Trapezoid::without_rows();
    while trapezoids.trapezoid(&mut trapezoid) {
        let start @ RowOrigin { x, y, .. } = RowOrigin { x: trapezoid.x, y: trapezoid.y, shear: 0 };
        let mut filler = fill.rows(&mut gradients, cells, depths, start);
        trapezoid.each(layout.at(x, y), layout.stride, |start, left, right| filler.row(start, left, right));
    }
}

/// One colour: its stored pixel, given twice. LLVM does not know that both are equal, so it stores two 16-bit pixels from one
/// register.
impl<Cell: Copy> DepthFill<Cell> for [Cell; 2] {
    type Gradients = Gradient;

    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> Gradient {
        depth_gradient(&triangle.triangle, &triangle.depths)
    }

    #[inline(always)]
    fn rows<'a>(
        self,
        depth: &'a mut Gradient,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        start: RowOrigin,
    ) -> impl RowFill
    where
        Cell: 'a,
    {
        DepthRows::new(depth, cells, depths, start, self)
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

/// What fills the cells and depths of a row, given depth at its first pixel and its change from pixel to pixel.
pub(super) trait FillRun<Cell> {
    fn fill(&mut self, run: &mut [Cell], depths: &mut [u16], first: u32, step: u32);
}

impl<Cell: Copy> FillRun<Cell> for [Cell; 2] {
    #[inline(always)]
    fn fill(&mut self, run: &mut [Cell], depths: &mut [u16], first: u32, step: u32) {
        fill_row(run, depths, first, step, *self);
    }
}

/// Rows of cells and depths, with depth along them.
pub(super) struct DepthRows<'a, Cell, F> {
    fill: F,
    cells: &'a mut [Cell],
    depths: &'a mut [u16],
    /// The change of depth from a pixel to its right neighbour, and from row to row.
    step: u32,
    down: u32,
    /// Depth at the origin that the next row's ends are counted from.
    z: u32,
}

impl<'a, Cell, F> DepthRows<'a, Cell, F> {
    #[inline(always)]
    pub(super) fn new(
        depth: &Gradient,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
        fill: F,
    ) -> Self {
        let (cells, depths) = same_length(cells, depths);
        let depth = depth.sheared(shear);
        Self { fill, cells, depths, step: depth.step(), down: depth.row_step(), z: depth.at(x, y) }
    }
}

impl<Cell, F: FillRun<Cell>> RowFill for DepthRows<'_, Cell, F> {
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let Self { fill, cells, depths, step, down, z } = self;
        let from = start.wrapping_add(left as usize);
        let first = z.wrapping_add(step.wrapping_mul(left as u32));
        // If the row ends before it begins, the difference wraps to more than any slice has.
        let width = right.wrapping_sub(left) as usize;
        if let Some((run, depths)) = part(cells, depths, from, width) {
            fill.fill(run, depths, first, *step);
        }
        *z = z.wrapping_add(*down);
    }
}

/// `width` cells and depths from index `from` on, if there are as many. Both slices have equal lengths.
///
/// One check after the other: at opt-level "s" LLVM makes of checks in pairs a selection between a pointer and null, and then
/// recomputes the lengths from pointers for each row.
#[inline(always)]
pub(super) fn part<'r, Cell>(
    cells: &'r mut [Cell],
    depths: &'r mut [u16],
    from: usize,
    width: usize,
) -> Option<(&'r mut [Cell], &'r mut [u16])> {
    let cells = cells.get_mut(from..)?;
    let cells = cells.get_mut(..width)?;
    let depths = depths.get_mut(from..)?;
    let depths = depths.get_mut(..width)?;
    Some((cells, depths))
}

#[inline(always)]
pub(super) fn fill_row<Cell: Copy>(
    run: &mut [Cell],
    depths: &mut [u16],
    first: u32,
    step: u32,
    pair: [Cell; 2],
) {
    let [cell, _] = pair;
    if run.len() >= BLOCK {
        fill_blocks(run, depths, first, step, pair);
    } else if CORTEX_M0 {
        fill_few(run, depths, first, step, cell);
    } else {
        fill_each(run, depths, first, step, cell);
    }
}

/// Fills fewer than [`BLOCK`] pixels without a loop: on a Cortex-M0 S3 and S4 with depth take 3 % fewer instructions than with
/// one; on an M3 it would be 7 % more (`docs/decisions.md`).
#[inline(always)]
fn fill_few<Cell: Copy>(run: &mut [Cell], depths: &mut [u16], first: u32, step: u32, cell: Cell) {
    let mut z = opaque(first); // else LLVM multiplies for each pixel instead of adding
    for i in 0..BLOCK - 1 {
        let (Some(pixel), Some(stored)) = (run.get_mut(i), depths.get_mut(i)) else { return };
        put_nearer(pixel, stored, z, cell);
        z = z.wrapping_add(step);
    }
}

/// The number of pixels that are tested together for a clear depth buffer.
pub(super) const BLOCK: usize = 8;

/// Fills pixels one by one; returns the depth after the last one.
#[inline(always)]
fn fill_each<Cell: Copy>(run: &mut [Cell], depths: &mut [u16], mut z: u32, step: u32, cell: Cell) -> u32 {
    for (pixel, stored) in run.iter_mut().zip(depths) {
        put_nearer(pixel, stored, z, cell);
        z = z.wrapping_add(step);
        keep_rolled();
    }
    z
}

/// Fills a long run, eight pixels at once where the depth buffer is still clear, the common case.
#[inline(never)] // its loop needs all registers
pub(super) fn fill_blocks<Cell: Copy>(
    run: &mut [Cell],
    depths: &mut [u16],
    mut z: u32,
    step: u32,
    pair: [Cell; 2],
) {
    let [cell, _] = pair;
    // The lengths are equal already; this tells the compiler.
    let Some(depths) = depths.get_mut(..run.len()) else { return };
    let ((blocks, rest), (depth_blocks, depth_rest)) =
        (run.as_chunks_mut::<BLOCK>(), depths.as_chunks_mut::<BLOCK>());
    for (pixels, depths) in blocks.iter_mut().zip(depth_blocks) {
        if is_clear(depths) {
            fill_eight(pixels, pair);
            each8(depths, |stored| {
                *stored = (z >> 16) as u16;
                z = z.wrapping_add(step);
            });
        } else if CORTEX_M0 {
            // `opaque`: the depths are loaded again, because the branch above needs the registers.
            z = fill_each(pixels, opaque(depths), z, step, cell);
        } else {
            fill_mixed(pixels, depths, z, step, cell);
            z = z.wrapping_add(step.wrapping_mul(BLOCK as u32));
        }
        keep_rolled();
    }
    fill_each(rest, depth_rest, z, step, cell);
}

/// Fills a block whose depths are not all clear. On a Cortex-M0, [`fill_each`] is inlined instead: that core has too few registers to
/// gain by a call, which makes S2 5 % slower.
#[cold] // so that the loop over clear blocks keeps its registers, and this call saves them
#[inline(never)]
fn fill_mixed<Cell: Copy>(
    pixels: &mut [Cell; BLOCK],
    depths: &mut [u16; BLOCK],
    z: u32,
    step: u32,
    cell: Cell,
) {
    fill_each(pixels, depths, z, step, cell);
}

/// Whether the depth buffer is clear at all of these pixels.
#[inline(always)]
pub(super) fn is_clear(depths: &[u16; BLOCK]) -> bool {
    let &[a, b, c, d, e, f, g, h] = depths;
    if CORTEX_M0 {
        return a & b & c & d & e & f & g & h == u16::MAX;
    }
    // In pairs, so that each is loaded as one word.
    let pair = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
    pair(a, b) & pair(c, d) & pair(e, f) & pair(g, h) == u32::MAX
}

/// The depth test for one pixel: sets `pixel` and its `stored` depth if `z`, in 16.16, is nearer.
#[inline(always)]
pub(super) fn put_nearer<Cell: Copy>(pixel: &mut Cell, stored: &mut u16, z: u32, cell: Cell) {
    if z >> 16 < u32::from(*stored) {
        (*stored, *pixel) = ((z >> 16) as u16, cell);
    }
}
