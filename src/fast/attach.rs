//! Where fast paths that write to memory attach.

use crate::raster::Scissor;
use crate::surface::{Memory, PixelRows, Surface};

/// Where every fast path that writes to memory attaches: the target's pixels, or `None` for targets without memory, and for all
/// targets with `--cfg pinhole_plain`.
#[inline(always)]
pub(super) fn memory_of<T: Surface>(target: &mut T) -> Option<&mut PixelRows<T::Store>> {
    memory_with_drawable(target).map(|(_, rows)| rows)
}

/// [`memory_of`], with the part of the target that 2D drawing can reach.
#[inline(always)]
pub(super) fn memory_with_drawable<T: Surface>(
    target: &mut T,
) -> Option<(&Scissor, &mut PixelRows<T::Store>)> {
    if cfg!(pinhole_plain) {
        None
    } else {
        target.memory().map(Memory::split)
    }
}
