//! Texels of which one colour is transparent.

use super::texels::Texels;
use crate::color::InkKind;

/// Texels of which one colour is transparent, as magenta often is in sprites: a pixel that would show it is left out, and its
/// depth is not stored. Wraps every source of [`Texels`]; for one index of [`IndexedTexels`](crate::texture::IndexedTexels), the key is a
/// colour that no other index of the palette has.
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
    type FastPath = ();
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

defmt_format!([S, C] ColorKeyed<S, C>, self, "texels, one colour transparent");
