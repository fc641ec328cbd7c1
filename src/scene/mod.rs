//! The scene: meshes with the materials of their faces, and hierarchies of transforms.

mod face_planes;
mod hierarchy;
mod materials;
mod mesh;
mod mesh_error;

pub use face_planes::{FacePlanes, WithPlanes, WithoutPlanes};
pub use hierarchy::{Hierarchy, Node};
pub use materials::{FaceColors, TextureCoords};
pub(crate) use mesh::MeshData;
pub use mesh::{edge_faces, Mesh};
pub use mesh_error::MeshError;
