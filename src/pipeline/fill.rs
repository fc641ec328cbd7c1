//! The last step of the pipeline: a triangle or a line, clipped to the screen, becomes pixels.
//!
//! The plain path is the loop over spans at the end of each function; it draws into any target and defines the picture. The
//! call before that loop attaches a fast path, which may decline. All fast paths decline with `--cfg pinhole_plain`, and for
//! targets whose pixels do not lie in memory.

use super::drawable::ShaderFor;
use crate::color::Ink;
use crate::fast::{self, depth_fill, fog_fill, line_fill, line_pixels, shaded_fill, solid_fill, table_fill};
use crate::raster::{self, DepthTriangle, Gradient, Pixel, Scissor, Span, Triangle};
use crate::shading::SpanShader;
use crate::surface::{drawable, each_run, put, DepthTarget, Target};
use embedded_graphics_core::pixelcolor::PixelColor;

/// Fills the pixels of a triangle inside the scissor, which lies in the target. `is_clipped`: whether the triangle probably has
/// rows outside the scissor, as most triangles in a band have; it changes no pixel, only which path is tried.
#[inline(always)]
pub(super) fn fill<T: Target, S: ShaderFor<T>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> Result<(), T::Error> {
    if !is_opaque::<T, S>() {
        return fill_kept(triangle, shader, scissor, target);
    }
    if let Some(color) = shader.solid().and_then(Ink::own) {
        if solid_fill::triangle(triangle, color, scissor, is_clipped, target) {
            return Ok(());
        }
        return fill_spans(triangle, color, scissor, target);
    }
    if fog_fill::triangle(triangle, shader, scissor, target) {
        return Ok(());
    }
    let setup = shader.set_up(triangle);
    if shaded_fill::triangle::<T, S>(triangle, &setup, scissor, target) {
        return Ok(());
    }
    fast::spans(triangle, scissor).try_for_each(|span| target.fill_run(span, colors::<T, S>(&setup, span)))
}

/// The plain path of [`fill`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans<T: Target>(
    triangle: &Triangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    fast::spans(triangle, scissor).try_each(|Span { x, y, width, .. }| fill_row(target, x, y, width, color))
}

/// Fills the pixels of a triangle inside the scissor that are nearer than the depth buffer. The scissor lies in the target and
/// in the depth buffer. `is_clipped` is that of [`fill`].
#[inline(always)]
pub(super) fn fill_nearer<T: Target, S: ShaderFor<T>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    if !is_opaque::<T, S>() || !S::WRITES_DEPTH {
        return fill_kept_nearer(triangle, shader, scissor, depth, target);
    }
    if let Some(color) = shader.solid().and_then(Ink::own) {
        if depth_fill::triangle_nearer(triangle, color, scissor, is_clipped, depth, target) {
            return Ok(());
        }
        return fill_spans_nearer(triangle, color, scissor, depth, target);
    }
    if let Some(shader) = shader.table()
        && table_fill::triangle_nearer(triangle, &shader, scissor, is_clipped, depth, target)
    {
        return Ok(());
    }
    if fog_fill::triangle_nearer(triangle, shader, scissor, is_clipped, depth, target) {
        return Ok(());
    }
    let setup = shader.set_up(&triangle.triangle);
    if shaded_fill::triangle_nearer::<T, S>(triangle, &setup, scissor, depth, target) {
        return Ok(());
    }
    shade_spans_nearer(triangle, scissor, depth, target, |span| colors::<T, S>(&setup, span))
}

/// The plain path of [`fill_nearer`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans_nearer<T: Target>(
    triangle: &DepthTriangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let mut spans = fast::spans(&triangle.triangle, scissor);
    if spans.is_empty() {
        return Ok(()); // no pixel: the gradient is not set up
    }
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    // The spans of a triangle are one row high: stated for the target's code, which is inlined here.
    spans.try_for_each(|span| {
        depth.buffer.test(span, &gradient, |run| target.fill(Span { height: 1, ..run }, color))
    })
}

/// Fills a span of one row.
#[inline(always)]
fn fill_row<T: Target>(target: &mut T, x: i32, y: i32, width: i32, color: T::Color) -> Result<(), T::Error> {
    target.fill(Span { x, y, width, height: 1 }, color)
}

/// The plain path of [`fill_nearer`] for colours that vary.
#[inline(never)] // its stack frame is gone when it returns
fn shade_spans_nearer<T: Target, R: Iterator<Item = T::Color>>(
    triangle: &DepthTriangle<'_>,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    span_colors: impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    let mut spans = fast::spans(&triangle.triangle, scissor);
    spans.try_for_each(|span| shade_span_nearer(span, &gradient, depth, target, &span_colors))
}

#[inline(never)] // its large stack frame does not exist while the next span is computed
fn shade_span_nearer<T: Target, R: Iterator<Item = T::Color>>(
    span: Span,
    gradient: &Gradient,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
    span_colors: &impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    depth.buffer.test(span, gradient, |visible| target.fill_run(visible, span_colors(visible)))
}

/// [`fill`] for a shader that leaves out pixels, or blends.
#[inline(never)] // its stack frame is gone when it returns
fn fill_kept<T: Target, S: ShaderFor<T>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    if !<S::Ink as Ink<T::Color>>::LEAVES_OUT
        && let Some(ink) = shader.solid()
        && shaded_fill::triangle_of_one_ink(triangle, ink, scissor, target)
    {
        return Ok(());
    }
    let setup = shader.set_up(triangle);
    if shaded_fill::triangle::<T, S>(triangle, &setup, scissor, target) {
        return Ok(());
    }
    fast::spans(triangle, scissor).try_for_each(|span| {
        let mut is_kept = kept_pixels::<T::Color, S>(&setup, span);
        let kept = (0..span.width as u16).map(|_| is_kept()); // the guard band is narrower than 2¹⁶
        each_run(span, kept, |run| draw_run::<T, S>(&setup, run, target))
    })
}

/// [`fill_nearer`] for a shader that leaves out pixels, or blends, or whose depth is not stored.
#[inline(never)] // its stack frame is gone when it returns
fn fill_kept_nearer<T: Target, S: ShaderFor<T>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let setup = shader.set_up(&triangle.triangle);
    if shaded_fill::triangle_nearer::<T, S>(triangle, &setup, scissor, depth, target) {
        return Ok(());
    }
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    fast::spans(&triangle.triangle, scissor).try_for_each(|span| {
        let is_kept = kept_pixels::<T::Color, S>(&setup, span);
        depth
            .buffer
            .test_kept(span, &gradient, is_kept, S::WRITES_DEPTH, |run| draw_run::<T, S>(&setup, run, target))
    })
}

/// Whether each pixel of a face is set to a colour of the shader.
pub(super) const fn is_opaque<T: Target, S: SpanShader<T::Color>>() -> bool {
    !(<S::Ink as Ink<T::Color>>::LEAVES_OUT || <S::Ink as Ink<T::Color>>::READS)
}

/// The colours of a span of which no pixel is left out.
#[inline(always)]
fn colors<T: Target, S: SpanShader<T::Color>>(
    setup: &S::Setup,
    span: Span,
) -> impl Iterator<Item = T::Color> {
    S::span(setup, span).map_while(Ink::own)
}

/// Whether a shader draws the pixels of a span: each call answers for the next one, from left to right.
#[inline(always)]
pub(super) fn kept_pixels<C: PixelColor, S: SpanShader<C>>(
    setup: &S::Setup,
    span: Span,
) -> impl FnMut() -> bool {
    let mut inks = S::runs(setup, span).flat_map(|(width, run)| run.take(width as usize));
    move || inks.next().and_then(Ink::own).is_some()
}

/// Draws one run of kept pixels, for a shader that leaves out pixels or blends.
#[inline(always)]
fn draw_run<T: Target, S: ShaderFor<T>>(setup: &S::Setup, run: Span, target: &mut T) -> Result<(), T::Error> {
    if !<S::Ink as Ink<T::Color>>::READS {
        return target.fill_run(run, colors::<T, S>(setup, run));
    }
    if let Some(row) = target.memory().and_then(|memory| memory.row(run.x, run.y, run.width)) {
        row.iter_mut().zip(S::span(setup, run)).for_each(|(cell, ink)| {
            put::<T, _>(cell, ink);
        });
    }
    Ok(())
}

/// Draws a line inside the scissor, which lies in the target.
#[inline(always)]
pub(super) fn line<T: Target>(
    target: &mut T,
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
) -> Result<(), T::Error> {
    if line_fill::line_into_memory(from, to, scissor, color, target) {
        return Ok(());
    }
    if let Some(result) = line_pixels::line_by_pixels(from, to, scissor, color, target) {
        return result;
    }
    raster::line(from, to, scissor, |span| target.fill(span, color))
}

/// [`line`] for bands, which cut most lines: [`line_pixels`] would decline, so its code is not linked.
#[inline(always)]
pub(super) fn line_in_band<T: Target>(
    target: &mut T,
    from: Pixel,
    to: Pixel,
    scissor: &Scissor,
    color: T::Color,
) -> Result<(), T::Error> {
    if line_fill::line_into_memory(from, to, scissor, color, target) {
        return Ok(());
    }
    raster::line(from, to, scissor, |span| target.fill(span, color))
}

/// The part of a target inside the guard band, in which 2D drawing is done. `Memory` stores it, so that it is not computed for
/// each triangle.
#[inline(always)]
pub(super) fn scissor_of<T: Target>(target: &mut T) -> Scissor {
    match target.memory() {
        Some(memory) => *memory.drawable(),
        None => drawable(&target.area()),
    }
}
