//! What `spin` films: a mesh on a turntable, seen from a little above.

use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, Camera, Mesh, Placed, Point3, Projection, Scalar, Vector3, Viewing, Viewport};
use pinhole_import::ImportedMesh;
use std::error::Error;

/// The exponent that every mesh is shown with: its half extent is 1 to 2 units, whatever units it was made in.
const EXPONENT: i8 = -14;

pub(crate) struct Turntable<'m> {
    mesh: Mesh<'m>,
    camera: Camera,
}

impl<'m> Turntable<'m> {
    /// Sets up a camera that sees all of the mesh from every side.
    pub(crate) fn new(model: &'m ImportedMesh, size: Size) -> Result<Self, Box<dyn Error>> {
        let mesh = Mesh::new(&model.vertices, EXPONENT, &model.faces)?
            .with_edges(&model.edges)?
            .with_normals(&model.normals)?;

        // The ball about the origin that holds the mesh, and the distance from which it fills the field of view.
        let square = |v: &[i16; 3]| v.iter().map(|&c| i64::from(c) * i64::from(c)).sum::<i64>();
        let largest = model.vertices.iter().map(square).max().unwrap_or(0);
        let radius = (largest as f64).sqrt() * f64::from(EXPONENT).exp2();
        let distance = radius / 15f64.to_radians().sin();
        let elevation = 20f64.to_radians();
        let eye = [0.0, distance * elevation.sin(), distance * elevation.cos()];

        let viewing = Viewing::look_at(
            Point3::from_f32(eye[0] as f32, eye[1] as f32, eye[2] as f32)?,
            Point3::from_ints(0, 0, 0),
            Vector3::from_ints(0, 1, 0),
        )?;
        let projection = Projection::perspective(
            Angle::degrees(30),
            size,
            Scalar::from_num((distance - radius) * 0.99),
            Scalar::from_num((distance + radius) * 1.01),
        )?;
        let viewport = Viewport::new(Point::zero(), size)?;
        Ok(Turntable { mesh, camera: Camera::new(&viewing, &projection, &viewport) })
    }

    /// The model transform of a frame: the near side moves from right to left.
    pub(crate) fn model(frame: u32, frames: u32) -> Affine<Model, World> {
        Affine::rotation_y(-Angle::turns(frame as i32, frames))
    }

    /// The mesh as the camera sees it.
    pub(crate) fn place(&self, model: &Affine<Model, World>) -> Placed<'m> {
        self.camera.place(&self.mesh, model)
    }
}
