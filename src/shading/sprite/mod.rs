//! Sprites: pictures that face the viewer.
//!
//! `source` says what a picture is, `image` makes one of an image of embedded-graphics; `sprite` adds the size and the anchor.

mod image;
mod rotated;
mod source;
#[allow(clippy::module_inception)] // the type has the folder's name
mod sprite;

pub use image::SpriteImage;
pub use source::{SolidTexel, SpriteSource};
pub use sprite::Sprite;
pub(crate) use sprite::SpriteSize;
