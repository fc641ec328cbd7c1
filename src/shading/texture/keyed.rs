//! Texels of which one colour, or one index, is transparent.

use super::indexed::IndexedTexels;
use super::texels::Texels;
use crate::color::InkKind;
use embedded_graphics_core::pixelcolor::PixelColor;

/// Texels of which one colour is transparent, as magenta often is in sprites: a pixel that would show it is left out, and its
/// depth is not stored. Wraps every source of [`Texels`].
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::texture::{ColorKeyed, Texels};
/// const KEY: Rgb565 = Rgb565::MAGENTA;
/// static PICTURE: [[Rgb565; 8]; 8] = [[Rgb565::RED, Rgb565::RED, Rgb565::RED, Rgb565::RED, KEY, KEY, KEY, KEY]; 8];
/// let texels = ColorKeyed::new(&PICTURE, KEY);
/// assert_eq!([0, 1 << 31].map(|u| texels.texel(u, 0)), [Some(Rgb565::RED), None]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorKeyed<S, C> {
    texels: S,
    key: C,
}

impl<S: Texels> ColorKeyed<S, S::Color> {
    /// These texels, with those of the colour `key` transparent.
    pub const fn new(texels: S, key: S::Color) -> Self {
        Self { texels, key }
    }
}

impl<S: Texels> Texels for ColorKeyed<S, S::Color> {
    type Color = S::Color;
    type Ink = Option<S::Color>;
    const WIDE: bool = S::WIDE;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.texels.size_bits()
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> Option<S::Color> {
        self.texels.texel(u, v).own().filter(|color| *color != self.key)
    }
}

/// [`IndexedTexels`] of which one index is transparent: a pixel that would show it is left out, and its depth is not stored. The
/// palette's colour at this index is never shown; another index with an equal colour is.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::texture::{IndexKeyed, IndexedTexels, Texels};
/// const PALETTE: [Rgb565; 2] = [Rgb565::BLACK, Rgb565::YELLOW];
/// let rows = [0b1000_0000, 0, 0, 0, 0, 0, 0, 0b0000_0001];
/// let texels = IndexKeyed::new(IndexedTexels::<_, 1>::new(&rows, 8, 8, &PALETTE)?, 0);
/// assert_eq!(texels.texel(0, 0), Some(Rgb565::YELLOW));
/// assert_eq!(texels.texel(1 << 29, 0), None);
/// # Ok::<(), pinhole::texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndexKeyed<'t, C, const BITS: u32> {
    texels: IndexedTexels<'t, C, BITS>,
    key: u8,
}

impl<'t, C: PixelColor, const BITS: u32> IndexKeyed<'t, C, BITS> {
    /// These texels, with those of the index `key` transparent; with an index of 2^`BITS` or more, no texel is.
    pub const fn new(texels: IndexedTexels<'t, C, BITS>, key: u8) -> Self {
        Self { texels, key }
    }
}

impl<C: PixelColor, const BITS: u32> Texels for IndexKeyed<'_, C, BITS> {
    type Color = C;
    type Ink = Option<C>;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.texels.size_bits()
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> Option<C> {
        let index = self.texels.index_at(u, v);
        if index == u32::from(self.key) {
            return None;
        }
        Some(self.texels.color(index))
    }
}

defmt_format!([S, C] ColorKeyed<S, C>, self, "texels, one colour transparent");

defmt_format!(
    [C, const BITS: u32] IndexKeyed<'_, C, BITS>, self,
    "{}, index {=u8} transparent", self.texels, self.key
);
