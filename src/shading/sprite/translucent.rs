//! Translucent sprites: pictures that are mixed with the stored pixels.

use super::source::SpriteSource;
use crate::shading::{Blend, Blended, HalfBlended};
use embedded_graphics_core::geometry::Size;

impl<S: SpriteSource<Color: Blend>> SpriteSource for HalfBlended<S> {
    type Color = S::Color;
    const BLENDS: bool = true;

    fn picture_size(&self) -> Size {
        self.shader().picture_size()
    }

    #[inline(always)]
    fn color_at(&self, column: u32, row: u32) -> Option<S::Color> {
        const { assert!(!S::BLENDS, "this picture is translucent already") };
        self.shader().color_at(column, row)
    }

    #[inline(always)]
    fn blend(&self, own: S::Color, stored: S::Color) -> S::Color {
        own.half(stored)
    }
}

impl<S: SpriteSource<Color: Blend>> SpriteSource for Blended<S> {
    type Color = S::Color;
    const BLENDS: bool = true;

    fn picture_size(&self) -> Size {
        self.shader().picture_size()
    }

    #[inline(always)]
    fn color_at(&self, column: u32, row: u32) -> Option<S::Color> {
        const { assert!(!S::BLENDS, "this picture is translucent already") };
        self.shader().color_at(column, row)
    }

    #[inline(always)]
    fn blend(&self, own: S::Color, stored: S::Color) -> S::Color {
        own.mix(stored, self.alpha())
    }
}
