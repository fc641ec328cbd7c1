//! Textures: faces that show a picture, in perspective.
//!
//! `texels` and `indexed` say where texels come from; `keyed` makes one colour transparent; `clamped` has texels that do not repeat; `bilinear`
//! mixes four texels; `mip` has reduced copies of a picture; `mapping` says what a texture on a face is; `textured` makes a shader of it, and
//! `lit_textured` one with light at each corner; `perspective_gouraud` has no texels, but weights of corners; `gradients` interpolates texture
//! coordinates over a triangle; `runs` divides a row into runs of pixels over which they are linear.

mod bilinear;
mod clamped;
mod gradients;
mod indexed;
mod keyed;
mod line;
mod linear;
mod lit_textured;
mod mapping;
mod mip;
mod perspective;
mod perspective_gouraud;
mod runs;
mod texels;
mod textured;

pub use bilinear::BilinearTexels;
pub use clamped::ClampedTexels;
pub use indexed::IndexedTexels;
pub use keyed::ColorKeyed;
pub(crate) use line::Line;
pub use lit_textured::LitTextured;
pub use mapping::{Accuracy, Texture, Textured};
pub use mip::{MipPicture, MipTexels};
pub use perspective_gouraud::PerspectiveGouraud;
pub use texels::{TexelSlice, Texels, TextureError};
