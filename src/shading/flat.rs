//! One colour, finer than a display's.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// A colour that is not rounded to the target's before the pixel: red, green and blue in 1/256 of the
/// steps of `Rgb888`.
///
/// As the ink of a face it gives every pixel the nearest colour of the target, worked out once a face:
/// the same closure serves all [`Channels`](super::Channels). [`dithered`](Self::dithered), it keeps what
/// rounding loses.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
/// use pinhole::Flat;
/// assert_eq!(Flat::from(Rgb888::RED), Flat::lit(Rgb888::RED, 256));
/// assert_ne!(Flat::lit(Rgb888::new(9, 9, 9), 255), Flat::from(Rgb888::new(9, 9, 9))); // 8.96
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Flat(pub(super) [u16; 3]);

impl Flat {
    /// `colour` at `level`/256 of its light, exactly; levels beyond 256 count as 256.
    pub fn lit(colour: Rgb888, level: u16) -> Self {
        // ≤ 255·256.
        Self([colour.r(), colour.g(), colour.b()].map(|channel| u16::from(channel) * level.min(256)))
    }
}

impl From<Rgb888> for Flat {
    fn from(colour: Rgb888) -> Self {
        Self::lit(colour, 256)
    }
}
