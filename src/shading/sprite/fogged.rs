//! Sprites in fog.

use super::source::SpriteSource;
use crate::color::{Color, Ink};
use crate::shading::Fogged;
use embedded_graphics_core::geometry::Size;

impl<C: Color, S: SpriteSource<Color = C>> SpriteSource for Fogged<'_, S, C> {
    type Color = C;
    type Ink = S::Ink;

    fn picture_size(&self) -> Size {
        self.inner().picture_size()
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> S::Ink {
        self.inner().texel_at(column, row).map(|color| self.in_nearest_level(color))
    }

    #[inline(always)]
    fn solid_texel(&self) -> Option<S::Ink> {
        Some(self.inner().solid_texel()?.map(|color| self.in_nearest_level(color)))
    }

    fn set_depth(&mut self, depth: u16) {
        self.set_level_of(depth).set_depth(depth);
    }
}
