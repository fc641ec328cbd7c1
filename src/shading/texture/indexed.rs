//! Texels that name colours of a palette.

use super::texels::{checked_bits, index, Texels, TextureError};
use embedded_graphics_core::pixelcolor::PixelColor;

/// Texels of `BITS` bits each, 1, 2, 4 or 8, that name colours of a palette: a picture of 64 × 64 takes 512 to 4096 bytes.
/// Another palette gives the picture other colours, or its colours in other light, at no instruction per pixel.
///
/// Texels lie row by row, the upper row first, and the left texel of a byte is in its highest bits, as in `ImageRaw` of
/// embedded-graphics.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::texture::{IndexedTexels, Texels};
/// const PALETTE: [Rgb565; 2] = [Rgb565::BLACK, Rgb565::YELLOW];
/// let rows = [0b1000_0000, 0, 0, 0, 0, 0, 0, 0b0000_0001];
/// let texels = IndexedTexels::<_, 1>::new(&rows, 8, 8, &PALETTE)?;
/// assert_eq!(texels.texel(0, 0), Rgb565::YELLOW);
/// assert_eq!(texels.texel(1 << 29, 0), Rgb565::BLACK);
/// assert_eq!(texels.texel(u32::MAX, u32::MAX), Rgb565::YELLOW);
/// # Ok::<(), pinhole::texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndexedTexels<'t, C, const BITS: u32> {
    bytes: &'t [u8],
    bits: [u32; 2],
    palette: &'t [C],
    /// The palette's first colour: the fallback of a look-up that never fails, since the palette has a colour for each index.
    first: C,
}

impl<'t, C: PixelColor, const BITS: u32> IndexedTexels<'t, C, BITS> {
    /// The binary logarithm of `BITS`.
    const SHIFT: u32 = match BITS {
        1 => 0,
        2 => 1,
        4 => 2,
        8 => 3,
        _ => panic!("a texel has 1, 2, 4 or 8 bits"),
    };

    /// Texels of a picture of `width` columns and `height` rows, and 2^`BITS` colours.
    ///
    /// # Errors
    ///
    /// [`TextureError::Side`] if a side is not 8, 16, 32, 64, 128 or 256, [`TextureError::Texels`] if there are fewer than
    /// `width * height * BITS / 8` bytes, and [`TextureError::Palette`] if there are fewer than 2^`BITS` colours.
    pub const fn new(
        bytes: &'t [u8],
        width: usize,
        height: usize,
        palette: &'t [C],
    ) -> Result<Self, TextureError> {
        let bits = match checked_bits(width, height) {
            Ok(bits) => bits,
            Err(error) => return Err(error),
        };
        let (needed, given) = ((width * height) >> (3 - Self::SHIFT), bytes.len()); // at most 2¹⁶
        if given < needed {
            return Err(TextureError::Texels { needed, given });
        }
        let (needed, given) = (1 << BITS, palette.len());
        match palette.first() {
            Some(&first) if given >= needed => Ok(Self { bytes, bits, palette, first }),
            _ => Err(TextureError::Palette { needed, given }),
        }
    }
}

impl<C: PixelColor, const BITS: u32> Texels for IndexedTexels<'_, C, BITS> {
    type Color = C;
    type Ink = C;
    type FastPath = ();

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.bits
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        let [w, h] = self.bits;
        let at = index(v, h) << (w & 31) | index(u, w);
        let texels = 3 - Self::SHIFT; // a byte holds 2^texels
        let byte = self.bytes.get(at >> texels).copied().unwrap_or(0);
        let within = (8 - BITS) - (at << Self::SHIFT & 7) as u32; // the texel's lowest bit: a multiple of BITS, 0 … 7
        let number = (u32::from(byte) >> (within & 7)) & ((1 << BITS) - 1);
        self.palette.get(number as usize).copied().unwrap_or(self.first)
    }
}

defmt_format!(
    [C, const BITS: u32] IndexedTexels<'_, C, BITS>, self,
    "{=u32} x {=u32} texels of {=u32} bits", 1 << self.bits[0], 1 << self.bits[1], BITS
);
