//! Target colours as levels of red, green and blue, or of luma.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

/// A target's colour type that consists of channels with integer levels. The shaders [`Flat`](super::Flat),
/// [`Gouraud`](super::Gouraud), [`Lit`](super::Lit) and [`Dithered`](super::Dithered), and
/// [`ShadeTable::new`](super::ShadeTable::new), draw in every such type; all colour types of embedded-graphics implement it.
///
/// Shaders take colours as `Rgb888`, whatever the target. Red, green and blue each become a level of their channel,
/// `value · MAX/255`; a grey target gets the luma of Rec. 601, `(77·red + 150·green + 29·blue)/256`, as in `embedded-graphics`.
/// Levels have 16 fractional bits and are rounded to integers once, at the pixel.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray4, Rgb565};
/// use pinhole::Channels;
/// assert_eq!(Rgb565::MAX, [31, 63, 31]);
/// assert_eq!(Rgb565::from_channels([31, 0, 1]), Rgb565::new(31, 0, 1));
/// assert!(Gray4::GRAY);
/// assert_eq!(Gray4::from_channels([9, 0, 0]), Gray4::new(9));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no color channels for shaders to interpolate",
    label = "no `Channels`",
    note = "all color types of embedded-graphics have them; implement `Channels` for your own color type, or return plain colors of `{Self}`"
)]
pub trait Channels: PixelColor {
    /// Whether the colour has one channel, luma, in place of red, green and blue.
    const GRAY: bool;

    /// The highest levels of red, green and blue; of a grey, the first entry is the highest luma.
    const MAX: [u8; 3];

    /// The colour with these levels, each at most [`MAX`](Self::MAX). A grey uses the first level.
    fn from_channels(levels: [u8; 3]) -> Self;
}

macro_rules! rgb {
    ($($color:ty),*) => {$(
        impl Channels for $color {
            const GRAY: bool = false;
            const MAX: [u8; 3] = [Self::MAX_R, Self::MAX_G, Self::MAX_B];

            #[inline(always)]
            fn from_channels([r, g, b]: [u8; 3]) -> Self {
                Self::new(r, g, b)
            }
        }
    )*};
}

macro_rules! grey {
    ($($color:ty: $max:literal),*) => {$(
        impl Channels for $color {
            const GRAY: bool = true;
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
    const GRAY: bool = true;
    const MAX: [u8; 3] = [1, 0, 0];

    #[inline(always)]
    fn from_channels([luma, ..]: [u8; 3]) -> Self {
        (luma != 0).into()
    }
}
