//! The library itself, through its public API, before the torus.

use crate::torus::{DEGREES, DISTANCE, EXPONENT, FAR, NEAR, ROTATION, SIZE, VERTICES};
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Angle, Camera, Coordinate, Mesh, MeshInstance, Point3, Projection, Scalar, ScreenVertex, Vector3,
    ViewTransform, Viewport,
};

/// A vertex type of the library.
pub(crate) trait Library {
    const ID: &'static str;
    type Coordinate: Coordinate<Stored = Self::Coordinate> + 'static;
    /// A coordinate in the type's own unit.
    fn coordinate(vertex: i16) -> Self::Coordinate;
    /// `None` if the library refuses the mesh, which is known to be valid.
    fn mesh(vertices: &[[Self::Coordinate; 3]]) -> Option<Mesh<'_, Self::Coordinate>>;
}

/// i16 vertices: the default.
pub(crate) struct Short;

impl Library for Short {
    const ID: &'static str = "default";
    type Coordinate = i16;
    fn coordinate(vertex: i16) -> i16 {
        vertex
    }
    fn mesh(vertices: &[[i16; 3]]) -> Option<Mesh<'_, i16>> {
        Mesh::new(vertices, EXPONENT, &[]).ok()
    }
}

/// Vertices in I16F16.
pub(crate) struct Fixed;

impl Library for Fixed {
    const ID: &'static str = "default-fixed";
    type Coordinate = Scalar;
    fn coordinate(vertex: i16) -> Scalar {
        Scalar::from_bits(i32::from(vertex) << (16 + EXPONENT))
    }
    fn mesh(vertices: &[[Scalar; 3]]) -> Option<Mesh<'_, Scalar>> {
        Mesh::from_fixed(vertices, &[]).ok()
    }
}

/// Calls `work` with the torus, placed before its camera.
pub(crate) fn before_torus<L: Library, T>(
    work: impl FnOnce(&MeshInstance<'_, L::Coordinate>, &mut [ScreenVertex]) -> Option<T>,
) -> Option<T> {
    let vertices = VERTICES.map(|v| v.map(L::coordinate));
    let mesh = L::mesh(&vertices)?;
    let [x, y, z] = [0, 1, 2].map(|i| {
        let [a, b, c] = black_box(&ROTATION).map(|row| Scalar::from_bits(row[i]));
        Vector3::new(a, b, c)
    });
    let origin = Point3::from_ints(0, 0, 0);
    let model = Affine::<Model, World>::from_frame(x, y, z, origin);
    let eye = Point3::new(Scalar::ZERO, Scalar::ZERO, Scalar::from_bits(DISTANCE));
    let viewing = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0)).ok()?;
    let (near, far) = (Scalar::from_bits(NEAR), Scalar::from_bits(FAR));
    let size = Size::new(SIZE, SIZE);
    let projection = Projection::perspective(Angle::degrees(DEGREES), size, near, far).ok()?;
    let viewport = Viewport::new(Point::zero(), size).ok()?;
    let camera = Camera::new(&viewing, &projection, &viewport);
    let mut corners = [ScreenVertex::EMPTY; VERTICES.len()];
    work(&camera.place(&mesh, &model), &mut corners)
}
