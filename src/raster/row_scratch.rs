//! Storage that a target lends to the fast paths of triangles.

use super::PixelLayout;

/// The layout of a target's pixels, and storage for the row ends of one triangle on a Cortex-M0, whose fast path computes
/// them beforehand; other cores store nothing. Pixels in memory keep one, because clearing it for each triangle costs
/// time.
#[derive(Debug)]
pub(crate) struct RowScratch {
    pub(crate) layout: PixelLayout,
    #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
    pub(crate) ends: [[usize; 2]; RowScratch::ROWS],
}

impl RowScratch {
    /// The number of rows whose ends can be stored.
    #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
    pub(crate) const ROWS: usize = 31;

    #[inline(always)]
    pub(crate) fn new(layout: PixelLayout) -> Self {
        Self {
            layout,
            #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
            ends: [[0; 2]; Self::ROWS],
        }
    }

    /// Scratch for spans, with the layout in which a pixel's index is its column.
    #[inline(always)]
    pub(crate) fn of_columns() -> Self {
        Self::new(PixelLayout::new(0, 0, 0))
    }
}
