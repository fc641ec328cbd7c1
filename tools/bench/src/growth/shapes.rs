//! Meshes of 10 to 20 000 triangles, which `build.rs` makes.

use pinhole::Mesh;

/// A mesh that is not checked yet: the compiler would take long.
pub(super) struct Shape {
    exponent: i8,
    vertices: &'static [[i16; 3]],
    faces: &'static [[u16; 3]],
    normals: &'static [[i16; 3]],
    edges: &'static [[u16; 2]],
    /// The two faces beside each edge.
    beside: &'static [[u16; 2]],
}

impl Shape {
    pub(super) fn mesh(&self) -> Option<Mesh<'static>> {
        let mesh = Mesh::new(self.vertices, self.exponent, self.faces).ok()?;
        mesh.with_normals(self.normals).ok()?.with_edges(self.edges).ok()
    }

    /// With the first part of the edges, one of every `one_of`, and the faces beside them.
    pub(super) fn with_edge_faces(&self, one_of: usize) -> Option<Mesh<'static>> {
        let count = self.edges.len() / one_of.max(1);
        let mesh = self.mesh()?.with_edges(self.edges.get(..count)?).ok()?;
        mesh.with_edge_faces(self.beside.get(..count)?).ok()
    }

    pub(super) fn vertices(&self) -> usize {
        self.vertices.len()
    }

    /// Its vertices alone.
    pub(super) fn points(&self) -> Option<Mesh<'static>> {
        Mesh::new(self.vertices, self.exponent, &[]).ok()
    }
}

include!(concat!(env!("OUT_DIR"), "/shapes.rs"));
