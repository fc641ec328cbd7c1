//! Colours as cells of memory.

use embedded_graphics_core::pixelcolor::PixelColor;

/// A colour as a cell of memory: the colour itself, its bytes in the order in which displays take them, or its number.
///
/// | cell | memory holds | colours |
/// |---|---|---|
/// | the colour | whatever the type is | all |
/// | `[u8; N]` | [`PixelFormat`](crate::PixelFormat)'s bits, most significant byte first | those of 8, 16 and 24 bits |
/// | `u16` | the number in the core's own byte order, as LCD controllers and 16-bit SPI take it | `Rgb565`, `Bgr565`, `Rgb555`, `Bgr555` |
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::StoredPixel;
/// assert_eq!((Rgb565::RED.stored(), Rgb565::RED.stored()), (Rgb565::RED, [0xf8, 0x00]));
/// assert_eq!(Rgb565::load([0xf8, 0x00]), Rgb565::RED);
/// assert_eq!(Rgb565::load(0xf800_u16), Rgb565::RED);
/// ```
#[diagnostic::on_unimplemented(
    message = "pixels of `{Self}` cannot be stored in cells of `{Cell}`",
    label = "no such cell for this color",
    note = "cells are the color type itself, `[u8; N]` for colors of N whole bytes, or `u16` for colors of 16 bits",
    note = "draw colors of less than 8 bits into the `Band` itself instead of `Band::pixels()`"
)]
pub trait StoredPixel<Cell>: PixelColor {
    /// The colour as a cell of memory.
    fn stored(self) -> Cell;

    /// The colour of a cell, for shaders that blend with the pixel that is there: what [`stored`](Self::stored) was given.
    fn load(cell: Cell) -> Self;
}

impl<C: PixelColor> StoredPixel<C> for C {
    #[inline(always)]
    fn stored(self) -> C {
        self
    }

    #[inline(always)]
    fn load(cell: C) -> C {
        cell
    }
}
