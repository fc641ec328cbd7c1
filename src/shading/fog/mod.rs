//! Fog: colours that fade into one colour with the distance from the camera.
//!
//! `linear` says where the fog begins and where it is full. `vertex` has its factor at vertices and faces, for fog that costs no
//! instruction a pixel, and `colors` the tables and colours that go with it. `table` has its factor by depth, and `fogged` the
//! shader that looks it up at each pixel, by `level_runs`.

mod colors;
mod fogged;
mod level_runs;
mod linear;
mod table;
mod vertex;

pub use fogged::Fogged;
pub use linear::{Fog, FogError};
pub use table::FogTable;
pub use vertex::VertexFog;
