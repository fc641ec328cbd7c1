//! The last stage: a triangle with its shader into a target.

use crate::raster::{DepthTriangle, Scissor, Triangle};
use crate::shading::SpanShader;
use crate::surface::{DepthTarget, Target};

/// Step 4: a triangle over all that is there.
#[inline(always)]
pub(super) fn fill<T: Target, I: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    ink: &I,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    match ink.solid_color() {
        Some(colour) => target.triangle(triangle, scissor, colour),
        None => {
            let fill = ink.set_up(triangle);
            target.shaded(triangle, scissor, |span| I::span(&fill, span))
        }
    }
}

/// Step 4: a triangle where it is nearer.
#[inline(always)]
pub(super) fn fill_nearer<T: Target, I: SpanShader<T::Color>>(
    piece: &DepthTriangle<'_>,
    ink: &I,
    scissor: &Scissor,
    against: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    match ink.solid_color() {
        Some(colour) => target.nearer(piece, scissor, against, colour),
        None => match ink.shades() {
            Some(shades) => target.shades_nearer(piece, scissor, against, &shades),
            None => {
                let fill = ink.set_up(&piece.triangle);
                target.shaded_nearer(piece, scissor, against, |span| I::span(&fill, span))
            }
        },
    }
}
