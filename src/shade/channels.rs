//! Colours as levels of their channels.

use super::Flat;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

/// A colour made of channels, each a number of levels from dark to full: what [`Gouraud`](super::Gouraud)
/// and [`Dithered`](super::Dithered) need of a target.
///
/// Colours are given as `Rgb888` whatever the target. Red, green and blue each become levels of their
/// channel, `value · MAX/255`; greys take the luma of Rec. 601, `(77·red + 150·green + 29·blue)/256`, as
/// `embedded-graphics` does. Neither is rounded to whole levels before the pixel: both are kept to 2⁻¹⁶
/// level.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray4, Rgb565};
/// use pinhole::Channels;
/// assert_eq!(Rgb565::MAX, [31, 63, 31]);
/// assert_eq!(Rgb565::from_channels([31, 0, 1]), Rgb565::new(31, 0, 1));
/// assert!(Gray4::GREY);
/// assert_eq!(Gray4::from_channels([9, 0, 0]), Gray4::new(9));
/// ```
pub trait Channels: PixelColor {
    /// Whether there is one channel, the luma, in place of red, green and blue.
    const GREY: bool;

    /// The highest level of red, green and blue, or of the luma, which comes first.
    const MAX: [u8; 3];

    /// The colour with these levels, none beyond [`MAX`](Self::MAX). Of a grey the first one counts.
    fn from_channels(levels: [u8; 3]) -> Self;
}

macro_rules! rgb {
    ($($colour:ty),*) => {$(
        impl Channels for $colour {
            const GREY: bool = false;
            const MAX: [u8; 3] = [Self::MAX_R, Self::MAX_G, Self::MAX_B];

            #[inline(always)]
            fn from_channels([r, g, b]: [u8; 3]) -> Self {
                Self::new(r, g, b)
            }
        }
    )*};
}

macro_rules! grey {
    ($($colour:ty: $max:literal),*) => {$(
        impl Channels for $colour {
            const GREY: bool = true;
            const MAX: [u8; 3] = [$max, 0, 0];

            #[inline(always)]
            fn from_channels([luma, ..]: [u8; 3]) -> Self {
                Self::new(luma)
            }
        }
    )*};
}

rgb!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);
grey!(Gray2: 3, Gray4: 15, Gray8: 255);

impl Channels for BinaryColor {
    const GREY: bool = true;
    const MAX: [u8; 3] = [1, 0, 0];

    #[inline(always)]
    fn from_channels([luma, ..]: [u8; 3]) -> Self {
        (luma != 0).into()
    }
}

/// A colour in 2⁻¹⁶ levels of the channels of `C`, rounded to nearest: each at most `MAX · 2¹⁶`, below 2²⁴.
#[inline]
pub(super) fn levels<C: Channels>(colour: Flat) -> [i32; 3] {
    let [r, g, b] = colour.0.map(u32::from); // ≤ 255·2⁸
    let [x, y, z] = C::MAX;
    if C::GREY {
        [level(77 * r + 150 * g + 29 * b, x), 0, 0] // weights of 2⁸ in all
    } else {
        [level(r << 8, x), level(g << 8, y), level(b << 8, z)]
    }
}

/// `value · max/255`, rounded to nearest, for values up to 255·2¹⁶.
fn level(value: u32, max: u8) -> i32 {
    let sum = value * u32::from(max) + 127; // < 2³²
                                            // ⌊sum/255⌋ = ⌊sum · ⌈2³⁹/255⌉ / 2³⁹⌋, without a division: a Cortex-M0 has none. (Warren, Hacker's
                                            // Delight, 2nd ed., section 10–9.)
    ((u64::from(sum) * 0x8080_8081) >> 39) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_rounded_to_nearest() {
        for max in [1, 3, 15, 31, 63, 255u8] {
            for value in 0..=255 << 16 {
                // 255 is odd: no ties.
                let wanted = (u64::from(value) * u64::from(max) * 2 + 255) / 510;
                assert_eq!(i64::from(level(value, max)), wanted as i64, "{value} of {max}");
            }
            assert_eq!(level(255 << 16, max), i32::from(max) << 16); // white is white
        }
    }
}
