//! How a colour is mixed with the stored one.

use super::color_type::{each, Color};

/// How the colour of a [`Translucent`](crate::shading::Translucent) face or sprite is mixed with a stored pixel: [`Half`], [`Alpha`], or any function of both
/// colours, such as `|own: Rgb565, stored: Rgb565| stored.emitting(own)`, which adds light.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not mix colors of `{C}`",
    label = "not a `BlendMode<{C}>`",
    note = "use `Half`, `Alpha`, or a closure that takes the shader's color and the stored color, both with their type, and returns a color"
)]
pub trait BlendMode<C>: Copy {
    /// The colour to store in a pixel.
    fn blend(self, own: C, stored: C) -> C;
}

/// The mean of the own colour and the stored one, channel by channel: half of the own one rounded up, plus half of the stored one rounded
/// down, which is within ½ level of the mean. An addition of both colours, where [`Alpha`] multiplies.
///
/// ```
/// use embedded_graphics::pixelcolor::Rgb565;
/// use pinhole::color::{BlendMode, Half};
/// assert_eq!(Half.blend(Rgb565::new(31, 10, 3), Rgb565::new(0, 20, 3)), Rgb565::new(16, 15, 3));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Half;

impl<C: Color> BlendMode<C> for Half {
    #[inline(always)]
    fn blend(self, own: C, stored: C) -> C {
        if C::FORMAT.has_channels() {
            let (own, stored) = (own.to_bits(), stored.to_bits());
            let low = const { C::FORMAT.low() };
            // Half rounded up is the number minus half rounded down. No channel overflows: ⌈max/2⌉ + ⌊max/2⌋ = max.
            return C::from_bits(own.wrapping_sub(own >> 1 & low).wrapping_add(stored >> 1 & low));
        }
        each(own, stored, |own, stored| own - (own >> 1) + (stored >> 1))
    }
}

/// A constant part of the own colour, and the rest of the stored one, by [`Color::mix`].
///
/// ```
/// use embedded_graphics::pixelcolor::Gray8;
/// use pinhole::color::{Alpha, BlendMode};
/// assert_eq!(Alpha::new(8).blend(Gray8::new(200), Gray8::new(100)), Gray8::new(125)); // 8 of 32
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Alpha(u8);

impl Alpha {
    /// A part in 1/32: 0 leaves the stored pixels as they are, 32 is the own colour alone (more counts as 32).
    pub const fn new(alpha: u8) -> Self {
        Self(if alpha < 32 { alpha } else { 32 })
    }
}

impl<C: Color> BlendMode<C> for Alpha {
    #[inline(always)]
    fn blend(self, own: C, stored: C) -> C {
        own.mix(stored, self.0)
    }
}

impl<C, F: Fn(C, C) -> C + Copy> BlendMode<C> for F {
    #[inline(always)]
    fn blend(self, own: C, stored: C) -> C {
        self(own, stored)
    }
}
