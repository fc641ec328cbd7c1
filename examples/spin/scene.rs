//! The scene of `spin`: the teapot on a turntable, seen from a little above.

use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{prelude::*, Angle};
use std::error::Error;
use teapot::{EDGES, FACES, VERTICES};

/// Half the teapot's extent is 1 to 2 units with it.
const EXPONENT: i8 = -14;

/// The faces reversed: the background would show through the gap around the lid without them.
const INSIDE: [[u16; 3]; FACES.len()] = {
    let (mut inside, mut face) = (FACES, 0);
    while face < FACES.len() {
        inside[face].swap(1, 2);
        face += 1;
    }
    inside
};

pub(crate) struct Turntable {
    outside: Mesh<'static>,
    inside: Mesh<'static>,
    camera: Camera,
}

impl Turntable {
    /// A camera that shows the complete model from every side.
    pub(crate) fn new(size: Size) -> Result<Self, Box<dyn Error>> {
        // The bounding sphere about the origin, and the distance at which it fills the field of view.
        let square = |v: &[i16; 3]| v.iter().map(|&c| i64::from(c) * i64::from(c)).sum::<i64>();
        let largest = VERTICES.iter().map(square).max().unwrap_or(0);
        let radius = (largest as f64).sqrt() * f64::from(EXPONENT).exp2();
        let distance = radius / 15f64.to_radians().sin();
        let elevation = 20f64.to_radians();
        let eye = [0.0, distance * elevation.sin(), distance * elevation.cos()].map(|c| c as f32);

        let viewing = ViewTransform::look_at(
            Point3::from_f32(eye[0], eye[1], eye[2])?,
            Point3::from_ints(0, 0, 0),
            Vector3::from_ints(0, 1, 0),
        )?;
        let projection = Projection::perspective(
            Angle::degrees(30),
            size,
            Scalar::try_from((distance - radius) * 0.99)?,
            Scalar::try_from((distance + radius) * 1.01)?,
        )?;
        let viewport = Viewport::new(Point::zero(), size)?;
        Ok(Turntable {
            outside: Mesh::new(&VERTICES, EXPONENT, &FACES)?.with_edges(&EDGES)?,
            inside: Mesh::new(&VERTICES, EXPONENT, &INSIDE)?,
            camera: Camera::new(&viewing, &projection, &viewport),
        })
    }

    /// The model transform of a frame: near parts move from right to left.
    pub(crate) fn model(frame: u32, frames: u32) -> Affine<Model, World> {
        Affine::rotation_y(-Angle::turns(frame as i32, frames))
    }

    /// The outside and the inside of the model before the camera.
    pub(crate) fn place(&self, model: &Affine<Model, World>) -> [MeshInstance<'_>; 2] {
        [&self.outside, &self.inside].map(|mesh| self.camera.place(mesh, model))
    }
}

/// Draws the inside and then the outside over it, each in painter's order. `shade` gets the index of a face; indices of the
/// inside follow those of the outside.
pub(crate) fn paint<D: DrawTarget, const CORNERS: usize, const FACES: usize>(
    painter: &mut Painter<D::Color, CORNERS, FACES>,
    [outside, inside]: &[MeshInstance<'_>; 2],
    shade: impl Fn(usize) -> D::Color,
    target: &mut D,
) -> Result<Statistics, Box<dyn Error>>
where
    D::Error: Error + 'static,
{
    let first_inside = outside.mesh().faces().len();
    inside.faces(|face| shade(first_inside + face)).sorted(painter)?;
    let statistics = painter.draw(target)?;
    outside.faces(shade).sorted(painter)?;
    Ok(painter.draw(target)? + statistics)
}
