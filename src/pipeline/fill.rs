//! The last step of the pipeline: a triangle or a line, clipped to the screen, becomes pixels.
//!
//! The plain path is the loop over spans at the end of each function; it draws into any target and defines the picture. The
//! call before that loop attaches a fast path, which may decline. All fast paths decline with `--cfg pinhole_plain`, and for
//! targets whose pixels do not lie in memory.

use super::drawable::ShaderFor;
use crate::color::InkKind;
use crate::fast::{self, line_fill, line_pixels};
use crate::raster::{self, DepthTriangle, Gradient, Pixel, Scissor, Span, Triangle};
use crate::shading::{FastPath, SpanShader};
use crate::surface::{draw_run, drawable, each_run, DepthTarget, Surface};
use embedded_graphics_core::pixelcolor::PixelColor;

/// Fills the pixels of a triangle inside the scissor, which lies in the target. `is_clipped`: whether the triangle probably has
/// rows outside the scissor, as most triangles in a band have; it changes no pixel, only which path is tried.
#[inline(always)]
pub(super) fn fill<T: Surface, S: ShaderFor<T>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> Result<(), T::Error> {
    if fast::fill(triangle, shader, scissor, is_clipped, target) {
        return Ok(());
    }
    match solid_color::<T, S>(shader) {
        Some(color) => fill_spans(triangle, color, scissor, target),
        None => shade_spans(triangle, shader, scissor, target),
    }
}

/// The plain path of [`fill`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans<T: Surface>(
    triangle: &Triangle<'_>,
    color: T::Color,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    // The spans of a triangle are one row high: stated for the target's code, which is inlined here.
    fast::spans(triangle, scissor).try_each(|span| target.fill(Span { height: 1, ..span }, color))
}

/// The plain path of [`fill`] for inks that vary, or that are not colours.
#[inline(never)] // its stack frame is gone when it returns
fn shade_spans<T: Surface, S: ShaderFor<T>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    let setup = shader.set_up(triangle);
    fast::spans(triangle, scissor).try_for_each(|span| {
        if S::Ink::IS_OPAQUE {
            return draw_run(span, S::span(&setup, span), target);
        }
        let mut is_kept = kept_pixels::<T::Color, S>(&setup, span);
        let kept = (0..span.width as u16).map(|_| is_kept()); // the guard band is narrower than 2¹⁶
        each_run(span, kept, |run| draw_run(run, S::span(&setup, run), target))
    })
}

/// Fills the pixels of a triangle inside the scissor that are nearer than the depth buffer. The scissor lies in the target and
/// in the depth buffer. `is_clipped` is that of [`fill`].
#[inline(always)]
pub(super) fn fill_nearer<T: Surface, S: ShaderFor<T>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    if fast::fill_nearer(triangle, shader, scissor, is_clipped, depth, target) {
        return Ok(());
    }
    match solid_color::<T, S>(shader).filter(|_| S::WRITES_DEPTH) {
        Some(color) => fill_spans_nearer(triangle, color, scissor, depth, target),
        None => shade_spans_nearer(triangle, shader, scissor, depth, target),
    }
}

/// The plain path of [`fill_nearer`] for one colour.
#[inline(never)] // its stack frame is gone when it returns
fn fill_spans_nearer<T: Surface>(
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
    spans.try_for_each(|span| {
        depth.buffer.test(span, &gradient, |run| target.fill(Span { height: 1, ..run }, color))
    })
}

/// The plain path of [`fill_nearer`] for inks that vary, or that are not colours.
#[inline(never)] // its stack frame is gone when it returns
fn shade_spans_nearer<T: Surface, S: ShaderFor<T>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let setup = shader.set_up(&triangle.triangle);
    let gradient = fast::depth_gradient(&triangle.triangle, &triangle.depths);
    let mut spans = fast::spans(&triangle.triangle, scissor);
    spans.try_for_each(|span| shade_span_nearer::<T, S>(span, &setup, &gradient, depth, target))
}

#[inline(never)] // its large stack frame does not exist while the next span is computed
fn shade_span_nearer<T: Surface, S: ShaderFor<T>>(
    span: Span,
    setup: &S::Setup,
    gradient: &Gradient,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    let mut kept = (!S::Ink::IS_OPAQUE).then(|| kept_pixels::<T::Color, S>(setup, span));
    let is_kept = || kept.as_mut().is_none_or(|is_kept| is_kept());
    depth
        .buffer
        .test_kept(span, gradient, is_kept, S::WRITES_DEPTH, |run| draw_run(run, S::span(setup, run), target))
}

/// The colour of all pixels, if the shader has only one and sets each pixel to it.
#[inline(always)]
pub(super) fn solid_color<T: Surface, S: SpanShader<T::Color>>(shader: &S) -> Option<T::Color> {
    shader.solid().filter(|_| S::Ink::IS_OPAQUE).and_then(InkKind::own)
}

/// Whether a shader draws the pixels of a span: each call answers for the next one, from left to right.
#[inline(always)]
pub(super) fn kept_pixels<C: PixelColor, S: SpanShader<C>>(
    setup: &S::Setup,
    span: Span,
) -> impl FnMut() -> bool {
    let mut inks = S::FastPath::runs(setup, span).flat_map(|(width, run)| run.take(width as usize));
    move || inks.next().and_then(InkKind::own).is_some()
}

/// Draws a line inside the scissor, which lies in the target.
#[inline(always)]
pub(super) fn line<T: Surface>(
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
pub(super) fn line_in_band<T: Surface>(
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
pub(super) fn scissor_of<T: Surface>(target: &mut T) -> Scissor {
    match target.memory() {
        Some(memory) => *memory.drawable(),
        None => drawable(&target.area()),
    }
}
