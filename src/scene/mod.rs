//! The scene: meshes with the materials of their faces, and hierarchies of transforms.

mod face_planes;
mod hierarchy;
mod materials;
mod mesh;

pub use face_planes::{FacePlanes, WithPlanes, WithoutPlanes};
pub use hierarchy::{Hierarchy, HierarchyError, Node};
pub use materials::{FaceColors, MaterialError, TextureCoords};
pub(crate) use mesh::MeshData;
pub use mesh::{edge_faces, Mesh, MeshError};
