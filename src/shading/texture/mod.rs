//! Textures: faces that show a picture, in perspective.
//!
//! `texels` and `indexed` say where texels come from, `mapping` what a texture on a face is, `textured` makes a shader of it,
//! `gradients` interpolates texture coordinates over a triangle, and `runs` divides a row into runs of pixels over which they
//! are linear.

mod gradients;
mod indexed;
mod keyed;
mod mapping;
mod runs;
mod texels;
mod textured;

pub use indexed::IndexedTexels;
pub use keyed::{ColorKeyed, IndexKeyed};
pub use mapping::{Accuracy, Texture, Textured};
pub(crate) use runs::Line;
pub use texels::{TexelSlice, Texels, TextureError};
