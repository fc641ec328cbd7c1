//! Triangles of which a shader leaves out pixels, or which it mixes with the stored pixels, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill_kept` and `fill_kept_nearer`, which pass each run of kept pixels to
//!   `Target::fill_run`.
//! - **Domain**: every triangle and shader, on a target whose pixels lie in memory.
//! - **Gain**: a pixel's colour is computed once; for targets without memory a span is computed twice, for the runs and for their
//!   colours. One blended colour is mixed eight pixels at a time: 4.6 instructions a pixel in place of 6.4 for S5 half on an M3,
//!   8.6 in place of 10.7 for S5 alpha. Rows are walked by the loops of [`shaded_fill`](super::shaded_fill).
//! - **Test**: `everywhere` in `tests/support/src/bridge/ways.rs`.

use super::depth_fill::BLOCK;
use super::shaded_fill::{each_run, each_run_nearer, fill};
use super::{depth_gradient, memory_of};
use crate::color::StoredPixel;
use crate::math::hints::keep_rolled;
use crate::math::unrolled::each8;
use crate::raster::{DepthTriangle, Scissor, Span, Triangle};
use crate::surface::{DepthTarget, PixelStore, Target};

type CellOf<T> = <<T as Target>::Store as PixelStore>::Cell;

/// Sets each pixel of a triangle for which `runs` gives a colour to what `merge` makes of the colour's cell and the stored one, if
/// the target's pixels lie in memory; otherwise draws nothing and returns `false`.
#[inline(always)]
pub(crate) fn triangle<T: Target, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = Option<T::Color>>>(
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    target: &mut T,
    runs: impl Fn(Span) -> R,
    merge: impl Fn(CellOf<T>, CellOf<T>) -> CellOf<T> + Copy,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill(memory, triangle, scissor, &mut |cells, span| {
        let mixed = merge; // a copy, in registers
        each_run(cells, runs(span), |pixels, run| {
            for (pixel, color) in pixels.iter_mut().zip(run) {
                if let Some(color) = color {
                    *pixel = mixed(color.stored(), *pixel);
                }
            }
        });
    });
    true
}

/// [`triangle`] for one colour that leaves out no pixel: `merge` returns the cell to store from the stored one. Each turn of the
/// loop mixes eight pixels.
#[inline(always)]
pub(crate) fn solid_triangle<T: Target>(
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    target: &mut T,
    merge: impl Fn(CellOf<T>) -> CellOf<T> + Copy,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill(memory, triangle, scissor, &mut |cells, _| {
        let mixed = merge; // a copy, in registers
        let (blocks, rest) = cells.as_chunks_mut::<BLOCK>();
        for pixels in blocks {
            each8(pixels, |pixel| *pixel = mixed(*pixel));
            keep_rolled();
        }
        for pixel in rest {
            *pixel = mixed(*pixel);
            keep_rolled();
        }
    });
    true
}

/// [`triangle`] for the pixels that are nearer than the depth buffer, whose depths are stored if `WRITES`.
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
    merge: impl Fn(CellOf<T>, CellOf<T>) -> CellOf<T> + Copy,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
    fill(memory, &triangle.triangle, scissor, &mut |cells, span| {
        let mixed = merge; // a copy, in registers
        each_run_nearer(cells, depth.buffer, span, &gradient, runs(span), |pixels, depths, mut z, run| {
            for ((pixel, stored), color) in pixels.iter_mut().zip(depths).zip(run) {
                if let Some(color) = color
                    && z >> 16 < u32::from(*stored)
                {
                    *pixel = mixed(color.stored(), *pixel);
                    if WRITES {
                        *stored = (z >> 16) as u16;
                    }
                }
                z = z.wrapping_add(gradient.step());
                keep_rolled();
            }
            z
        });
    });
    true
}
