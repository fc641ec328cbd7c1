//! Triangles with an ink per pixel, computed by a shader, into memory.
//!
//! - **Plain twins**: `pipeline::fill::fill` and `fill_nearer`, which pass each span to `Surface::fill_run`, with depth each run
//!   of nearer pixels; for inks that leave out pixels or are mixed with stored pixels, `shade_spans` and
//!   `shade_spans_nearer` pass the runs of the pixels that are drawn.
//! - **Domain**: every triangle and shader, on a target whose pixels lie in memory.
//! - **Gain**: the shader's colours are stored in one loop with the edge walker, run by run (`FastPath::runs`), so that a
//!   shader computes what a run has in common once. With depth, the shader is called once per row, not once per run of visible
//!   pixels. The ink of a pixel is computed once; for targets without memory a span that may leave out pixels is computed twice, for
//!   the runs and for their colours.
//! - **Test**: `everywhere` and `by_every_call` in `tests/support/src/bridge/ways.rs`, and `tests/raster/memory_triangles.rs`.

use super::fill_rows::{fill_low, fill_only_small, same_length, Fill, FillRow, FillRows, NoDepth};
use super::put_run::{put_blocks, put_blocks_nearer, put_each, put_each_nearer, Inked, LookUp, OneInk};
use super::ramp_fill::Packed;
use super::{depth_gradient, memory_of, RowOrigin};
use crate::color::InkKind;
use crate::math::hints::opaque;
use crate::raster::{DepthTriangle, Gradient, Scissor, Span, Triangle};
use crate::shading::{FastPath, Line, SpanShader};
use crate::surface::{DepthBuffer, DepthTarget, PixelRows, PixelStore, Surface};

/// Fills a triangle with the inks of a shader, if the target's pixels lie in memory; otherwise draws
/// nothing and returns `false`.
#[inline(always)]
pub(crate) fn triangle<T: Surface, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let setup = shader.set_up(triangle);
    let Some(color) = S::FastPath::look_up(&setup).and_then(InkKind::opaque) else {
        fill(memory, triangle, scissor, &mut |cells, span| {
            each_run(cells, S::FastPath::runs(&setup, span), |pixels, run| {
                put_each::<_, false>(pixels, run.map(Inked::<T::Color, S::Ink>::new));
            });
        });
        return true;
    };
    if let Some(gradient) = S::FastPath::ramp(&setup)
        && fill_only_small(memory, triangle, scissor, &mut [], Packed { gradient, color })
    {
        return true;
    }
    if S::FastPath::BY_RUN {
        fill(memory, triangle, scissor, &mut |cells, span| {
            each_run(cells, S::FastPath::lines(&setup, span), |pixels, [at @ [_, second], step]| {
                if let Some(color) = S::FastPath::look_up_in_run(&setup, second).and_then(InkKind::opaque) {
                    let (line, zero) = (Line { at, step }, opaque(0));
                    put_blocks(pixels, LookUp::<_, _, false> { line, color, zero });
                }
            });
        });
        return true;
    }
    fill(memory, triangle, scissor, &mut |cells, span| {
        let texel = color; // a copy, in a register
        each_run(cells, S::FastPath::lines(&setup, span), |pixels, [at, step]| {
            put_blocks(
                pixels,
                LookUp::<_, _, false> { line: Line { at, step }, color: texel, zero: opaque(0) },
            );
        });
    });
    true
}

/// [`triangle`] for one ink that is mixed with the stored pixels.
#[inline(always)]
pub(crate) fn triangle_of_one_ink<T: Surface, I: InkKind<T::Color>>(
    triangle: &Triangle<'_>,
    ink: I,
    scissor: &Scissor,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    fill(memory, triangle, scissor, &mut |cells, _| {
        put_blocks(cells, OneInk(Inked::<T::Color, I>::new(ink)));
    });
    true
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

/// Calls `row` with the cells and the span of each row.
///
/// `row` has loops that need all registers, so it is a function of its own anyway: by `dyn`, the loop over rows is there once for all
/// shaders, with and without depth.
#[inline(always)]
pub(super) fn fill<S: PixelStore>(
    memory: &mut PixelRows<S>,
    triangle: &Triangle<'_>,
    scissor: &Scissor,
    row: &mut dyn FnMut(&mut [S::Cell], Span),
) {
    fill_low(memory, triangle, scissor, NoDepth, EachRow(row));
}

/// A function that fills a row.
struct EachRow<'f, Cell>(&'f mut dyn FnMut(&mut [Cell], Span));

impl<Cell> Fill<Triangle<'_>, Cell> for EachRow<'_, Cell> {
    const IS_FREE: bool = true;

    #[inline(always)]
    fn set_up(self, _: &Triangle<'_>) -> impl FillRows<Cell> {
        self
    }
}

impl<Cell> FillRows<Cell> for EachRow<'_, Cell> {
    #[inline(always)]
    fn rows<'a>(
        &'a mut self,
        cells: &'a mut [Cell],
        _: &'a mut [u16],
        RowOrigin { x, y, shear }: RowOrigin,
        _: i32,
    ) -> impl FillRow
    where
        Cell: 'a,
    {
        let shear = shear as i32;
        SpanRows { fill: &mut *self.0, cells, x: x.wrapping_sub(shear.wrapping_mul(y)), y, shear }
    }
}

/// Rows that a function fills.
struct SpanRows<'a, 'f, Cell> {
    fill: &'a mut (dyn FnMut(&mut [Cell], Span) + 'f),
    cells: &'a mut [Cell],
    /// The column that the next row's ends are counted from.
    x: i32,
    y: i32,
    shear: i32,
}

impl<Cell> FillRow for SpanRows<'_, '_, Cell> {
    #[inline(always)]
    fn row(&mut self, start: usize, left: i32, right: i32) {
        let (from, width) = (start.wrapping_add(left as usize), right.wrapping_sub(left));
        if width > 0
            && let Some(cells) = self.cells.get_mut(from..from.wrapping_add(width as usize))
        {
            (self.fill)(cells, Span { x: self.x.wrapping_add(left), y: self.y, width, height: 1 });
        }
        (self.x, self.y) = (self.x.wrapping_sub(self.shear), self.y + 1);
    }
}

/// [`triangle`] for the pixels that are nearer than the depth buffer, whose rows may lie otherwise than those of the memory.
#[inline(always)]
pub(crate) fn triangle_nearer<T: Surface, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let DepthTriangle { triangle: corners, depths, .. } = triangle;
    let setup = shader.set_up(corners);
    let Some(color) = S::FastPath::look_up(&setup).and_then(InkKind::opaque).filter(|_| S::WRITES_DEPTH)
    else {
        let gradient = depth_gradient(corners, depths);
        fill(memory, corners, scissor, &mut |cells, span| {
            let runs = S::FastPath::runs(&setup, span);
            each_run_nearer(cells, depth.buffer, span, &gradient, runs, |pixels, depths, z, step, run| {
                let mut inks = run.map(Inked::<T::Color, S::Ink>::new);
                match S::WRITES_DEPTH {
                    true => put_each_nearer::<_, true>(pixels, depths, z, step, &mut inks),
                    false => put_each_nearer::<_, false>(pixels, depths, z, step, &mut inks),
                }
            });
        });
        return true;
    };
    if depth.is_aligned
        && let Some(gradient) = S::FastPath::ramp(&setup)
        && fill_only_small(memory, triangle, scissor, depth.buffer.values_mut(), Packed { gradient, color })
    {
        return true;
    }
    let gradient = depth_gradient(corners, depths);
    if S::FastPath::BY_RUN {
        fill(memory, corners, scissor, &mut |cells, span| {
            let (lines, zero) = (S::FastPath::lines(&setup, span), opaque(0));
            each_run_nearer(cells, depth.buffer, span, &gradient, lines, |pixels, depths, z, step, run| {
                let [at @ [_, second], by] = run;
                let Some(color) = S::FastPath::look_up_in_run(&setup, second).and_then(InkKind::opaque)
                else {
                    return z;
                };
                let line = Line { at, step: by };
                put_blocks_nearer(pixels, depths, z, step, LookUp::<_, _, false> { line, color, zero })
            });
        });
        return true;
    }
    fill(memory, corners, scissor, &mut |cells, span| {
        let (lines, zero) = (S::FastPath::lines(&setup, span), opaque(0));
        each_run_nearer(cells, depth.buffer, span, &gradient, lines, |pixels, depths, z, step, [at, by]| {
            let line = Line { at, step: by };
            put_blocks_nearer(pixels, depths, z, step, LookUp::<_, _, false> { line, color, zero })
        });
    });
    true
}

/// Calls `put` with the pixels and depths of each run, depth at its first pixel, and its step; it returns depth after the last one.
#[inline(always)]
fn each_run_nearer<Cell, Q>(
    cells: &mut [Cell],
    depth: &mut DepthBuffer<'_>,
    span: Span,
    gradient: &Gradient,
    runs: impl Iterator<Item = (i32, Q)>,
    put: impl Fn(&mut [Cell], &mut [u16], u32, u32, Q) -> u32,
) {
    let Some(depths) = depth.row(span.x, span.y, span.width) else { return };
    let (mut cells, mut depths) = same_length(cells, depths);
    let mut z = gradient.at(span.x, span.y);
    for (width, run) in runs {
        let (Some((pixels, more)), Some((stored, further))) =
            (cells.split_at_mut_checked(width as usize), depths.split_at_mut_checked(width as usize))
        else {
            return;
        };
        z = put(pixels, stored, z, gradient.step(), run);
        (cells, depths) = (more, further);
    }
}
