//! Where pixels stand in memory.

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
use crate::fast::bresenham_triangle::{Ends, NONE};

/// Where pixels stand in memory, row by row. Those that are not inside wrap.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelLayout {
    /// From a pixel to the one below.
    pub(crate) stride: usize,
    /// Where the pixel in column 0 and row 0 would stand.
    pub(crate) origin: usize,
}

impl PixelLayout {
    /// The pixel in this column and row stands first.
    #[inline(always)]
    pub(crate) fn new(left: i32, top: i32, stride: usize) -> Self {
        Self { stride, origin: place(left, top, stride).wrapping_neg() }
    }

    /// Of a pixel.
    #[inline(always)]
    pub(crate) fn at(self, x: i32, y: i32) -> usize {
        place(x, y, self.stride).wrapping_add(self.origin)
    }
}

/// Of a pixel, if that in column 0 and row 0 stands first.
#[inline(always)]
pub(crate) fn place(x: i32, y: i32, stride: usize) -> usize {
    (y as usize).wrapping_mul(stride).wrapping_add(x as usize)
}

/// Where triangles are drawn.
#[derive(Debug)]
pub(crate) struct RowScratch {
    pub(crate) places: PixelLayout,
    /// Room for a triangle's rows. Of pixels in memory it is cleared once, not for each triangle.
    #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
    pub(crate) ends: Ends,
}

impl RowScratch {
    #[inline(always)]
    pub(crate) fn new(places: PixelLayout) -> Self {
        Self {
            places,
            #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
            ends: NONE,
        }
    }

    /// Where every pixel stands in its column.
    #[inline(always)]
    pub(crate) fn of_columns() -> Self {
        Self::new(PixelLayout::new(0, 0, 0))
    }
}

/// The origin that row ends are counted from: column `x` in the first row, moving left by `shear` pixels per row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowOrigin {
    pub(crate) x: i32,
    /// The first row.
    pub(crate) y: i32,
    pub(crate) shear: usize,
}

/// Rows of a triangle, on the way down.
pub(crate) trait Rows: Sized {
    /// No row is longer, in sub-pixels.
    const WIDTH: i32;

    /// Whether there is none.
    fn is_empty(&self) -> bool;

    /// What its ends are counted from.
    fn start(&self, places: PixelLayout) -> RowOrigin;

    /// For each row the place of what its ends are counted from, and these: it may end before it begins.
    fn each(self, ground: &mut RowScratch, row: impl FnMut(usize, i32, i32));
}
