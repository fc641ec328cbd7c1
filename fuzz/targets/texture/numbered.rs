//! Texels that show where they are.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::Texels;

/// A texture of 2^n columns and rows whose colours are their coordinates, 12 bits each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbered(pub(crate) [u32; 2]);

impl Texels for Numbered {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        self.0
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        let both = (u >> 20) << 12 | v >> 20;
        Rgb888::new((both >> 16) as u8, (both >> 8) as u8, both as u8)
    }
}

/// The coordinates that a colour shows, in 2⁻¹² of the texture's sides, rounded down.
pub(crate) fn shown(color: Rgb888) -> [u32; 2] {
    let [r, g, b] = [color.r(), color.g(), color.b()].map(u32::from);
    let both = r << 16 | g << 8 | b;
    [both >> 12, both & 0xfff]
}
