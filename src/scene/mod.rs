//! The scene: meshes, and hierarchies of transforms.

mod hierarchy;
mod mesh;

pub use hierarchy::{Hierarchy, HierarchyError, Node};
pub use mesh::{edge_faces, Mesh, MeshError};
