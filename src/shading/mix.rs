//! Colours mixed with the colour below them.

use crate::surface::PixelFormat;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

/// A colour that can be mixed with the colour below it: all grey and RGB colours of embedded-graphics.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray8, Rgb565, RgbColor};
/// use pinhole::Mix;
/// assert_eq!(Gray8::new(200).over(Gray8::new(100), 128), Gray8::new(150));
/// assert_eq!(Rgb565::WHITE.over(Rgb565::BLUE, 64), Rgb565::new(8, 16, 31));
/// assert_eq!(Rgb565::WHITE.over(Rgb565::BLUE, 0), Rgb565::BLUE);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be mixed with the color below it",
    label = "no `Mix`",
    note = "all grey and RGB color types of embedded-graphics can; implement `Mix` for your own color type"
)]
pub trait Mix: PixelColor {
    /// `alpha` parts of this colour and 256 − `alpha` parts of the colour `below`, rounded to nearest per channel; `alpha` is
    /// 0 … 256. Colours of 15 and 16 bits round `alpha` to a multiple of 8 first, which is at most 1/64 off.
    #[must_use]
    fn over(self, below: Self, alpha: u16) -> Self;
}

/// One channel of at most 8 bits.
#[inline(always)]
fn channel(own: u8, below: u8, alpha: u16) -> u8 {
    let (own, below, alpha) = (u32::from(own), u32::from(below), u32::from(alpha.min(256)));
    ((own * alpha + below * (256 - alpha) + 128) >> 8) as u8 // at most the larger of the two
}

macro_rules! grey {
    ($($color:ty),*) => {$(
        impl Mix for $color {
            #[inline(always)]
            fn over(self, below: Self, alpha: u16) -> Self {
                Self::new(channel(self.luma(), below.luma(), alpha))
            }
        }
    )*};
}

grey!(Gray2, Gray4, Gray8);

macro_rules! rgb {
    ($($color:ty),*) => {$(
        impl Mix for $color {
            #[inline(always)]
            fn over(self, below: Self, alpha: u16) -> Self {
                Self::new(
                    channel(self.r(), below.r(), alpha),
                    channel(self.g(), below.g(), alpha),
                    channel(self.b(), below.b(), alpha),
                )
            }
        }
    )*};
}

rgb!(Rgb666, Bgr666, Rgb888, Bgr888);

/// Colours of up to 16 bits: the channels are spread over 32 bits with at least 5 free bits above each, so that one product mixes
/// all three.
macro_rules! packed {
    ($($mask:literal, $half:literal: $($color:ty),*;)*) => {$($(
        impl Mix for $color {
            #[inline(always)]
            fn over(self, below: Self, alpha: u16) -> Self {
                // The middle channel in the upper half, both others in the lower one.
                let spread = |color: Self| (color.encode() | color.encode() << 16) & $mask;
                let (own, below, alpha) = (spread(self), spread(below), (u32::from(alpha.min(256)) + 4) >> 3);
                // own · alpha + below · (32 − alpha) + 16 in each channel: at most 63 · 32 + 16 < 2¹¹. The difference wraps,
                // the sum does not.
                let sum = own.wrapping_sub(below).wrapping_mul(alpha).wrapping_add(below << 5).wrapping_add($half);
                let mixed = sum >> 5 & $mask;
                Self::decode((mixed | mixed >> 16) & 0xffff)
            }
        }
    )*)*};
}

packed! {
    0x07e0_f81f, 0x0200_8010: Rgb565, Bgr565;
    0x03e0_7c1f, 0x0200_4010: Rgb555, Bgr555;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounded to nearest, in integers: the error of `mixed` in 1/512 of a level is at most 256.
    fn check(own: u8, below: u8, alpha: u16, mixed: u8) {
        let (own, below, alpha) = (i32::from(own), i32::from(below), i32::from(alpha));
        let error = 256 * i32::from(mixed) - own * alpha - below * (256 - alpha);
        assert!(error.abs() <= 128, "{own} over {below}, {alpha}: {mixed}");
    }

    #[test]
    fn channels_are_mixed_to_nearest() {
        for alpha in 0..=256 {
            for own in 0..16 {
                for below in 0..16 {
                    check(own, below, alpha, Gray4::new(own).over(Gray4::new(below), alpha).luma());
                    let (own, below) = (own * 17, below * 17);
                    check(own, below, alpha, Gray8::new(own).over(Gray8::new(below), alpha).luma());
                    let mixed = Rgb888::new(own, below, 7).over(Rgb888::new(below, own, 250), alpha);
                    check(own, below, alpha, mixed.r());
                    check(below, own, alpha, mixed.g());
                    check(7, 250, alpha, mixed.b());
                }
            }
        }
    }

    #[test]
    fn packed_channels_do_not_touch_each_other() {
        for alpha in 0..=256_u16 {
            let rounded = (alpha + 4) / 8 * 8;
            for i in 0..64_u8 {
                for j in 0..64 {
                    let (own, below) = ([i / 2, j, 31 - i / 2], [j / 2, 63 - i, i / 2]);
                    let [r, g, b] = own;
                    let mixed = Rgb565::new(r, g, b).over(Rgb565::new(below[0], below[1], below[2]), alpha);
                    check(r, below[0], rounded, mixed.r());
                    check(g, below[1], rounded, mixed.g());
                    check(b, below[2], rounded, mixed.b());
                    let mixed =
                        Bgr555::new(r, g / 2, b).over(Bgr555::new(below[0], below[1] / 2, below[2]), alpha);
                    check(r, below[0], rounded, mixed.r());
                    check(g / 2, below[1] / 2, rounded, mixed.g());
                    check(b, below[2], rounded, mixed.b());
                }
            }
        }
    }

    #[test]
    fn nothing_and_all_of_a_colour() {
        let (own, below) = (Rgb666::new(63, 0, 21), Rgb666::new(5, 63, 40));
        assert_eq!((own.over(below, 0), own.over(below, 256), own.over(below, u16::MAX)), (below, own, own));
        assert_eq!(Gray2::new(3).over(Gray2::new(0), 128), Gray2::new(2));
        assert_eq!(Bgr888::WHITE.over(Bgr888::BLACK, 256), Bgr888::WHITE);
        assert_eq!(Bgr565::WHITE.over(Bgr565::BLACK, 255), Bgr565::WHITE);
    }
}
