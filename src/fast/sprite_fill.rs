//! A row of a sprite into memory.
//!
//! - **Plain twin**: the loop over runs in `pipeline::sprite_fill::fill_row`.
//! - **Domain**: every row, on a target whose pixels lie in memory; with depth, whatever the layout of the depth buffer.
//! - **Gain**: a texel is looked up once; the plain path looks it up twice, for the run and for its colour. Not measured alone.
//! - **Test**: `every_target_shows_the_oracles_pixels` in `tests/pipeline/sprites.rs`, with `--cfg pinhole_plain` and without.

use super::memory_of;
use crate::color::Ink;
use crate::math::hints::keep_rolled;
use crate::raster::Span;
use crate::surface::{put, CellOf, Target};

/// The cells of a span's pixels, if the target's pixels lie in memory.
#[inline(always)]
fn cells<T: Target>(span: Span, target: &mut T) -> Option<&mut [CellOf<T>]> {
    let (cells, scratch) = memory_of(target)?.parts();
    let from = scratch.layout.at(span.x, span.y);
    // The span lies in the target, so in its memory.
    cells.get_mut(from..from.wrapping_add(span.width as usize))
}

/// Sets the pixels of a span to their inks, if the target's pixels lie in memory; otherwise draws nothing and returns `false`.
#[inline(always)]
pub(crate) fn row<T: Target, I: Ink<T::Color>>(
    span: Span,
    inks: impl Iterator<Item = I>,
    target: &mut T,
) -> bool {
    let Some(cells) = cells(span, target) else { return false };
    for (cell, ink) in cells.iter_mut().zip(inks) {
        keep_rolled();
        put::<T, I>(cell, ink);
    }
    true
}

/// [`row`] for the pixels whose stored depths are larger than `own`, which replaces them unless the ink is mixed with stored pixels.
#[inline(always)]
pub(crate) fn row_nearer<T: Target, I: Ink<T::Color>>(
    span: Span,
    inks: impl Iterator<Item = I>,
    own: u16,
    depths: &mut [u16],
    target: &mut T,
) -> bool {
    let Some(cells) = cells(span, target) else { return false };
    for ((cell, stored), ink) in cells.iter_mut().zip(depths).zip(inks) {
        keep_rolled();
        if own < *stored && put::<T, I>(cell, ink) && !I::READS {
            *stored = own;
        }
    }
    true
}
