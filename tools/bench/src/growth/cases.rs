//! The cases of `growth.json`: some to fit the constants, others to test the predictions.

use super::{Kind, SMALL};
use pinhole::{draw::Cull, Mesh};

/// A mesh of 10 to 20 000 triangles, which `build.rs` makes; it is not checked yet: the compiler would take long.
pub(crate) struct Shape {
    exponent: i8,
    vertices: &'static [[i16; 3]],
    faces: &'static [[u16; 3]],
    normals: &'static [[i16; 3]],
    edges: &'static [[u16; 2]],
    /// The two faces beside each edge.
    beside: &'static [[u16; 2]],
}

impl Shape {
    fn mesh(&self) -> Option<Mesh<'static>> {
        let mesh = Mesh::new(self.vertices, self.exponent, self.faces).ok()?;
        mesh.with_normals(self.normals).ok()?.with_edges(self.edges).ok()
    }

    /// With the first part of the edges, one of every `one_of`, and the faces beside them.
    pub(crate) fn with_edge_faces(&self, one_of: usize) -> Option<Mesh<'static>> {
        let count = self.edges.len() / one_of.max(1);
        let mesh = self.mesh()?.with_edges(self.edges.get(..count)?).ok()?;
        mesh.with_edge_faces(self.beside.get(..count)?).ok()
    }

    /// Its vertices alone.
    fn points(&self) -> Option<Mesh<'static>> {
        Mesh::new(self.vertices, self.exponent, &[]).ok()
    }
}

include!(concat!(env!("OUT_DIR"), "/shapes.rs"));

/// A mesh before a camera. Lengths in 2⁻¹⁶.
pub struct Case {
    pub name: &'static str,
    pub(super) shape: &'static Shape,
    /// Whether it is the shape's vertices alone.
    pub points: bool,
    pub(super) eye: [i32; 3],
    pub size: [u32; 2],
    pub(super) cull: Cull,
    /// Whether the mesh is not turned, as land.
    pub(super) level: bool,
    /// Whether the constants are fitted to it.
    pub fitted: bool,
}

impl Case {
    /// The mesh for a way to draw: for hidden lines it has the faces beside the edges.
    pub(super) fn mesh(&self, kind: Kind) -> Option<Mesh<'static>> {
        match kind {
            _ if self.points => self.shape.points(),
            Kind::HiddenBands | Kind::Silhouettes | Kind::Creases => self.shape.with_edge_faces(1),
            Kind::FewHiddenBands => self.shape.with_edge_faces(FEW),
            _ => self.shape.mesh(),
        }
    }

    /// Which faces are drawn: only in front, where edges are smoothed.
    pub(super) fn cull_of(&self, kind: Kind) -> Cull {
        match kind {
            Kind::Silhouettes | Kind::Creases => Cull::Back,
            _ => self.cull,
        }
    }

    /// Whether it is drawn by the smaller painter, which has room for three times its vertices.
    pub(super) fn is_small(&self) -> bool {
        self.shape.vertices.len() <= SMALL / 3
    }
}

/// A mesh with few edges has one of every four.
const FEW: usize = 4;
