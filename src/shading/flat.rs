//! One colour, in finer steps than the target's.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// One colour for a face, with red, green and blue in 1/256 of the steps of `Rgb888`.
///
/// As a shader it fills a face with the nearest colour of the target, computed once per face. The target may have any colour
/// type with [`Color`](crate::color::Color), so one closure works for all of them. [`dithered`](Self::dithered) also shows the
/// fraction that rounding drops.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
/// use pinhole::shading::Flat;
/// assert_eq!(Flat::from(Rgb888::RED), Flat::lit(Rgb888::RED, 256));
/// assert_ne!(Flat::lit(Rgb888::new(9, 9, 9), 255), Flat::from(Rgb888::new(9, 9, 9))); // 8.96
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Flat(pub(super) [u16; 3]);

impl Flat {
    /// `color` times `level`/256, exact with its 8 fractional bits; levels above 256 count as 256.
    pub fn lit(color: Rgb888, level: u16) -> Self {
        // ≤ 255·256.
        Self([color.r(), color.g(), color.b()].map(|channel| u16::from(channel) * level.min(256)))
    }
}

impl From<Rgb888> for Flat {
    fn from(color: Rgb888) -> Self {
        Self::lit(color, 256)
    }
}
