//! Triangles of which a shader leaves out pixels, or which it mixes with the stored pixels, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill_kept` and `fill_kept_nearer`, which pass each run of kept pixels to
//!   `Target::fill_run`.
//! - **Domain**: every triangle and shader, on a target whose pixels lie in memory; with depth, only where the depth buffer is
//!   laid out as the memory is.
//! - **Gain**: a pixel's colour is computed once; a span of another target asks twice, for the runs and for their colours. Not
//!   measured alone.
//! - **Test**: `memory_gets_the_pixels_and_depths_of_the_plain_path` in `pipeline/fill.rs`.

use super::{depth_gradient, memory_of, spans};
use crate::math::hints::keep_rolled;
use crate::raster::{DepthTriangle, Scissor, Span, Triangle};
use crate::surface::{DepthTarget, PixelRows, PixelStore, StoredPixel, Target};

type CellOf<T> = <<T as Target>::Store as PixelStore>::Cell;

/// Sets the pixels of a triangle for which `runs` gives colours to what `merge` makes of the colour's cell and the stored one, if the target's pixels lie in memory; otherwise draws nothing
/// and returns `false`.
#[inline(always)]
pub(crate) fn triangle<T: Target, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = Option<T::Color>>>(
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    target: &mut T,
    runs: impl Fn(Span) -> R,
    merge: impl Fn(CellOf<T>, CellOf<T>) -> CellOf<T>,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let runs = |span| runs(span).map(|(width, run)| (width, run.map(|color| color.map(StoredPixel::stored))));
    fill(memory, triangle, scissor, runs, merge);
    true
}

#[inline(never)] // its loop needs all registers
fn fill<S: PixelStore, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = Option<S::Cell>>>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    runs: impl Fn(Span) -> R,
    merge: impl Fn(S::Cell, S::Cell) -> S::Cell,
) {
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    spans(triangle, scissor).for_each(|span| {
        let from = layout.at(span.x, span.y);
        if let Some(mut cells) = cells.get_mut(from..from.wrapping_add(span.width as usize)) {
            for (width, run) in runs(span) {
                let Some((pixels, rest)) = cells.split_at_mut_checked(width as usize) else { return };
                for (pixel, cell) in pixels.iter_mut().zip(run) {
                    if let Some(cell) = cell {
                        *pixel = merge(cell, *pixel);
                    }
                }
                cells = rest;
            }
        }
    });
}

/// [`triangle`] for the pixels that are nearer than the depth buffer, whose depths are stored if `WRITES`; declines too if the
/// depth buffer does not [have the layout of the memory](DepthTarget::is_aligned).
#[inline(always)]
pub(crate) fn triangle_nearer<
    const WRITES: bool,
    T: Target,
    R: Iterator<Item = (i32, Q)>,
    Q: Iterator<Item = Option<T::Color>>,
>(
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    runs: impl Fn(Span) -> R,
    merge: impl Fn(CellOf<T>, CellOf<T>) -> CellOf<T>,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    let depths = depth.buffer.values_mut();
    let runs = |span| runs(span).map(|(width, run)| (width, run.map(|color| color.map(StoredPixel::stored))));
    fill_nearer::<WRITES, _, _, _>(memory, triangle, scissor, depths, runs, merge);
    true
}

#[inline(never)] // its loop needs all registers
fn fill_nearer<
    const WRITES: bool,
    S: PixelStore,
    R: Iterator<Item = (i32, Q)>,
    Q: Iterator<Item = Option<S::Cell>>,
>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depths: &mut [u16],
    runs: impl Fn(Span) -> R,
    merge: impl Fn(S::Cell, S::Cell) -> S::Cell,
) {
    let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
    let step = gradient.step();
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    spans(&triangle.triangle, scissor).for_each(|span| {
        let from = layout.at(span.x, span.y);
        let to = from.wrapping_add(span.width as usize);
        if let (Some(mut cells), Some(mut depths)) = (cells.get_mut(from..to), depths.get_mut(from..to)) {
            let mut z = gradient.at(span.x, span.y);
            for (width, run) in runs(span) {
                let (Some((pixels, more)), Some((stored, further))) =
                    (cells.split_at_mut_checked(width as usize), depths.split_at_mut_checked(width as usize))
                else {
                    return;
                };
                for ((pixel, stored), cell) in pixels.iter_mut().zip(stored).zip(run) {
                    if let Some(cell) = cell
                        && z >> 16 < u32::from(*stored)
                    {
                        *pixel = merge(cell, *pixel);
                        if WRITES {
                            *stored = (z >> 16) as u16;
                        }
                    }
                    z = z.wrapping_add(step);
                    keep_rolled();
                }
                (cells, depths) = (more, further);
            }
        }
    });
}
