//! Translucent sprites: pictures that are mixed with the stored pixels.

use super::source::SpriteSource;
use crate::shading::{BlendMode, Translucent};
use embedded_graphics_core::geometry::Size;

impl<S: SpriteSource, M: BlendMode<S::Color>> SpriteSource for Translucent<S, M> {
    type Color = S::Color;
    const BLENDS: bool = true;

    fn picture_size(&self) -> Size {
        let (picture, _) = self.parts();
        picture.picture_size()
    }

    #[inline(always)]
    fn color_at(&self, column: u32, row: u32) -> Option<S::Color> {
        const { assert!(!S::BLENDS, "this picture is translucent already") };
        let (picture, _) = self.parts();
        picture.color_at(column, row)
    }

    #[inline(always)]
    fn blend(&self, own: S::Color, stored: S::Color) -> S::Color {
        let (_, mode) = self.parts();
        mode.blend(own, stored)
    }

    fn set_depth(&mut self, depth: u16) {
        self.inner_mut().set_depth(depth);
    }
}
