//! Fast paths: each is a twin of a plain path, for some inputs or some cores, with the same bits.

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) mod bresenham_triangle;
pub(crate) mod depth_fill;
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
mod edge20;
pub(crate) mod line_fill;
pub(crate) mod shaded_fill;
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
mod small_triangle;
pub(crate) mod solid_fill;
pub(crate) mod table_fill;

use crate::surface::{Memory, Target};

/// Where every fast path that writes to memory attaches: the target's memory, or `None` for targets without memory, and for all
/// targets with `--cfg pinhole_plain`.
#[inline(always)]
fn memory_of<T: Target>(target: &mut T) -> Option<&mut Memory<T::Store>> {
    if cfg!(pinhole_plain) {
        None
    } else {
        target.memory()
    }
}

#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) use by_division::{Inside, Kept, Low, Small};
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use without_division::{Inside, Kept, Low, Small};

/// Small triangles, and the rows of those that may be cut.
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
mod by_division {
    use super::edge20::{AtOnce, ByDivision};
    pub(crate) use super::small_triangle::Kept;
    use super::small_triangle::SmallTriangle;

    /// Within 32 by 30 pixels, inside the scissor: most.
    pub(crate) type Small = SmallTriangle<AtOnce, false>;
    /// Within 32 rows, inside the scissor.
    pub(crate) type Inside = SmallTriangle<ByDivision, false>;
    /// The same between the scissor's columns.
    pub(crate) type Low = SmallTriangle<ByDivision, true>;
}

/// The same within 31 rows, small ones too.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
mod without_division {
    use super::bresenham_triangle::BresenhamTriangle;
    pub(crate) use super::bresenham_triangle::Kept;

    pub(crate) type Small = BresenhamTriangle<false>;
    pub(crate) type Inside = BresenhamTriangle<false>;
    pub(crate) type Low = BresenhamTriangle<true>;
}
