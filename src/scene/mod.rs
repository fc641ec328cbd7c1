//! The scene: meshes with the materials of their faces, and hierarchies of transforms.

mod hierarchy;
mod materials;
mod mesh;
mod mesh_error;

pub use hierarchy::{Hierarchy, Node};
pub use materials::{FaceColors, TextureCoords};

pub(crate) use mesh::CLUSTER;
pub(crate) use mesh::{bin_count, bins_len, MOST_BINS};
pub use mesh::{edge_faces, Mesh};
pub use mesh_error::MeshError;
