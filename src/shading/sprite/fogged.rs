//! Sprites in fog.

use super::source::SpriteSource;
use crate::color::Color;
use crate::shading::Fogged;
use embedded_graphics_core::geometry::Size;

impl<C: Color, S: SpriteSource<Color = C>> SpriteSource for Fogged<'_, S, C> {
    type Color = C;
    const BLENDS: bool = S::BLENDS;

    fn picture_size(&self) -> Size {
        self.inner().picture_size()
    }

    #[inline(always)]
    fn color_at(&self, column: u32, row: u32) -> Option<C> {
        Some(self.in_nearest_level(self.inner().color_at(column, row)?))
    }

    #[inline(always)]
    fn solid_color(&self) -> Option<C> {
        Some(self.in_nearest_level(self.inner().solid_color()?))
    }

    #[inline(always)]
    fn blend(&self, own: C, stored: C) -> C {
        self.inner().blend(own, stored)
    }

    fn set_depth(&mut self, depth: u16) {
        self.set_level_of(depth).set_depth(depth);
    }
}
