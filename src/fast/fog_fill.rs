//! Triangles of one colour in several levels of fog, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill` and `fill_nearer` with the spans of a shader that has
//!   `FastPath::levels`: [`Fogged`](crate::fog::Fogged).
//! - **Domain**: every triangle, on a target whose pixels lie in memory; with depth, only where the depth buffer is laid out as the
//!   memory is.
//! - **Gain**: a colour is mixed where the level changes, not at each pixel; a row in one level, the common case, is filled like
//!   a row of one colour, after two comparisons. With depth, the gradient of depth serves fog too. Through the loops of
//!   [`shaded_fill`](super::shaded_fill) instead, G1 takes 20 % more instructions on an M3, and 67 % more with depth
//!   (`tools/bench/run cells G1 G2`).
//! - **Test**: `tests/shading/fog.rs`, by every draw call.

use super::fill_rows::{fill_triangle, Fill, FillRows};
use super::put_run::{put_each, put_each_nearer, Equal, Stored, BLOCK};
use super::shaded_fill::fill;
use super::solid_fill::{fill_equal_nearer, fill_long_nearer, FillRun, NearerFill};
use super::{depth_gradient, memory_of};
use crate::color::StoredPixel;
use crate::raster::{DepthTriangle, Scissor, Triangle};
use crate::shading::{DepthLevels, FogBounds, FogLevel};
use crate::surface::block_fill::{fill_pairs, pair};
use crate::surface::{DepthTarget, Surface};

/// Fills a triangle with one colour for each level, if the target's pixels lie in memory; otherwise draws nothing and returns
/// `false`.
#[inline(always)]
pub(crate) fn triangle<T: Surface, F: Fn(u8) -> T::Color + Copy>(
    triangle: &Triangle<'_>,
    fog: &DepthLevels<'_, F>,
    scissor: &Scissor,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let gradient = depth_gradient(triangle, &fog.depths);
    let color = fog.color;
    let mut levels = Levels::new(fog, move |level| color(level).stored());
    fill(memory, triangle, scissor, &mut |cells, span| {
        let (first, step, width) = (gradient.at(span.x, span.y), gradient.step(), cells.len());
        if width < BLOCK {
            levels.short_row(cells, first, step);
        } else if levels.has(first, step, width) {
            fill_pairs(cells, levels.first.pair, true);
        } else {
            levels.row::<false>(cells, &mut [], first, step);
        }
    });
    true
}

/// [`triangle`] for the pixels that are nearer than the depth buffer; declines too if the depth buffer does not
/// [have the layout of the memory](DepthTarget::is_aligned). `is_clipped`: the triangle probably has rows outside the scissor.
#[inline(always)]
pub(crate) fn triangle_nearer<T: Surface, F: Fn(u8) -> T::Color + Copy>(
    triangle: &DepthTriangle<'_>,
    fog: &DepthLevels<'_, F>,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    fill_triangle(memory, triangle, scissor, is_clipped, &mut *depth.buffer, fog);
    true
}

impl<Cell: Copy, C: StoredPixel<Cell>, F: Fn(u8) -> C + Copy> Fill<DepthTriangle<'_>, Cell>
    for &DepthLevels<'_, F>
{
    /// The depths of `triangle` equal `self.depths`, from which the levels are computed.
    #[inline(always)]
    fn set_up(self, triangle: &DepthTriangle<'_>) -> impl FillRows<Cell> {
        let (depth, color) = (depth_gradient(&triangle.triangle, &triangle.depths), self.color);
        NearerFill { depth, fill: Levels::new(self, move |level| color(level).stored()) }
    }
}

/// A level of fog, and its cell as a [`pair`].
#[derive(Clone, Copy)]
struct Known<Cell> {
    level: FogLevel,
    pair: [Cell; 2],
}

/// Two levels of a triangle: the level of the first pixel of the row filled last, and the other level that this row ended with.
/// Most rows go from one level to another one, and the next row mostly has these two again.
struct Levels<'t, Cell, F> {
    bounds: &'t FogBounds,
    color: F,
    first: Known<Cell>,
    other: Known<Cell>,
}

impl<'t, Cell: Copy, F: Fn(u8) -> Cell> Levels<'t, Cell, F> {
    #[inline(always)]
    fn new<G>(&DepthLevels { bounds, first, .. }: &DepthLevels<'t, G>, color: F) -> Self {
        let level = FogLevel::new(first, bounds);
        let first = Known { level, pair: pair(color(level.level())) };
        Self { bounds, color, first, other: first }
    }

    /// Whether a row lies in one level, that of the last row's first pixel. Depth is monotonic along a row: if both ends have the
    /// level, all pixels have.
    #[inline(always)]
    fn has(&self, first: u32, step: u32, width: usize) -> bool {
        let last = first.wrapping_add(step.wrapping_mul((width as u32).wrapping_sub(1)));
        self.first.level.has(first) && self.first.level.has(last)
    }

    /// The level of a row's first pixel.
    #[inline(always)]
    fn begin(&mut self, depth: u32) -> Known<Cell> {
        if !self.first.level.has(depth) {
            self.find_first(depth);
        }
        self.first
    }

    /// The level of a further pixel.
    #[inline(always)]
    fn next(&mut self, depth: u32) -> Known<Cell> {
        if !self.other.level.has(depth) {
            self.find(depth);
        }
        self.other
    }

    /// Sets the level of the first pixel to the level of `depth`, and the other level to the former first one.
    #[inline(never)] // it would take the registers of the loops over pixels
    fn find_first(&mut self, depth: u32) {
        if !self.other.level.has(depth) {
            self.find(depth);
        }
        core::mem::swap(&mut self.first, &mut self.other);
    }

    /// Sets the other level to that of a depth, and mixes its colour.
    #[inline(never)] // its loops would take the registers of the loops over pixels
    fn find(&mut self, depth: u32) {
        let level = self.other.level.at(depth, self.bounds);
        self.other = Known { level, pair: pair((self.color)(level.level())) };
    }

    /// Fills a row in any levels; with `DEPTH`, where pixels are nearer than the depth buffer.
    #[inline(never)] // its loop needs all registers
    fn row<const DEPTH: bool>(
        &mut self,
        mut cells: &mut [Cell],
        mut depths: &mut [u16],
        mut depth: u32,
        step: u32,
    ) {
        let mut known = self.begin(depth);
        while let Some(beyond) = (cells.len() as u32).checked_sub(1) {
            let width = known.level.further(depth, step, beyond).wrapping_add(1);
            let Some((run, rest)) = cells.split_at_mut_checked(width as usize) else { return };
            if DEPTH {
                let Some((stored, further)) = depths.split_at_mut_checked(width as usize) else { return };
                fill_equal_nearer(run, stored, depth, step, Equal(known.pair));
                depths = further;
            } else {
                fill_pairs(run, known.pair, true);
            }
            (cells, depth) = (rest, depth.wrapping_add(step.wrapping_mul(width)));
            if !cells.is_empty() {
                known = self.next(depth);
            }
        }
    }

    /// The cell of each pixel of a row, for fewer than [`BLOCK`] pixels: without a division.
    #[inline(always)]
    fn cells(&mut self, mut depth: u32, step: u32) -> impl Iterator<Item = Stored<Cell>> {
        let mut known = self.begin(depth);
        core::iter::repeat_with(move || {
            if !known.level.has(depth) {
                known = self.next(depth);
            }
            let [cell, _] = known.pair;
            depth = depth.wrapping_add(step);
            Stored(cell)
        })
    }

    /// [`row`](Self::row) of fewer than [`BLOCK`] pixels without a depth buffer.
    #[inline(never)] // its loop needs all registers
    fn short_row(&mut self, cells: &mut [Cell], depth: u32, step: u32) {
        put_each::<Cell, true>(cells, self.cells(depth, step));
    }
}

impl<Cell: Copy, F: Fn(u8) -> Cell> FillRun<Cell> for Levels<'_, Cell, F> {
    #[inline(always)]
    fn fill(&mut self, run: &mut [Cell], depths: &mut [u16], first: u32, step: u32) {
        let width = run.len();
        if width < BLOCK {
            if width > 0 {
                put_each_nearer::<Cell, true>(run, depths, first, step, &mut self.cells(first, step));
            }
        } else if self.has(first, step, width) {
            fill_long_nearer(run, depths, first, step, Equal(self.first.pair));
        } else {
            self.row::<true>(run, depths, first, step);
        }
    }
}
