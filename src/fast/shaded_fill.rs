//! Triangles with an ink per pixel, computed by a shader, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill` and `fill_nearer`, which pass each span to `Target::fill_run`, with depth each run
//!   of nearer pixels; for inks that leave out pixels or are mixed with the stored ones, `fill_kept` and `fill_kept_nearer`.
//! - **Domain**: every triangle and shader, on a target whose pixels lie in memory.
//! - **Gain**: the shader's colours are stored in one loop with the edge walker, run by run (`SpanShader::runs`), so that a
//!   shader computes what a run has in common once. With depth, the shader is called once per row, not once per run of visible
//!   pixels. Texels are stored eight in a turn, with depth where the depth buffer is still clear: 7.4 instructions for a texel
//!   in place of 11 on an M3. The ink of a pixel is computed once; for targets without memory a span that may leave out pixels is
//!   computed twice, for the runs and for their colours. One mixed colour takes eight pixels a turn: 4.6 instructions a pixel in
//!   place of 6.4 for S5 half on an M3, 8.6 in place of 10.7 for S5 alpha.
//! - **Test**: `everywhere` and `by_every_call` in `tests/support/src/bridge/ways.rs`, and `tests/raster/memory_triangles.rs`.

use super::depth_fill::{is_clear, put_nearer, BLOCK};
use super::{depth_gradient, memory_of, packed_fill, Low, RowOrigin, Rows};
use crate::color::{Ink, StoredPixel};
use crate::math::hints::{keep_rolled, opaque};
use crate::math::unrolled::each8;
use crate::raster::{AnyTriangle, DepthTriangle, Gradient, PixelLayout, Scissor, Span, Trapezoid, Triangle};
use crate::shading::{DrawRuns, Line, SpanShader};
use crate::surface::{put, CellOf, DepthBuffer, DepthTarget, PixelRows, PixelStore, Target};

/// Fills a triangle with the inks of a shader that is set up for it, if the target's pixels lie in memory; otherwise draws
/// nothing and returns `false`.
#[inline(always)]
pub(crate) fn triangle<T: Target, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    setup: &S::Setup,
    scissor: &Scissor,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    S::draw_runs(setup, Fill::<T> { memory, triangle, scissor });
    true
}

/// [`triangle`] for one ink that is mixed with the stored pixels. Each turn of the loop mixes eight pixels.
#[inline(always)]
pub(crate) fn triangle_of_one_ink<T: Target, I: Ink<T::Color>>(
    triangle: &Triangle<'_>,
    ink: I,
    scissor: &Scissor,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill(memory, triangle, scissor, &mut |cells, _| {
        let mixed = ink; // a copy, in registers
        let (blocks, rest) = cells.as_chunks_mut::<BLOCK>();
        for pixels in blocks {
            each8(pixels, |pixel| {
                put::<T, I>(pixel, mixed);
            });
            keep_rolled();
        }
        for pixel in rest {
            put::<T, I>(pixel, mixed);
            keep_rolled();
        }
    });
    true
}

/// A triangle and the memory that it is filled into.
struct Fill<'a, 't, T: Target> {
    memory: &'a mut PixelRows<T::Store>,
    triangle: &'a Triangle<'t>,
    scissor: &'a Scissor,
}

impl<T: Target, I: Ink<T::Color>> DrawRuns<I> for Fill<'_, '_, T> {
    #[inline(always)]
    fn runs<R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = I>>(self, runs: impl Fn(Span) -> R) {
        let Self { memory, triangle, scissor } = self;
        fill(memory, triangle, scissor, &mut |cells, span| {
            each_run(cells, runs(span), |pixels, run| {
                pixels.iter_mut().zip(run).for_each(|(pixel, ink)| {
                    put::<T, I>(pixel, ink);
                });
            });
        });
    }

    #[inline(always)]
    fn lines<L: Line, R: Iterator<Item = (i32, L)>>(
        self,
        lines: impl Fn(Span) -> R,
        texel: impl Fn([u32; 2]) -> I + Copy,
    ) {
        let Some(texel) = I::opaque(texel) else {
            return self.runs(|span| lines(span).map(|(width, line)| (width, line.map(texel))));
        };
        let Self { memory, triangle, scissor } = self;
        fill(memory, triangle, scissor, &mut |cells, span| {
            let of = texel; // a copy, in a register
            each_run(cells, lines(span), |pixels, line| put_line(pixels, line, of));
        });
    }

    #[inline(always)]
    fn packed(&mut self, gradient: &Gradient, texel: impl Fn(u32) -> I + Copy) -> bool {
        I::opaque(texel).is_some_and(|texel| {
            packed_fill::fill_small(self.memory, self.triangle, self.scissor, gradient, texel)
        })
    }
}

/// Calls `put` with the pixels of each run.
#[inline(always)]
fn each_run<Cell, Q>(
    mut cells: &mut [Cell],
    runs: impl Iterator<Item = (i32, Q)>,
    put: impl Fn(&mut [Cell], Q),
) {
    for (width, run) in runs {
        let Some((pixels, rest)) = cells.split_at_mut_checked(width as usize) else { return };
        put(pixels, run);
        cells = rest;
    }
}

/// Stores the texels of a run.
#[inline(always)]
fn put_line<Cell, C: StoredPixel<Cell>>(
    pixels: &mut [Cell],
    mut line: impl Line,
    texel: impl Fn([u32; 2]) -> C,
) {
    let zero = opaque(0);
    let (blocks, rest) = pixels.as_chunks_mut::<BLOCK>();
    for pixels in blocks {
        each8(pixels, |pixel| *pixel = texel(line.advance()).stored());
        line = line.hidden(zero); // LLVM would keep multiples of the steps on the stack
        keep_rolled();
    }
    for pixel in rest {
        *pixel = texel(line.advance()).stored();
        keep_rolled();
    }
}

/// Calls `row` with the cells and the span of each row.
///
/// `row` has loops that need all registers, so it is a function of its own anyway: by `dyn`, this function is there once for all shaders,
/// with and without depth.
#[inline(never)] // its loop needs all registers
pub(super) fn fill<S: PixelStore>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    row: &mut dyn FnMut(&mut [S::Cell], Span),
) {
    let Some(low) = Low::new(triangle, scissor, memory.scratch()) else {
        // In close-ups, most triangles that `Low` declines lie beside the picture.
        if triangle.is_beside(scissor) {
            return;
        }
        let (cells, scratch) = memory.parts();
        return fill_any(cells, scratch.layout, triangle, scissor, row);
    };
    let (cells, scratch) = memory.parts();
    let RowOrigin { x, mut y, shear } = low.start(scratch.layout);
    let shear = shear as i32;
    let mut x = x.wrapping_sub(shear.wrapping_mul(y));
    low.each(scratch, |start, left, right| {
        let (from, width) = (start.wrapping_add(left as usize), right.wrapping_sub(left));
        if width > 0
            && let Some(cells) = cells.get_mut(from..from.wrapping_add(width as usize))
        {
            row(cells, Span { x: x.wrapping_add(left), y, width, height: 1 });
        }
        (x, y) = (x.wrapping_sub(shear), y + 1);
    });
}

/// The slow path of [`fill`], for triangles outside the domain of [`Low`].
#[inline(never)] // its loop needs all registers
fn fill_any<Cell>(
    cells: &mut [Cell],
    layout: PixelLayout,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    row: &mut dyn FnMut(&mut [Cell], Span),
) {
    let (mut triangle, mut trapezoid) = (AnyTriangle::new(triangle, scissor), Trapezoid::without_rows());
    while triangle.trapezoid(&mut trapezoid) {
        let (x, mut y) = (trapezoid.x, trapezoid.y);
        trapezoid.each(layout.at(x, y), layout.stride, |start, left, right| {
            let (from, width) = (start.wrapping_add(left as usize), right.wrapping_sub(left));
            if width > 0
                && let Some(cells) = cells.get_mut(from..from.wrapping_add(width as usize))
            {
                row(cells, Span { x: x.wrapping_add(left), y, width, height: 1 });
            }
            y += 1;
        });
    }
}

/// [`triangle`] for the pixels that are nearer than the depth buffer, whose rows may lie otherwise than those of the memory.
#[inline(always)]
pub(crate) fn triangle_nearer<T: Target, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    setup: &S::Setup,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    match S::WRITES_DEPTH {
        true => S::draw_runs(setup, FillNearer::<T, true> { memory, depth, triangle, scissor }),
        false => S::draw_runs(setup, FillNearer::<T, false> { memory, depth, triangle, scissor }),
    }
    true
}

/// A triangle, and the memory and depth buffer that it is filled into. `WRITES`: whether depths are stored.
struct FillNearer<'a, 't, 'd, 'b, T: Target, const WRITES: bool> {
    memory: &'a mut PixelRows<T::Store>,
    depth: &'a mut DepthTarget<'d, 'b>,
    triangle: &'a DepthTriangle<'t>,
    scissor: &'a Scissor,
}

impl<T: Target, I: Ink<T::Color>, const WRITES: bool> DrawRuns<I> for FillNearer<'_, '_, '_, '_, T, WRITES> {
    #[inline(always)]
    fn runs<R: Iterator<Item = (i32, Q)>, Q: Iterator<Item = I>>(self, runs: impl Fn(Span) -> R) {
        let Self { memory, depth, triangle, scissor } = self;
        let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
        fill(memory, &triangle.triangle, scissor, &mut |cells, span| {
            let put_run = |pixels: &mut [CellOf<T>], depths: &mut [u16], mut z: u32, run: Q| {
                for ((pixel, stored), ink) in pixels.iter_mut().zip(depths).zip(run) {
                    if z >> 16 < u32::from(*stored) && put::<T, I>(pixel, ink) && WRITES {
                        *stored = (z >> 16) as u16;
                    }
                    z = z.wrapping_add(gradient.step());
                    keep_rolled();
                }
                z
            };
            each_run_nearer(cells, depth.buffer, span, &gradient, runs(span), put_run);
        });
    }

    #[inline(always)]
    fn lines<L: Line, R: Iterator<Item = (i32, L)>>(
        self,
        lines: impl Fn(Span) -> R,
        texel: impl Fn([u32; 2]) -> I + Copy,
    ) {
        let Some(texel) = I::opaque(texel).filter(|_| WRITES) else {
            return self.runs(|span| lines(span).map(|(width, line)| (width, line.map(texel))));
        };
        let Self { memory, depth, triangle, scissor } = self;
        let gradient = depth_gradient(&triangle.triangle, &triangle.depths);
        fill(memory, &triangle.triangle, scissor, &mut |cells, span| {
            let of = texel; // a copy, in a register
            each_run_nearer(cells, depth.buffer, span, &gradient, lines(span), |pixels, depths, z, line| {
                put_line_nearer(pixels, depths, z, gradient.step(), line, of)
            });
        });
    }

    #[inline(always)]
    fn packed(&mut self, gradient: &Gradient, texel: impl Fn(u32) -> I + Copy) -> bool {
        let Self { memory, depth, triangle, scissor } = self;
        let depths = depth.buffer.values_mut();
        depth.is_aligned
            && WRITES
            && I::opaque(texel).is_some_and(|texel| {
                packed_fill::fill_small_nearer(memory, depths, triangle, scissor, gradient, texel)
            })
    }
}

/// Calls `put` with the pixels and depths of each run, and depth at its first pixel; it returns depth after the last one.
#[inline(always)]
fn each_run_nearer<Cell, Q>(
    mut cells: &mut [Cell],
    depth: &mut DepthBuffer<'_>,
    span: Span,
    gradient: &Gradient,
    runs: impl Iterator<Item = (i32, Q)>,
    put: impl Fn(&mut [Cell], &mut [u16], u32, Q) -> u32,
) {
    let Some(mut depths) = depth.row(span.x, span.y, span.width) else { return };
    let mut z = gradient.at(span.x, span.y);
    for (width, run) in runs {
        let (Some((pixels, more)), Some((stored, further))) =
            (cells.split_at_mut_checked(width as usize), depths.split_at_mut_checked(width as usize))
        else {
            return;
        };
        z = put(pixels, stored, z, run);
        (cells, depths) = (more, further);
    }
}

/// Stores the texels of a run where its pixels are nearer than the depth buffer; returns the depth after the last one.
#[inline(always)]
fn put_line_nearer<Cell: Copy, C: StoredPixel<Cell>>(
    pixels: &mut [Cell],
    depths: &mut [u16],
    mut z: u32,
    step: u32,
    mut line: impl Line,
    texel: impl Fn([u32; 2]) -> C,
) -> u32 {
    // The lengths are equal already; this tells the compiler.
    let Some(depths) = depths.get_mut(..pixels.len()) else { return z };
    let zero = opaque(0);
    let ((blocks, rest), (depth_blocks, depth_rest)) =
        (pixels.as_chunks_mut::<BLOCK>(), depths.as_chunks_mut::<BLOCK>());
    for (pixels, depths) in blocks.iter_mut().zip(depth_blocks) {
        if is_clear(depths) {
            each8(depths, |stored| {
                *stored = (z >> 16) as u16;
                z = z.wrapping_add(step);
            });
            each8(pixels, |pixel| *pixel = texel(line.advance()).stored());
        } else {
            // Lengths that the compiler does not know keep it from unrolling the loop.
            for (pixel, stored) in opaque(pixels.as_mut_slice()).iter_mut().zip(opaque(depths.as_mut_slice()))
            {
                put_nearer(pixel, stored, z, texel(line.advance()).stored());
                z = z.wrapping_add(step);
                keep_rolled();
            }
        }
        line = line.hidden(zero);
        keep_rolled();
    }
    for (pixel, stored) in opaque(rest).iter_mut().zip(opaque(depth_rest)) {
        put_nearer(pixel, stored, z, texel(line.advance()).stored());
        z = z.wrapping_add(step);
        keep_rolled();
    }
    z
}
