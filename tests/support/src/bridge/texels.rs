//! Textures that show the coordinates which the library looks up.

use embedded_graphics_core::pixelcolor::{raw::RawU32, PixelColor};
use pinhole::texture::Texels;

/// The coordinates that a pixel shows, in 2⁻³² of the texture's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub [u32; 2]);

impl PixelColor for Shown {
    type Raw = RawU32;
}

/// Texels of 2^n columns and rows that show their coordinates.
#[derive(Clone, Copy)]
pub struct Numbered(pub [u32; 2]);

impl Texels for Numbered {
    type Color = Shown;
    type Ink = Shown;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        self.0
    }

    fn texel(&self, u: u32, v: u32) -> Shown {
        Shown([u, v])
    }
}
