//! Where fast paths that write to memory attach.

use crate::surface::{Memory, Target};

/// Where every fast path that writes to memory attaches: the target's memory, or `None` for targets without memory, and for all
/// targets with `--cfg pinhole_plain`.
#[inline(always)]
pub(super) fn memory_of<T: Target>(target: &mut T) -> Option<&mut Memory<T::Store>> {
    if cfg!(pinhole_plain) {
        None
    } else {
        target.memory()
    }
}
