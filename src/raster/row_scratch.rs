//! Scratch memory for the rows of one triangle, which targets with memory provide to the fast paths.

use super::PixelLayout;

/// The layout of a target's pixels and, on a Cortex-M0, storage for the row ends of one triangle, which its fast path computes
/// before it fills the first row. Other cores have no storage. A target with memory owns one scratch for all triangles, because
/// clearing it for each triangle takes time.
#[derive(Debug)]
pub(crate) struct RowScratch {
    pub(crate) layout: PixelLayout,
    /// The left and right end of each row, as buffer indices.
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

    /// Scratch for spans: a layout with stride 0, in which the index of a pixel is its column.
    #[inline(always)]
    pub(crate) fn of_columns() -> Self {
        Self::new(PixelLayout::new(0, 0, 0))
    }
}
