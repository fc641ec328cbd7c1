//! Rows of triangles in a buffer of pixels: the trait through which the fills use the triangle tiers.
//!
//! This file has no fast path of its own, so it has no plain twin, gain or test: see `small_triangle.rs` and
//! `bresenham_triangle.rs`, whose triangles implement the trait.

use crate::raster::{Gradient, PixelLayout, RowScratch};

/// The rows of a triangle, top to bottom.
pub(crate) trait Rows: Sized {
    /// No row is wider than this, in sub-pixels.
    const WIDTH: i32;

    /// Whether the triangle has no row.
    fn is_empty(&self) -> bool;

    /// The origin that row ends are counted from, in a buffer with this layout.
    fn start(&self, layout: PixelLayout) -> RowOrigin;

    /// Calls `row` for each row with a base index, the left end and the right end, both counted from the base index. The left
    /// end is included, the right end excluded; a row is empty if right ≤ left.
    fn each(self, scratch: &mut RowScratch, row: impl FnMut(usize, i32, i32));
}

/// The origin that row ends are counted from: column `x` in the first row, `y`, and `shear` columns farther left in each
/// row than in the row above.
///
/// Only the Cortex-M0 walker has a shear: its row ends are buffer indices, so a gradient subtracts `stride` columns per
/// row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowOrigin {
    pub(crate) x: i32,
    /// The first row that is filled, in the target's coordinates.
    pub(crate) y: i32,
    pub(crate) shear: usize,
}

impl Gradient {
    /// The gradient whose columns are counted from an origin that moves left by `shear` columns per row.
    #[inline(always)]
    pub(crate) fn sheared(self, shear: usize) -> Self {
        Self { down: self.down.wrapping_sub(self.right.wrapping_mul(shear as u32)), ..self }
    }
}
