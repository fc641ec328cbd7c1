//! Dimmed colours.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb555, Rgb565,
    Rgb666, Rgb888, RgbColor,
};

/// A target's colour type that can be dimmed by a light level, and to which light that a face emits can be added: the cheapest way
/// to light flat faces.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
/// use pinhole::Dim;
/// assert_eq!(Rgb565::WHITE.dim(256), Rgb565::WHITE);
/// assert_eq!(Rgb565::WHITE.dim(128), Rgb565::new(16, 32, 16));
/// assert_eq!(Rgb565::WHITE.dim(0), Rgb565::BLACK);
/// assert_eq!(Rgb565::WHITE.dim(128).emitting(Rgb565::RED), Rgb565::new(31, 32, 16));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be dimmed",
    label = "no `Dim`",
    note = "all color types of embedded-graphics can; implement `Dim` for your own color type"
)]
pub trait Dim: PixelColor {
    /// This colour times `level`/256, each channel rounded to nearest, ties up; levels above 256 count as 256. A `BinaryColor`
    /// is off below level 128, otherwise unchanged.
    #[must_use]
    fn dim(self, level: u16) -> Self;

    /// This colour plus `emission`, each channel saturating at full: for faces that emit light of their own, after
    /// [`dim`](Self::dim). A `BinaryColor` is on if either colour is.
    #[must_use]
    fn emitting(self, emission: Self) -> Self;
}

/// `channel · level / 256`, rounded to nearest: at most the channel.
fn dimmed(channel: u8, level: u16) -> u8 {
    // 255 · 256 + 128 fits 17 bits.
    ((u32::from(channel) * u32::from(level.min(256)) + 128) >> 8) as u8
}

macro_rules! dim_rgb {
    ($($color:ty),*) => {$(
        impl Dim for $color {
            fn dim(self, level: u16) -> Self {
                Self::new(dimmed(self.r(), level), dimmed(self.g(), level), dimmed(self.b(), level))
            }

            fn emitting(self, emission: Self) -> Self {
                let sum = |own: u8, emission: u8, max: u8| own.saturating_add(emission).min(max);
                Self::new(
                    sum(self.r(), emission.r(), Self::MAX_R),
                    sum(self.g(), emission.g(), Self::MAX_G),
                    sum(self.b(), emission.b(), Self::MAX_B),
                )
            }
        }
    )*};
}

macro_rules! dim_gray {
    ($($color:ty),*) => {$(
        impl Dim for $color {
            fn dim(self, level: u16) -> Self {
                Self::new(dimmed(self.luma(), level))
            }

            fn emitting(self, emission: Self) -> Self {
                Self::new(self.luma().saturating_add(emission.luma()).min(Self::WHITE.luma()))
            }
        }
    )*};
}

dim_rgb!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);
dim_gray!(Gray2, Gray4, Gray8);

/// One bit has no shades: below level 128 it is off.
impl Dim for BinaryColor {
    fn dim(self, level: u16) -> Self {
        if level >= 128 {
            self
        } else {
            Self::Off
        }
    }

    fn emitting(self, emission: Self) -> Self {
        match self {
            Self::On => self,
            Self::Off => emission,
        }
    }
}
