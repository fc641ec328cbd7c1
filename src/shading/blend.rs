//! Colors that can be mixed with stored ones.

use crate::surface::PixelFormat;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888,
};

/// A color type whose colors can be mixed channel by channel, for [`HalfBlended`](crate::HalfBlended) and
/// [`Blended`](crate::Blended). All color types of embedded-graphics implement it; channels are mixed
/// side by side in one word, without a division.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray8, Rgb565};
/// use pinhole::Blend;
/// assert_eq!(Rgb565::new(31, 10, 3).half(Rgb565::new(0, 20, 3)), Rgb565::new(16, 15, 3));
/// assert_eq!(Rgb565::new(31, 0, 8).mix(Rgb565::new(0, 63, 8), 8), Rgb565::new(8, 47, 8)); // 7.75, 47.25, 8
/// assert_eq!(Gray8::new(200).mix(Gray8::new(100), 32), Gray8::new(200));
/// ```
#[diagnostic::on_unimplemented(
    message = "colors of `{Self}` cannot be mixed",
    label = "no `Blend`",
    note = "all color types of embedded-graphics can be mixed; implement `Blend` for your own color type"
)]
pub trait Blend: PixelColor {
    /// The mean of this color and `stored`, channel by channel: half of this one rounded up, plus half of the stored one rounded
    /// down, which is within ½ level of the mean.
    #[must_use]
    fn half(self, stored: Self) -> Self;

    /// `alpha` 32nds of this color plus the rest of `stored`, channel by channel, rounded to the nearest level, and up where two
    /// are equally near. `alpha` is 0 … 32; more gives a color without meaning.
    #[must_use]
    fn mix(self, stored: Self, alpha: u8) -> Self;
}

/// The shares of 32 of a color and of the stored one.
#[inline(always)]
const fn shares(alpha: u8) -> [u32; 2] {
    [alpha as u32, 32u32.wrapping_sub(alpha as u32)]
}

/// The mean of packed channels. `low`: all bits of all channels but their highest ones, which a right shift by 1 leaves alone.
#[inline(always)]
const fn half(own: u32, stored: u32, low: u32) -> u32 {
    // Half rounded up is the number minus half rounded down. No channel overflows: ⌈max/2⌉ + ⌊max/2⌋ = max.
    own.wrapping_sub(own >> 1 & low).wrapping_add(stored >> 1 & low)
}

/// Mixes channels that have five free bits above each. `all`: the bits of the channels; `round`: 16 in each.
#[inline(always)]
const fn mix(own: u32, stored: u32, alpha: u8, all: u32, round: u32) -> u32 {
    // A channel below 2^n becomes at most 32·(2^n − 1) + 16 < 2^(n + 5).
    let [a, b] = shares(alpha);
    let own = (own & all).wrapping_mul(a).wrapping_add(round);
    (own.wrapping_add((stored & all).wrapping_mul(b)) >> 5) & all
}

/// Formats of 15 and 16 bits: the channel in the middle is moved up by 16 bits, so that all have room above.
macro_rules! blend_16 {
    ($($color:ty: $low:literal, $spread:literal, $round:expr;)*) => {$(
        impl Blend for $color {
            #[inline(always)]
            fn half(self, stored: Self) -> Self {
                Self::decode(half(self.encode(), stored.encode(), $low))
            }

            #[inline(always)]
            fn mix(self, stored: Self, alpha: u8) -> Self {
                let spread = |bits: u32| bits | bits << 16;
                let mixed = mix(spread(self.encode()), spread(stored.encode()), alpha, $spread, $round);
                Self::decode((mixed | mixed >> 16) & 0xffff)
            }
        }
    )*};
}

blend_16! {
    Rgb565: 0x7bef, 0x07e0_f81f, 16 | 16 << 11 | 16 << 21;
    Bgr565: 0x7bef, 0x07e0_f81f, 16 | 16 << 11 | 16 << 21;
    Rgb555: 0x3def, 0x03e0_7c1f, 16 | 16 << 10 | 16 << 21;
    Bgr555: 0x3def, 0x03e0_7c1f, 16 | 16 << 10 | 16 << 21;
}

/// Formats of three bytes: the outer channels are mixed in one word, the middle one in another. `down`: the free bits at the lower
/// end of each byte.
macro_rules! blend_24 {
    ($($color:ty: $down:literal, $low:literal, $outer:literal;)*) => {$(
        impl Blend for $color {
            #[inline(always)]
            fn half(self, stored: Self) -> Self {
                Self::decode(half(self.encode() >> $down, stored.encode() >> $down, $low) << $down)
            }

            #[inline(always)]
            fn mix(self, stored: Self, alpha: u8) -> Self {
                let (own, stored) = (self.encode() >> $down, stored.encode() >> $down);
                let outer = mix(own, stored, alpha, $outer, 16 | 16 << 16);
                let middle = mix(own, stored, alpha, ($outer & 0xff) << 8, 16 << 8);
                Self::decode((outer | middle) << $down)
            }
        }
    )*};
}

blend_24! {
    Rgb888: 0, 0x7f_7f7f, 0xff_00ff;
    Bgr888: 0, 0x7f_7f7f, 0xff_00ff;
    Rgb666: 2, 0x1f_1f1f, 0x3f_003f;
    Bgr666: 2, 0x1f_1f1f, 0x3f_003f;
}

macro_rules! blend_gray {
    ($($color:ty: $max:literal;)*) => {$(
        impl Blend for $color {
            #[inline(always)]
            fn half(self, stored: Self) -> Self {
                Self::decode(half(self.encode(), stored.encode(), $max >> 1))
            }

            #[inline(always)]
            fn mix(self, stored: Self, alpha: u8) -> Self {
                Self::decode(mix(self.encode(), stored.encode(), alpha, $max, 16))
            }
        }
    )*};
}

blend_gray! {
    BinaryColor: 1;
    Gray2: 3;
    Gray4: 15;
    Gray8: 255;
}
