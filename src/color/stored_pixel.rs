//! Colours as cells of memory.

use super::Color;
use embedded_graphics_core::pixelcolor::raw::{RawU16, RawU2, RawU24, RawU32, RawU4, RawU8};
use embedded_graphics_core::pixelcolor::PixelColor;

/// A colour as a cell of memory: the colour itself, its bytes in the order in which displays take them, or its number. Implemented for
/// every colour type.
///
/// | cell | memory holds | colours |
/// |---|---|---|
/// | the colour | whatever the type is | all |
/// | `[u8; N]` | the bits of the [`Color`], most significant byte first | those whose `Raw` type has 2, 4 or 8 bits (a byte), 16, 24 or 32 bits, or none: `()` (two bytes) |
/// | `u16` | the number in the core's own byte order, as LCD controllers and 16-bit SPI take it | those whose `Raw` type has 16 bits |
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::color::StoredPixel;
/// assert_eq!((Rgb565::RED.stored(), Rgb565::RED.stored()), (Rgb565::RED, [0xf8, 0x00]));
/// assert_eq!(Rgb565::load([0xf8, 0x00]), Rgb565::RED);
/// assert_eq!(Rgb565::load(0xf800_u16), Rgb565::RED);
/// ```
#[diagnostic::on_unimplemented(
    message = "pixels of `{Self}` cannot be stored in cells of `{Cell}`",
    label = "no such cell for this color",
    note = "cells are the color type itself, `[u8; N]` for colors of N bytes, or `u16` for colors of 16 bits",
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

/// A raw type of embedded-graphics whose pixels are stored in `N` bytes. A colour of one bit is not: two colours cannot be mixed.
#[diagnostic::on_unimplemented(
    message = "a pixel of this color is not {N} bytes",
    label = "not {N} bytes",
    note = "draw into the `Band` itself instead of `Band::pixels()`; two colors have none between them, so their edges cannot be smoothed"
)]
pub trait InBytes<const N: usize> {}
impl InBytes<1> for RawU2 {}
impl InBytes<1> for RawU4 {}
impl InBytes<1> for RawU8 {}
impl InBytes<2> for () {}
impl InBytes<2> for RawU16 {}
impl InBytes<3> for RawU24 {}
impl InBytes<4> for RawU32 {}

impl<C: Color<Raw: InBytes<N>>, const N: usize> StoredPixel<[u8; N]> for C {
    #[inline(always)]
    fn stored(self) -> [u8; N] {
        const { assert!(C::FORMAT.bits() as usize <= 8 * N, "the color has more bits than its `Raw` type") };
        let mut bytes = [0; N];
        // The last bytes of the four.
        bytes.iter_mut().rev().zip(self.to_bits().to_le_bytes()).for_each(|(byte, bits)| *byte = bits);
        bytes
    }

    #[inline(always)]
    fn load(bytes: [u8; N]) -> Self {
        Self::from_bits(bytes.iter().fold(0, |bits, &byte| bits << 8 | u32::from(byte)))
    }
}

impl<C: Color<Raw = RawU16>> StoredPixel<u16> for C {
    #[inline(always)]
    fn stored(self) -> u16 {
        self.to_bits() as u16 // 16 bits
    }

    #[inline(always)]
    fn load(bits: u16) -> Self {
        Self::from_bits(bits.into())
    }
}
