//! Sprites: pictures that face the viewer.
//!
//! `source` says what a picture is, `image` makes one of an image of embedded-graphics, `solid` of one colour, `translucent` of one
//! that is mixed with what is behind it, `fogged` of one in fog; `sprite` adds the size and the anchor.

mod fogged;
mod image;
mod solid;
mod source;
#[allow(clippy::module_inception)] // the type has the folder's name
mod sprite;
mod translucent;

pub use image::SpriteImage;
pub use solid::SolidTexel;
pub use source::SpriteSource;
pub use sprite::Sprite;
pub(crate) use sprite::SpriteSize;
