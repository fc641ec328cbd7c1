//! What is looked at.

mod mesh;

pub use mesh::{Mesh, MeshError};
