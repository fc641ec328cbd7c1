//! Shaders and light: the colours of a face's pixels. The rasteriser does not depend on this module.
//!
//! Start with a colour of the target, which fills a face and needs no shader; a [`Lambert`](crate::light::Lambert) dims it by the light on the face.
//! For smooth light pass [`Gouraud::lit`] or, faster, [`ShadeTable::lit`]; then come [`texture`](crate::texture) and [`fog`](crate::fog).
//! [`Translucent`] and [`ScreenDoor`] let what is behind show through, and [`AntiAliased`] is for lines.

mod corner_values;
mod depth_tested;
mod dither;
mod flat;
pub(crate) mod fog;
mod gouraud;
pub(crate) mod highlight;
pub(crate) mod lambert;
mod levels;
pub(crate) mod light;
pub(crate) mod light_error;
pub(crate) mod lights;
mod lit;
pub(crate) mod matcap;
mod normal_space;
pub(crate) mod point_light;
mod screen_door;
mod shader;
mod smooth;
pub(crate) mod sprite;
mod stroke;
mod table;
mod table_shader;
pub(crate) mod texture;
mod translucent;

pub use crate::clip::{Barycentric, Varying};
pub use corner_values::CornerValues;
pub use depth_tested::DepthTested;
pub(crate) use dither::Bayer;
pub use dither::Dithered;
pub use flat::Flat;
pub(crate) use fog::Fogged;
pub(crate) use fog::{FogBounds, FogLevel};
pub use gouraud::Gouraud;
pub(crate) use gouraud::Nearest;
pub(crate) use light::Light;
pub(crate) use light_error::LightError;
pub use lit::Lit;
pub use screen_door::ScreenDoor;
pub(crate) use shader::{DepthLevels, FastPath};
pub use shader::{Shader, SpanShader};
pub(crate) use sprite::SpriteSize;
pub(crate) use sprite::{Sprite, SpriteSource};
pub(crate) use stroke::{rests_of_line, StrokeKind};
pub use stroke::{AntiAliased, AntiAliasedBy, Stroke};
pub use table::{ShadeTable, TableShader};
pub(crate) use texture::Line;
pub use texture::PerspectiveGouraud;
pub(crate) use texture::Texels;
pub use translucent::Translucent;
