//! Translucent sprites: pictures that are mixed with the stored pixels.

use super::source::SpriteSource;
use crate::color::{BlendMode, Unmixed};
use crate::shading::Translucent;
use embedded_graphics_core::geometry::Size;

impl<S: SpriteSource<Ink: Unmixed<S::Color>>, M: BlendMode<S::Color>> SpriteSource for Translucent<S, M> {
    type Color = S::Color;
    type Ink = <S::Ink as Unmixed<S::Color>>::Mixed<M>;

    fn picture_size(&self) -> Size {
        let (picture, _) = self.parts();
        picture.picture_size()
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> Self::Ink {
        let (picture, mode) = self.parts();
        picture.texel_at(column, row).mixed(*mode)
    }

    fn set_depth(&mut self, depth: u16) {
        self.inner_mut().set_depth(depth);
    }
}
