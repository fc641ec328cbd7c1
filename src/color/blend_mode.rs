//! How a colour is mixed with the stored one.

use super::Color;

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

/// Half of the own colour, half of the stored one, by [`Color::half`]: an addition of both colours, where [`Alpha`] multiplies.
///
/// ```
/// use embedded_graphics::pixelcolor::Gray8;
/// use pinhole::color::{BlendMode, Half};
/// assert_eq!(Half.blend(Gray8::new(40), Gray8::new(60)), Gray8::new(50));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Half;

impl<C: Color> BlendMode<C> for Half {
    #[inline(always)]
    fn blend(self, own: C, stored: C) -> C {
        own.half(stored)
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
