//! Triangles of one colour, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill`, which passes each span to `Surface::fill`; with depth `fill_nearer`:
//!   `DepthBuffer::test` for each span, and `Surface::fill` for each run of visible pixels.
//! - **Domain**: every triangle, on a target whose pixels lie in memory; with depth, only where the depth buffer is laid out as the
//!   memory is.
//! - **Gain**: rows go from the edge walker to the cells without a span in between; a small triangle (32 × 30 pixels, or 31 rows
//!   on a Cortex-M0) has a loop of its own with all registers. Depth and colour are written in one loop. Not measured alone: all
//!   fast paths together halve the time of S3.
//! - **Test**: `by_every_call` in `tests/support/src/bridge/ways.rs`, and `tests/raster/memory_triangles.rs`.

use super::attach::memory_with_drawable;
use super::fill_rows::{fill_small, fill_triangle, same_length, Fill, FillRow, FillRows, NoDepth};
use super::put_run::{put_blocks_nearer, put_each_nearer, Blocks, Equal, BLOCK};
use super::{depth_gradient, memory_of, RowOrigin};
use crate::color::StoredPixel;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::opaque;
use crate::raster::{DepthTriangle, Gradient, Scissor, ScreenPoint, Triangle};
use crate::surface::block_fill::{fill_pairs, LONG};
use crate::surface::{DepthTarget, Surface};

/// Fills a triangle, if the target's pixels lie in memory; otherwise draws nothing and returns `false`. `is_clipped`: the
/// triangle probably has rows outside the scissor, so the [`Small`](super::Small) tier is not tried.
#[inline(always)]
pub(crate) fn triangle<T: Surface>(
    triangle: &Triangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill_triangle(memory, triangle, scissor, is_clipped, NoDepth, Equal([color.stored(); 2]));
    true
}

/// [`triangle`] for 2D drawing, clipped to the part of the target that 2D drawing can reach. `area` is the
/// [`area`](crate::raster::area()) of the corners and not zero.
#[inline(always)]
pub(crate) fn triangle_2d<T: Surface>(
    corners: [ScreenPoint; 3],
    area: i64,
    color: T::Color,
    target: &mut T,
) -> bool {
    let Some((scissor, memory)) = memory_with_drawable(target) else { return false };
    let triangle = Triangle::new(corners, area, scissor);
    fill_small(memory, &triangle, scissor, NoDepth, Equal([color.stored(); 2]));
    true
}

/// [`triangle`] for the pixels that are nearer than the depth buffer; declines too if the depth buffer does not
/// [have the layout of the memory](DepthTarget::is_aligned).
#[inline(always)]
pub(crate) fn triangle_nearer<T: Surface>(
    triangle: &DepthTriangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    let fill = Equal([color.stored(); 2]);
    fill_triangle(memory, triangle, scissor, is_clipped, &mut *depth.buffer, fill);
    true
}

impl<Cell: Copy> Fill<Triangle<'_>, Cell> for Equal<Cell> {
    const JOINS: bool = true;
    const IS_FREE: bool = true;

    #[inline(always)]
    fn set_up(self, _: &Triangle<'_>) -> impl FillRows<Cell> {
        self
    }
}

impl<Cell: Copy> FillRows<Cell> for Equal<Cell> {
    #[inline(always)]
    fn rows<'a>(
        &'a mut self,
        cells: &'a mut [Cell],
        _: &'a mut [u16],
        _: RowOrigin,
        widest: i32,
    ) -> impl FillRow
    where
        Cell: 'a,
    {
        EqualRows { cells, equal: *self, may_be_long: widest > LONG << 8 }
    }
}

/// Rows of equal cells.
pub(super) struct EqualRows<'a, Cell> {
    pub(super) cells: &'a mut [Cell],
    pub(super) equal: Equal<Cell>,
    /// Whether rows may have more than a few pixels: a constant of the tier, known when its loop is compiled.
    pub(super) may_be_long: bool,
}

impl<Cell: Copy> FillRow for EqualRows<'_, Cell> {
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let from = start.wrapping_add(left as usize);
        // If the row ends before it begins, the difference wraps to more than any slice has.
        let width = right.wrapping_sub(left) as usize;
        let Equal(pair) = self.equal;
        // On a Cortex-M0 both ends are indices already; on other cores the width is in a register. One check after the other, as in `part`:
        // S3 at opt-level "s" takes 5 % less on an M3 (`tools/bench/run cells S3 plain-s M3`).
        if CORTEX_M0 {
            if let Some(run) = self.cells.get_mut(from..from.wrapping_add(width)) {
                fill_pairs(run, pair, self.may_be_long);
            }
        } else if let Some(run) = self.cells.get_mut(from..)
            && let Some(run) = run.get_mut(..width)
        {
            fill_pairs(run, pair, self.may_be_long);
        }
    }
}

impl<Cell: Copy> Fill<DepthTriangle<'_>, Cell> for Equal<Cell> {
    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> impl FillRows<Cell> {
        NearerFill { depth: depth_gradient(&triangle.triangle, &triangle.depths), fill: self }
    }
}

/// A fill, and the gradient of depth.
pub(super) struct NearerFill<F> {
    pub(super) depth: Gradient,
    pub(super) fill: F,
}

impl<Cell, F: FillRun<Cell>> FillRows<Cell> for NearerFill<F> {
    #[inline(always)]
    fn rows<'a>(
        &'a mut self,
        cells: &'a mut [Cell],
        depths: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
        _: i32,
    ) -> impl FillRow
    where
        Cell: 'a,
    {
        let (cells, depths) = same_length(cells, depths);
        let depth = self.depth.sheared(shear);
        let (step, down, z) = (depth.step(), depth.row_step(), depth.at(x, y));
        NearerRows { fill: &mut self.fill, cells, depths, step, down, z }
    }
}

/// What fills the cells and depths of a row, given depth at its first pixel and its change from pixel to pixel.
pub(super) trait FillRun<Cell> {
    fn fill(&mut self, run: &mut [Cell], depths: &mut [u16], first: u32, step: u32);
}

impl<Cell: Copy> FillRun<Cell> for Equal<Cell> {
    #[inline(always)]
    fn fill(&mut self, run: &mut [Cell], depths: &mut [u16], first: u32, step: u32) {
        fill_equal_nearer(run, depths, first, step, *self);
    }
}

/// Rows of cells and depths, with depth along them.
pub(super) struct NearerRows<'a, Cell, F> {
    pub(super) fill: &'a mut F,
    pub(super) cells: &'a mut [Cell],
    pub(super) depths: &'a mut [u16],
    /// The change of depth from a pixel to its right neighbour, and from row to row.
    pub(super) step: u32,
    pub(super) down: u32,
    /// Depth at the origin that the next row's ends are counted from.
    pub(super) z: u32,
}

impl<Cell, F: FillRun<Cell>> FillRow for NearerRows<'_, Cell, F> {
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
fn part<'r, Cell>(
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

/// Fills a run of any length where it is nearer than the depth buffer.
#[inline(always)]
pub(super) fn fill_equal_nearer<Cell: Copy>(
    run: &mut [Cell],
    depths: &mut [u16],
    first: u32,
    step: u32,
    equal: Equal<Cell>,
) {
    if run.len() >= BLOCK {
        fill_long_nearer(run, depths, first, step, equal);
    } else if CORTEX_M0 {
        fill_few_nearer(run, depths, first, step, equal);
    } else {
        put_each_nearer::<Cell, true>(run, depths, first, step, &mut equal.inks());
    }
}

/// Fills fewer than [`BLOCK`] pixels without a loop: on a Cortex-M0 S3 and S4 with depth take 3 % fewer instructions than with
/// one; on an M3 it would be 7 % more (`docs/decisions.md`).
#[inline(always)]
fn fill_few_nearer<Cell: Copy>(
    run: &mut [Cell],
    depths: &mut [u16],
    first: u32,
    step: u32,
    Equal([cell, _]): Equal<Cell>,
) {
    let mut z = opaque(first); // else LLVM multiplies for each pixel instead of adding
    for i in 0..BLOCK - 1 {
        let (Some(pixel), Some(stored)) = (run.get_mut(i), depths.get_mut(i)) else { return };
        if z >> 16 < u32::from(*stored) {
            (*stored, *pixel) = ((z >> 16) as u16, cell);
        }
        z = z.wrapping_add(step);
    }
}

/// Fills a run of [`BLOCK`] pixels or more where it is nearer than the depth buffer.
#[inline(never)] // its loop needs all registers
pub(super) fn fill_long_nearer<Cell: Copy>(
    run: &mut [Cell],
    depths: &mut [u16],
    first: u32,
    step: u32,
    equal: Equal<Cell>,
) {
    put_blocks_nearer(run, depths, first, step, equal);
}
