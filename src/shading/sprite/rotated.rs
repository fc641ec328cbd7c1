//! A sprite's picture, turned for a panel that is mounted turned.

use super::source::SpriteSource;
use crate::camera::Rotation;
use embedded_graphics_core::geometry::{Point, Size};

/// A picture turned by quarters. [`Sprite::rotated`](crate::sprite::Sprite::rotated) makes it.
#[derive(Clone, Copy, Debug)]
pub struct RotatedPicture<S> {
    source: S,
    /// Of the source.
    size: Size,
    rotation: Rotation,
}

impl<S: SpriteSource> RotatedPicture<S> {
    pub(super) fn new(source: S, rotation: Rotation) -> Self {
        Self { size: source.picture_size(), source, rotation }
    }
}

impl<S: SpriteSource> SpriteSource for RotatedPicture<S> {
    type Color = S::Color;
    type Ink = S::Ink;

    fn picture_size(&self) -> Size {
        self.rotation.of_size(self.size)
    }

    #[inline(always)]
    fn texel_at(&self, column: u32, row: u32) -> S::Ink {
        // Numbers of 2³¹ and more wrap, and wrap back.
        let Point { x, y } = self.rotation.inverse().turn(Point::new(column as i32, row as i32), self.size);
        self.source.texel_at(x as u32, y as u32)
    }

    #[inline(always)]
    fn solid_texel(&self) -> Option<S::Ink> {
        self.source.solid_texel()
    }

    fn set_depth(&mut self, depth: u16) {
        self.source.set_depth(depth);
    }
}

defmt_format!([S] RotatedPicture<S>, self, "picture turned by {}", self.rotation);
