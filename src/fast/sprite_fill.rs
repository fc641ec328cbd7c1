//! A row of a sprite into memory.
//!
//! - **Plain twin**: the loop over runs in `pipeline::sprite_fill::fill_row`.
//! - **Domain**: every row, on a target whose pixels lie in memory; with depth, whatever the layout of the depth buffer.
//! - **Gain**: a texel is looked up once; the plain path looks it up twice, for the run and for its colour. Not measured alone.
//! - **Test**: `every_target_shows_the_oracles_pixels` in `tests/pipeline/sprites.rs`, with `--cfg pinhole_plain` and without.

use super::memory_of;
use super::put_run::{put_each, put_each_nearer, Inked};
use crate::color::Ink;
use crate::raster::Span;
use crate::surface::Surface;

/// Sets the pixels of a span to their inks, if the target's pixels lie in memory; otherwise draws nothing and returns `false`. With
/// `DEPTH`, only pixels whose stored depths are larger than `own`, which replaces them unless the ink is mixed with stored pixels.
#[inline(always)]
pub(crate) fn row<T: Surface, I: Ink<T::Color>, const DEPTH: bool>(
    span: Span,
    inks: impl Iterator<Item = I>,
    own: u16,
    depths: &mut [u16],
    target: &mut T,
) -> bool {
    let Some(memory) = memory_of(target) else { return false };
    let (cells, scratch) = memory.parts();
    let from = scratch.layout.at(span.x, span.y);
    // The span lies in the target, so in its memory.
    let Some(cells) = cells.get_mut(from..from.wrapping_add(span.width as usize)) else { return true };
    let (mut inks, own) = (inks.map(Inked::<T::Color, I>::new), u32::from(own) << 16);
    match (DEPTH, I::READS) {
        (false, _) => put_each::<_, true>(cells, inks),
        (true, true) => _ = put_each_nearer::<_, false>(cells, depths, own, 0, &mut inks),
        (true, false) => _ = put_each_nearer::<_, true>(cells, depths, own, 0, &mut inks),
    }
    true
}
