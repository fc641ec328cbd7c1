//! The models of `scenes.json`, as embedded-3dgfx takes them.

pub struct Model {
    pub vertices: &'static [[f32; 3]],
    pub faces: &'static [[usize; 3]],
    pub edges: &'static [[usize; 2]],
    pub normals: &'static [[f32; 3]],
    /// The normals at the vertices, for the torus.
    pub vertex_normals: &'static [[f32; 3]],
    /// The rotation, row-major.
    pub rotation: [[f32; 3]; 3],
    /// The distance of the eye from the origin.
    pub distance: f32,
}

include!(concat!(env!("OUT_DIR"), "/models.rs"));
