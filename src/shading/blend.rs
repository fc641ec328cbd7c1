//! Colours that can be mixed with stored ones.

use crate::math::hints::opaque;
use crate::surface::PixelFormat;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888,
};

/// A colour type whose colours can be mixed channel by channel, for [`Translucent`](crate::Translucent)
/// faces and [`AntiAliased`](crate::AntiAliased) lines. All colour types of embedded-graphics implement it; channels
/// are mixed side by side in one word, without a division.
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
    /// Shares of [`mixer`](Self::mixer) are in 2^−`SHARE_BITS`.
    #[doc(hidden)]
    const SHARE_BITS: u32 = 8;

    /// The mean of this colour and `stored`, channel by channel: half of this one rounded up, plus half of the stored one rounded
    /// down, which is within ½ level of the mean.
    #[must_use]
    fn half(self, stored: Self) -> Self;

    /// `alpha` 32nds of this colour plus the rest of `stored`, channel by channel, rounded to the nearest level, and up where two
    /// are equally near. `alpha` is 0 … 32; more gives a meaningless colour.
    #[must_use]
    fn mix(self, stored: Self, alpha: u8) -> Self;

    /// `coverage` 256ths of this colour plus the rest of `stored`, channel by channel, rounded to the nearest level. `coverage`
    /// is 0 … 256; more gives a meaningless colour. Colours of 15 and 16 bits first round `coverage` to 1/32, which is at most
    /// 1/64 off, and so does this default for a colour type of your own.
    #[must_use]
    #[inline(always)]
    fn over(self, stored: Self, coverage: u16) -> Self {
        self.mix(stored, (coverage.wrapping_add(4) >> 3) as u8)
    }

    /// A function of `alpha`, 0 … 32, that [mixes](Self::mix) this colour with another one: what depends only on the two colours
    /// is computed once.
    #[must_use]
    #[doc(hidden)]
    #[inline(always)]
    fn fade(self, other: Self) -> impl Fn(u8) -> Self + Copy {
        move |alpha| self.mix(other, alpha)
    }

    /// [`over`](Self::over) as a function for loops. Its arguments are the stored colour and its share, the part that this colour
    /// does not cover.
    #[must_use]
    #[doc(hidden)]
    #[inline(always)]
    fn mixer(self) -> impl Fn(Self, u32) -> Self + Copy {
        move |stored, rest| self.over(stored, 256_u32.wrapping_sub(rest) as u16)
        // 0 … 256
    }
}

/// The mean of packed channels. `low` has all bits of the channels except the highest bit of each, into which a right shift by 1
/// moves a bit of the channel above.
#[inline(always)]
const fn half(own: u32, stored: u32, low: u32) -> u32 {
    // Half rounded up is the number minus half rounded down. No channel overflows: ⌈max/2⌉ + ⌊max/2⌋ = max.
    own.wrapping_sub(own >> 1 & low).wrapping_add(stored >> 1 & low)
}

/// Mixes channels that have at least `bits` free bits above each: `share` parts of 2^`bits`, 5 or 8, of one colour, and the rest of
/// the other. `all`: the bits of the channels; `lowest`: the lowest bit of each.
#[inline(always)]
const fn mix(own: u32, stored: u32, share: u32, bits: u32, all: u32, lowest: u32) -> u32 {
    // A channel below 2^n becomes at most 2^bits·(2^n − 1) + 2^(bits − 1) < 2^(n + bits).
    let own = (own & all).wrapping_mul(share).wrapping_add(lowest << (bits - 1));
    (own.wrapping_add((stored & all).wrapping_mul((1u32 << bits).wrapping_sub(share))) >> bits) & all
}

/// Formats of 15 and 16 bits: the channel in the middle is moved up by 16 bits, so that all have room above.
macro_rules! blend_16 {
    ($($color:ty: $low:literal, $spread:literal, $lowest:expr;)*) => {$(
        impl Blend for $color {
            const SHARE_BITS: u32 = 5;

            #[inline(always)]
            fn half(self, stored: Self) -> Self {
                Self::decode(half(self.encode(), stored.encode(), $low))
            }

            #[inline(always)]
            fn mix(self, stored: Self, alpha: u8) -> Self {
                let spread = |bits: u32| bits | bits << 16;
                let mixed = mix(spread(self.encode()), spread(stored.encode()), alpha.into(), 5, $spread, $lowest);
                Self::decode((mixed | mixed >> 16) & 0xffff)
            }

            #[inline(always)]
            fn fade(self, other: Self) -> impl Fn(u8) -> Self + Copy {
                let spread = |color: Self| (color.encode() | color.encode() << 16) & $spread;
                let (own, other) = (spread(self), spread(other));
                // `mix` by one product: modulo 2³², own·a + other·(32 − a) = 32·other + (own − other)·a.
                let (none, step) = ((other << 5).wrapping_add($lowest << 4), own.wrapping_sub(other));
                move |alpha| {
                    let mixed = none.wrapping_add(step.wrapping_mul(alpha.into())) >> 5 & $spread;
                    Self::decode((mixed | mixed >> 16) & 0xffff)
                }
            }

            #[inline(always)]
            fn mixer(self) -> impl Fn(Self, u32) -> Self + Copy {
                // Hidden from LLVM, which would make two masks of it and load each again where registers are few.
                let all = opaque($spread);
                let spread = |color: Self| color.encode() | color.encode() << 16;
                let own = spread(self) & $spread;
                let all_own = (own << 5) + ($lowest << 4);
                move |stored, rest| {
                    // `mix` by one product: own·(32 − rest) + stored·rest = 32·own + (stored − own)·rest modulo 2³².
                    let sum = all_own.wrapping_add((spread(stored) & all).wrapping_sub(own).wrapping_mul(rest));
                    let mixed = sum >> 5 & all;
                    Self::decode((mixed | mixed >> 16) & 0xffff)
                }
            }
        }
    )*};
}

blend_16! {
    Rgb565: 0x7bef, 0x07e0_f81f, 1 | 1 << 11 | 1 << 21;
    Bgr565: 0x7bef, 0x07e0_f81f, 1 | 1 << 11 | 1 << 21;
    Rgb555: 0x3def, 0x03e0_7c1f, 1 | 1 << 10 | 1 << 21;
    Bgr555: 0x3def, 0x03e0_7c1f, 1 | 1 << 10 | 1 << 21;
}

/// [`mix`] for three channels of at most 8 bits in a byte each; `outer`: the bits of the first and the last one.
#[inline(always)]
const fn mix_24(own: u32, stored: u32, share: u32, bits: u32, outer: u32) -> u32 {
    let middle = mix(own, stored, share, bits, (outer & 0xff) << 8, 1 << 8);
    mix(own, stored, share, bits, outer, 1 | 1 << 16) | middle
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
                Self::decode(mix_24(own, stored, alpha.into(), 5, $outer) << $down)
            }

            #[inline(always)]
            fn over(self, stored: Self, coverage: u16) -> Self {
                let (own, stored) = (self.encode() >> $down, stored.encode() >> $down);
                Self::decode(mix_24(own, stored, coverage.into(), 8, $outer) << $down)
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
                Self::decode(mix(self.encode(), stored.encode(), alpha.into(), 5, $max, 1))
            }

            #[inline(always)]
            fn over(self, stored: Self, coverage: u16) -> Self {
                Self::decode(mix(self.encode(), stored.encode(), coverage.into(), 8, $max, 1))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use embedded_graphics_core::pixelcolor::{GrayColor, RgbColor};

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
                    assert_eq!(
                        mixed,
                        Rgb888::new(own, below, 7).mixer()(
                            Rgb888::new(below, own, 250),
                            256 - u32::from(alpha)
                        )
                    );
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
                    let stored = Rgb565::new(below[0], below[1], below[2]);
                    assert_eq!(mixed, Rgb565::new(r, g, b).mixer()(stored, 32 - u32::from(rounded / 8)));
                    check(r, below[0], rounded, mixed.r());
                    check(g, below[1], rounded, mixed.g());
                    check(b, below[2], rounded, mixed.b());
                    let mixed =
                        Bgr555::new(r, g / 2, b).over(Bgr555::new(below[0], below[1] / 2, below[2]), alpha);
                    check(r, below[0], rounded, mixed.r());
                    check(g / 2, below[1] / 2, rounded, mixed.g());
                    check(b, below[2], rounded, mixed.b());
                    let stored = Bgr555::new(below[0], below[1] / 2, below[2]);
                    assert_eq!(mixed, Bgr555::new(r, g / 2, b).mixer()(stored, 32 - u32::from(rounded / 8)));
                }
            }
        }
    }

    /// `fade` equals `mix` for every alpha: for every pair of levels of six bits, at each bit of a colour, and for random pairs
    /// of colours.
    fn check_fade<C: Blend + PixelFormat + core::fmt::Debug>() {
        let mut random = Random(5);
        let check = |own: u32, other: u32| {
            let (own, other) = (C::decode(own), C::decode(other));
            let fade = own.fade(other);
            for alpha in 0..=32 {
                assert_eq!(fade(alpha), own.mix(other, alpha), "{own:?} {other:?} {alpha}");
            }
        };
        for own in 0..64 {
            for other in 0..64 {
                for bit in 0..C::BITS {
                    let rest = random.bits() & !(63 << bit);
                    check(rest | own << bit, !rest & !(63 << bit) | other << bit);
                }
                check(random.bits(), random.bits());
            }
        }
    }

    #[test]
    fn colours_fade_as_they_are_mixed() {
        check_fade::<BinaryColor>();
        check_fade::<Gray2>();
        check_fade::<Gray4>();
        check_fade::<Gray8>();
        check_fade::<Rgb555>();
        check_fade::<Bgr555>();
        check_fade::<Rgb565>();
        check_fade::<Bgr565>();
        check_fade::<Rgb666>();
        check_fade::<Bgr666>();
        check_fade::<Rgb888>();
        check_fade::<Bgr888>();
    }

    #[test]
    fn nothing_and_all_of_a_colour() {
        let (own, below) = (Rgb666::new(63, 0, 21), Rgb666::new(5, 63, 40));
        assert_eq!((own.over(below, 0), own.over(below, 256)), (below, own));
        assert_eq!(Gray2::new(3).over(Gray2::new(0), 128), Gray2::new(2));
        assert_eq!(Bgr888::WHITE.over(Bgr888::BLACK, 256), Bgr888::WHITE);
        assert_eq!(Bgr565::WHITE.over(Bgr565::BLACK, 255), Bgr565::WHITE);
    }
}
