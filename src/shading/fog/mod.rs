//! Fog: colours that fade into one colour with the distance from the camera.
//!
//! `linear` says where the fog begins and where it is full, and `profile` how it grows in between. `vertex` computes the factor
//! at vertices and faces, for fog that costs no instruction per pixel. `table` has the factor by depth, and `fogged` the shader that looks it up at each pixel, by `levels`.

mod fogged;
mod levels;
mod linear;
mod profile;
mod table;
mod vertex;

pub use fogged::Fogged;
pub(crate) use levels::{Bounds as FogBounds, FogLevel};
pub use linear::Fog;
pub use table::FogTable;
pub use vertex::VertexFog;
