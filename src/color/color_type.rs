//! The trait of a target's colour type.

use super::format::Words;
use super::Format;
use embedded_graphics_core::pixelcolor::raw::{RawData, RawU1, RawU16, RawU2, RawU24, RawU4, RawU8};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

/// A colour type of targets. Light, interpolated colours, translucent faces, anti-aliased lines, bands and pixels in bytes draw in every
/// such type; plain colours need only embedded-graphics' `PixelColor`. All colour types of embedded-graphics implement it.
///
/// A colour type of your own says where its channels lie; the rest is computed from that:
///
/// ```
/// use embedded_graphics::pixelcolor::PixelColor;
/// use pinhole::color::{Color, Format};
/// /// Four bits each of red, green and blue: two pixels in three bytes, as many TFT controllers take them.
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Rgb444(u16);
/// impl PixelColor for Rgb444 {
///     type Raw = ();
/// }
/// impl Color for Rgb444 {
///     const FORMAT: Format = Format::rgb(4, 4, 4);
///     fn to_bits(self) -> u32 {
///         self.0.into()
///     }
///     fn from_bits(bits: u32) -> Self {
///         Self(bits as u16)
///     }
/// }
/// assert_eq!(Rgb444(0xf80).dim(128), Rgb444(0x840));
/// assert_eq!(Rgb444(0xf0f).mix(Rgb444(0x00f), 16), Rgb444(0x80f));
/// ```
///
/// Its `Raw` is `()`, as 12 bits are no whole bytes: in bands, draw into the [`Band`](crate::bands::Band) itself, not into its `pixels()`, which
/// does not build. Two such pixels, 0xABC and 0xDEF, are the bytes AB CD EF.
///
/// Shaders take colours as `Rgb888`, whatever the target; a plain colour in place of a shader has the target's type
/// ([`Flat`](crate::shading::Flat) of an `Rgb888` has any). Generic code asks for `DrawTarget<Color: Color>`. Red, green and blue each become a level of their channel,
/// `value · max/255`; a grey target gets the luma of Rec. 601, `(77·red + 150·green + 29·blue)/256`, as in `embedded-graphics`.
/// Levels have 16 fractional bits and are rounded to integers once, at the pixel.
///
/// In bands ([`Frame`](crate::bands::Frame)) pixels lie as a display takes them: the most significant bit first; several pixels to a byte where they
/// fit, the leftmost in the upper bits; each row begins with a new byte. A controller
/// that takes pixels as one stream of bits needs rows of whole bytes: areas of an even width for 12 bits.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no color channels that pinhole knows",
    label = "no `Color`",
    note = "all color types of embedded-graphics implement `Color`; implement it for your own: a `Format` and its bits"
)]
pub trait Color: PixelColor {
    /// Where the channels lie in the bits. In bands a pixel has 1, 2, 4, 8, 12, 16, 24 or 32 bits; others do not compile there.
    const FORMAT: Format;

    /// The colour's bits: the lowest ones, as many as the [`FORMAT`](Self::FORMAT) has, and zeros above.
    fn to_bits(self) -> u32;

    /// The colour with these bits: the inverse of [`to_bits`](Self::to_bits). Higher bits are ignored.
    fn from_bits(bits: u32) -> Self;

    /// The levels of red, green and blue, or luma and two zeros.
    ///
    /// Implement it, with [`from_channels`](Self::from_channels), for a [`Format::indexed`] colour, whose bits are no channels.
    #[inline(always)]
    fn channels(self) -> [u8; 3] {
        const {
            assert!(
                Self::FORMAT.has_channels(),
                "a color with `Format::indexed` implements `channels` itself"
            )
        };
        Self::FORMAT.unpack(self.to_bits())
    }

    /// The colour with these levels, each at most [`Format::max`]. A grey uses the first one.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray4, Rgb565};
    /// use pinhole::color::Color;
    /// assert_eq!(Rgb565::from_channels([31, 0, 1]), Rgb565::new(31, 0, 1));
    /// assert_eq!(Gray4::from_channels([9, 0, 0]), Gray4::new(9));
    /// ```
    #[inline(always)]
    fn from_channels(levels: [u8; 3]) -> Self {
        const {
            assert!(
                Self::FORMAT.has_channels(),
                "a color with `Format::indexed` implements `from_channels` itself"
            )
        };
        Self::from_bits(Self::FORMAT.pack(levels))
    }

    /// This colour times `level`/256, each channel rounded to nearest, ties up; levels above 256 count as 256. The cheapest way to light
    /// flat faces. A `BinaryColor` is off below level 128, otherwise unchanged.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
    /// use pinhole::color::Color;
    /// assert_eq!(Rgb565::WHITE.dim(256), Rgb565::WHITE);
    /// assert_eq!(Rgb565::WHITE.dim(128), Rgb565::new(16, 32, 16));
    /// assert_eq!(Rgb565::WHITE.dim(0), Rgb565::BLACK);
    /// ```
    #[must_use]
    fn dim(self, level: u16) -> Self {
        let level = u32::from(level.min(256));
        // 255 · 256 + 128 fits 17 bits; the result is at most the channel.
        let [r, g, b] = self.channels().map(|channel| ((u32::from(channel) * level + 128) >> 8) as u8);
        Self::from_channels([r, g, b])
    }

    /// This colour plus `emission`, each channel saturating at full: for faces that emit light of their own, after
    /// [`dim`](Self::dim).
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
    /// use pinhole::color::Color;
    /// assert_eq!(Rgb565::WHITE.dim(128).emitting(Rgb565::RED), Rgb565::new(31, 32, 16));
    /// ```
    #[must_use]
    fn emitting(self, emission: Self) -> Self {
        let ([r, g, b], [s, t, u], [x, y, z]) = (self.channels(), emission.channels(), Self::FORMAT.max());
        let sum = |own: u8, emission: u8, max: u8| own.saturating_add(emission).min(max);
        Self::from_channels([sum(r, s, x), sum(g, t, y), sum(b, u, z)])
    }

    /// `alpha` 32nds of this colour plus the rest of `stored`, channel by channel, rounded to the nearest level, and up where two
    /// are equally near. `alpha` is 0 … 32; more gives a meaningless colour. Channels are mixed side by side in words, without a division.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray8, Rgb565};
    /// use pinhole::color::Color;
    /// assert_eq!(Rgb565::new(31, 0, 8).mix(Rgb565::new(0, 63, 8), 8), Rgb565::new(8, 47, 8)); // 7.75, 47.25, 8
    /// assert_eq!(Gray8::new(200).mix(Gray8::new(100), 32), Gray8::new(200));
    /// ```
    #[must_use]
    #[inline(always)]
    fn mix(self, stored: Self, alpha: u8) -> Self {
        mixed(self, stored, alpha.into(), 5)
    }

    /// `coverage` 256ths of this colour plus the rest of `stored`, channel by channel, rounded to the nearest level. `coverage`
    /// is 0 … 256; more gives a meaningless colour. Three channels of at most 16 bits are mixed in one word if they leave room there, as those of
    /// all colours of 15 and 16 bits in embedded-graphics do: then `coverage` is first rounded to 1/32, which is at most 1/64 off.
    #[must_use]
    #[inline(always)]
    fn over(self, stored: Self, coverage: u16) -> Self {
        match const { Self::FORMAT.words() }.is_spread {
            true => self.mix(stored, (coverage.wrapping_add(4) >> 3) as u8),
            false => mixed(self, stored, coverage.into(), 8),
        }
    }
}

/// Applies a function to each pair of channels.
#[inline(always)]
pub(super) fn each<C: Color>(own: C, stored: C, mix: impl Fn(u32, u32) -> u32) -> C {
    let ([r, g, b], [s, t, u]) = (own.channels(), stored.channels());
    C::from_channels([(r, s), (g, t), (b, u)].map(|(own, stored)| mix(own.into(), stored.into()) as u8))
}

/// `share` parts of 2^`bits` of one colour, and the rest of the other.
#[inline(always)]
fn mixed<C: Color>(own: C, stored: C, share: u32, bits: u32) -> C {
    if !C::FORMAT.has_channels() {
        let rest = (1u32 << bits).wrapping_sub(share);
        let half = 1 << (bits - 1);
        return each(own, stored, |own, stored| {
            own.wrapping_mul(share).wrapping_add(stored.wrapping_mul(rest)).wrapping_add(half) >> bits
        });
    }
    let Words { is_spread, words: [first, second, third] } = const { C::FORMAT.words() };
    let (own, stored) = (own.to_bits(), stored.to_bits());
    if is_spread {
        let spread = |bits: u32| bits | bits << 16;
        let mixed = first.mix(spread(own), spread(stored), share, bits);
        return C::from_bits((mixed | mixed >> 16) & 0xffff);
    }
    let [first, second, third] = [first, second, third].map(|word| word.mix(own, stored, share, bits));
    C::from_bits(first | second | third)
}

macro_rules! color {
    ($($color:ty: $format:expr, $raw:ty;)*) => {$(
        impl Color for $color {
            const FORMAT: Format = $format;

            #[inline(always)]
            fn to_bits(self) -> u32 {
                <$raw>::from(self).into_inner().into()
            }

            #[inline(always)]
            fn from_bits(bits: u32) -> Self {
                <$raw>::from_u32(bits).into()
            }
        }
    )*};
}

color! {
    BinaryColor: Format::gray(1), RawU1;
    Gray2: Format::gray(2), RawU2;
    Gray4: Format::gray(4), RawU4;
    Gray8: Format::gray(8), RawU8;
    Rgb555: Format::rgb(5, 5, 5).padded_to(16), RawU16;
    Bgr555: Format::bgr(5, 5, 5).padded_to(16), RawU16;
    Rgb565: Format::rgb(5, 6, 5), RawU16;
    Bgr565: Format::bgr(5, 6, 5), RawU16;
    Rgb888: Format::rgb(8, 8, 8), RawU24;
    Bgr888: Format::bgr(8, 8, 8), RawU24;
}

/// Display controllers take an 18-bit colour as three bytes, each channel in the upper six bits of its byte.
macro_rules! color_in_bytes {
    ($($color:ty: $format:expr;)*) => {$(
        impl Color for $color {
            const FORMAT: Format = $format.in_bytes();

            #[inline(always)]
            fn to_bits(self) -> u32 {
                Self::FORMAT.pack([self.r(), self.g(), self.b()])
            }

            #[inline(always)]
            fn from_bits(bits: u32) -> Self {
                let [r, g, b] = Self::FORMAT.unpack(bits);
                Self::new(r, g, b)
            }
        }
    )*};
}

color_in_bytes! {
    Rgb666: Format::rgb(6, 6, 6);
    Bgr666: Format::bgr(6, 6, 6);
}
