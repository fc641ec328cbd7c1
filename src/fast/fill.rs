//! The fast paths of triangles into memory, each tried in turn.
//!
//! This file has no plain twin, gain or test of its own: see the files of the fills.

use super::{fog_fill, ramp_fill, shaded_fill, solid_fill};
use crate::color::InkKind;
use crate::raster::{DepthTriangle, Scissor, Triangle};
use crate::shading::{FastPath, SpanShader};
use crate::surface::{DepthTarget, Surface};

/// Fills a triangle, if the target's pixels lie in memory; otherwise draws nothing and returns `false`. `is_clipped`: the triangle
/// probably has rows outside the scissor, so the [`Small`](super::Small) tier is not tried.
#[inline(always)]
pub(crate) fn fill<T: Surface, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> bool {
    if S::Ink::IS_OPAQUE {
        if let Some(color) = shader.solid().and_then(InkKind::own) {
            return solid_fill::triangle(triangle, color, scissor, is_clipped, target);
        }
        if let Some(levels) = S::FastPath::levels(shader) {
            return fog_fill::triangle(triangle, &levels, scissor, target);
        }
    } else if !S::Ink::LEAVES_OUT
        && let Some(ink) = shader.solid()
    {
        return shaded_fill::triangle_of_one_ink(triangle, ink, scissor, target);
    }
    match S::FastPath::inner(shader) {
        Some(inner) => vary(triangle, inner, scissor, is_clipped, target),
        None => vary(triangle, shader, scissor, is_clipped, target),
    }
}

/// [`fill`] for inks that vary.
#[inline(always)]
fn vary<T: Surface, S: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    target: &mut T,
) -> bool {
    if S::Ink::IS_OPAQUE
        && let Some(shader) = S::FastPath::table(shader)
    {
        return ramp_fill::table(triangle, &shader, scissor, is_clipped, target);
    }
    shaded_fill::triangle(triangle, shader, scissor, target)
}

/// [`fill`] for the pixels that are nearer than the depth buffer.
#[inline(always)]
pub(crate) fn fill_nearer<T: Surface, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    if S::Ink::IS_OPAQUE && S::WRITES_DEPTH {
        if let Some(color) = shader.solid().and_then(InkKind::own) {
            return solid_fill::triangle_nearer(triangle, color, scissor, is_clipped, depth, target);
        }
        if let Some(levels) = S::FastPath::levels(shader)
            && fog_fill::triangle_nearer(triangle, &levels, scissor, is_clipped, depth, target)
        {
            return true;
        }
    }
    match S::FastPath::inner(shader) {
        Some(inner) => vary_nearer(triangle, inner, scissor, is_clipped, depth, target),
        None => vary_nearer(triangle, shader, scissor, is_clipped, depth, target),
    }
}

/// [`fill_nearer`] for inks that vary.
#[inline(always)]
fn vary_nearer<T: Surface, S: SpanShader<T::Color>>(
    triangle: &DepthTriangle<'_>,
    shader: &S,
    scissor: &Scissor,
    is_clipped: bool,
    depth: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> bool {
    if S::Ink::IS_OPAQUE
        && S::WRITES_DEPTH
        && let Some(shader) = S::FastPath::table(shader)
        && ramp_fill::table_nearer(triangle, &shader, scissor, is_clipped, depth, target)
    {
        return true;
    }
    shaded_fill::triangle_nearer(triangle, shader, scissor, depth, target)
}
