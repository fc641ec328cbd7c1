//! The scene: meshes with the materials of their faces, and hierarchies of transforms.

mod hierarchy;
mod materials;
mod mesh;

pub use hierarchy::{Hierarchy, HierarchyError, Node};
pub use materials::{FaceColors, MaterialError, TextureCoords};
pub use mesh::{edge_faces, Mesh, MeshError};
