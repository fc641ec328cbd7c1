//! The error of memory that is too small for its pixels.

use embedded_graphics_core::geometry::Size;

/// A buffer has fewer cells than the picture has pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PictureError {
    /// Cells that the picture needs: one for each pixel.
    pub needed: u64,
    /// Cells in the buffer.
    pub given: usize,
}

impl core::fmt::Display for PictureError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { needed, given } = self;
        write!(f, "a picture of {needed} pixels needs a buffer of {needed} cells, but this one has {given}")
    }
}

impl core::error::Error for PictureError {}

impl PictureError {
    /// Checks that `given` cells are enough for a picture of `size`.
    #[inline(always)]
    pub(super) fn check(size: Size, given: usize) -> Result<(), Self> {
        let needed = u64::from(size.width) * u64::from(size.height);
        if needed <= given as u64 {
            Ok(())
        } else {
            Err(Self { needed, given })
        }
    }
}
