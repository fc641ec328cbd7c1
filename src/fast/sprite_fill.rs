//! A row of a sprite into memory.
//!
//! - **Plain twin**: the loop over runs in `pipeline::sprite_fill::fill_row`.
//! - **Domain**: every row, on a target whose pixels lie in memory; with depth, whatever the layout of the depth buffer.
//! - **Gain**: a texel is looked up once; the plain path looks it up twice, for the run and for its colour. Not measured alone.
//! - **Test**: `every_target_shows_the_oracles_pixels` in `tests/pipeline/sprites.rs`, with `--cfg pinhole_plain` and without.

use super::memory_of;
use crate::math::hints::keep_rolled;
use crate::raster::Span;
use crate::surface::{PixelStore, Target};

type CellOf<T> = <<T as Target>::Store as PixelStore>::Cell;

/// The cells of a span's pixels, if the target's pixels lie in memory.
#[inline(always)]
fn cells<T: Target>(span: Span, target: &mut T) -> Option<&mut [CellOf<T>]> {
    let (cells, scratch) = memory_of(target)?.parts();
    let from = scratch.layout.at(span.x, span.y);
    // The span lies in the target, so in its memory.
    cells.get_mut(from..from.wrapping_add(span.width as usize))
}

/// Sets each pixel of a span for which `colors` has a colour to what `merge` makes of the colour and the stored cell, if the target's
/// pixels lie in memory; otherwise draws nothing and returns `false`.
#[inline(always)]
pub(crate) fn row<T: Target>(
    span: Span,
    colors: impl Iterator<Item = Option<T::Color>>,
    target: &mut T,
    merge: impl Fn(T::Color, CellOf<T>) -> CellOf<T>,
) -> bool {
    let Some(cells) = cells(span, target) else { return false };
    for (cell, color) in cells.iter_mut().zip(colors) {
        keep_rolled();
        if let Some(color) = color {
            *cell = merge(color, *cell);
        }
    }
    true
}

/// [`row`] for the pixels whose stored depths are larger than `own`, which replaces them if `WRITES`.
#[inline(always)]
pub(crate) fn row_nearer<T: Target, const WRITES: bool>(
    span: Span,
    colors: impl Iterator<Item = Option<T::Color>>,
    own: u16,
    depths: &mut [u16],
    target: &mut T,
    merge: impl Fn(T::Color, CellOf<T>) -> CellOf<T>,
) -> bool {
    let Some(cells) = cells(span, target) else { return false };
    for ((cell, stored), color) in cells.iter_mut().zip(depths).zip(colors) {
        keep_rolled();
        if let Some(color) = color
            && own < *stored
        {
            *cell = merge(color, *cell);
            if WRITES {
                *stored = own;
            }
        }
    }
    true
}
