//! Textured faces: every size and format, repeated and clamped, keyed and lit.
//!
//! - A pixel shows the coordinates of a ray, within the documented bound, up to the ends of `i16` and with w in a ratio of 65536.
//! - Memory, other targets and bands of any height show equal pixels, with a depth buffer and without.
//! - Every format shows the texel at these coordinates; a transparent texel leaves its pixel and its depth alone; light is that of a
//!   shade table.

mod formats;
mod rays;

use super::Bytes;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::texture::Texels;

/// A texture of 2^n columns and rows whose colours are their coordinates, 12 bits each.
#[derive(Clone, Copy, Debug)]
struct Numbered([u32; 2]);

impl Texels for Numbered {
    type Color = Rgb888;
    type Ink = Rgb888;
    type FastPath = ();

    fn size_bits(&self) -> [u32; 2] {
        self.0
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        let both = (u >> 20) << 12 | v >> 20;
        Rgb888::new((both >> 16) as u8, (both >> 8) as u8, both as u8)
    }
}

/// The coordinates that a colour shows, in 2⁻¹² of the texture's sides, rounded down.
fn shown(color: Rgb888) -> [u32; 2] {
    let [r, g, b] = [color.r(), color.g(), color.b()].map(u32::from);
    let both = r << 16 | g << 8 | b;
    [both >> 12, both & 0xfff]
}

pub(super) fn check(data: &[u8]) {
    let mut b = Bytes::new(data);
    match b.byte() & 1 {
        0 => rays::check(&mut b),
        _ => formats::check(data.get(1..).unwrap_or_default()),
    }
}
