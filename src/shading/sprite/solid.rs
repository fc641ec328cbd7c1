//! One colour as the picture of a sprite.

use super::source::SpriteSource;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::PixelColor;

/// A picture of one texel, for squares and rectangles of one colour: what [`Sprite::square`](crate::sprite::Sprite::square) makes.
///
/// ```
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
/// use pinhole::sprite::{SolidTexel, SpriteSource};
/// assert_eq!(SolidTexel::new(Rgb565::RED).picture_size(), Size::new(1, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SolidTexel<C>(C);

impl<C> SolidTexel<C> {
    /// A texel of one colour.
    pub const fn new(color: C) -> Self {
        Self(color)
    }
}

impl<C: PixelColor> SpriteSource for SolidTexel<C> {
    type Color = C;
    type Ink = C;

    fn picture_size(&self) -> Size {
        Size::new(1, 1)
    }

    #[inline(always)]
    fn texel_at(&self, _: u32, _: u32) -> C {
        self.0
    }

    #[inline(always)]
    fn solid_texel(&self) -> Option<C> {
        Some(self.0)
    }
}
