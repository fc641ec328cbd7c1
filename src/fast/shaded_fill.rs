//! Triangles with a colour per pixel, computed by a shader, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill` and `fill_nearer`, which pass each span to `Target::fill_run`, with depth each run
//!   of nearer pixels.
//! - **Domain**: every triangle and shader, on a target whose pixels lie in memory; with depth, only where the depth buffer is
//!   laid out as the memory is.
//! - **Gain**: the shader's colours are stored in one loop with the edge walker, run by run (`SpanShader::runs`), so that a
//!   shader computes what a run has in common once. With depth, the shader is called once per row,
//!   not once per run of visible pixels. Not measured alone.
//! - **Test**: `memory_gets_the_pixels_and_depths_of_the_plain_path` in `pipeline/fill.rs`, and `tests/raster/twins.rs`.

use super::depth_fill::put_nearer;
use super::{depth_gradient, each_span, memory_of};
use crate::math::hints::keep_rolled;
use crate::raster::{DepthTriangle, Scissor, Span, Triangle};
use crate::surface::{DepthTarget, PixelRows, PixelStore, StoredPixel, Target};

/// Fills a triangle with the colours that `span_colors` gives for each span, if the target's pixels lie in memory; otherwise
/// draws nothing and returns `false`.
#[inline(always)]
pub(crate) fn triangle<T: Target, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = T::Color>>(
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    target: &mut T,
    runs: impl Fn(Span) -> R,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill(memory, triangle, scissor, |span| {
        runs(span).map(|(width, run)| (width, run.map(StoredPixel::stored)))
    });
    true
}

#[inline(never)] // its loop needs all registers
fn fill<S: PixelStore, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    runs: impl Fn(Span) -> R,
) {
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    each_span(triangle, scissor, |span| {
        let from = layout.at(span.x, span.y);
        if let Some(mut cells) = cells.get_mut(from..from.wrapping_add(span.width as usize)) {
            for (width, run) in runs(span) {
                let Some((pixels, rest)) = cells.split_at_mut_checked(width as usize) else { return };
                pixels.iter_mut().zip(run).for_each(|(pixel, cell)| *pixel = cell);
                cells = rest;
            }
        }
    });
}

/// [`triangle`] for the pixels that are nearer than the depth buffer; declines too if the depth buffer does not
/// [have the layout of the memory](DepthTarget::is_aligned).
#[inline(always)]
pub(crate) fn triangle_nearer<T: Target, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = T::Color>>(
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    runs: impl Fn(Span) -> R,
) -> bool {
    let Some(memory) = memory_of(target).filter(|_| depth.is_aligned) else { return false };
    let depths = depth.buffer.values_mut();
    fill_nearer(memory, triangle, scissor, depths, |span| {
        runs(span).map(|(width, run)| (width, run.map(StoredPixel::stored)))
    });
    true
}

#[inline(never)] // its loop needs all registers
fn fill_nearer<S: PixelStore, R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = S::Cell>>(
    memory: &mut PixelRows<S>,
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depths: &mut [u16],
    runs: impl Fn(Span) -> R,
) {
    let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
    let step = gradient.step();
    let (cells, scratch) = memory.parts();
    let layout = scratch.layout;
    each_span(&triangle.triangle, scissor, |span| {
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
                    put_nearer(pixel, stored, z, cell);
                    z = z.wrapping_add(step);
                    keep_rolled();
                }
                (cells, depths) = (more, further);
            }
        }
    });
}
