//! A mesh instance: a mesh, the transform of one object, and a camera.

use super::cull::Cull;
use crate::camera::{Camera, VertexTransform};
use crate::math::{Affine, Coordinate};
use crate::scene::Mesh;
use crate::space::{Model, World};
use embedded_graphics_core::primitives::Rectangle;

/// A mesh with the transform of one object before one camera, ready to be drawn. [`Camera::place`] makes it, once per object
/// and frame.
///
/// Each drawing mode is a method: lines, solid faces, faces with a depth test, hidden lines, points.
/// [The book](crate::book::ch4_visibility) compares them.
#[derive(Clone, Copy, Debug)]
pub struct MeshInstance<'m, V = i16> {
    pub(super) mesh: &'m Mesh<'m, V>,
    pub(super) vertex_transform: VertexTransform,
    pub(super) cull: Cull,
}

impl Camera {
    /// Places a mesh before this camera: `model` takes the mesh's vertices to the world. Everything that depends on the
    /// object but not on its vertices is computed here, in integers.
    #[inline(never)] // the result is large and is written directly to the caller's variable: inlined, it would be on the stack twice
    pub fn place<'m, V: Coordinate>(
        &self,
        mesh: &'m Mesh<'m, V>,
        model: &Affine<Model, World>,
    ) -> MeshInstance<'m, V> {
        let vertex_transform =
            VertexTransform::new(self, model, mesh.exponent().into(), mesh.justify(), V::NARROW);
        MeshInstance { mesh, vertex_transform, cull: Cull::Back }
    }
}

impl<'m, V> MeshInstance<'m, V> {
    /// The viewport's pixels.
    pub(super) const fn area(&self) -> &Rectangle {
        self.vertex_transform.area()
    }

    /// The mesh of this instance.
    pub const fn mesh(&self) -> &'m Mesh<'m, V> {
        self.mesh
    }
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Sets which faces are culled; the default is [`Cull::Back`].
    ///
    /// ```
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// # use pinhole::{Affine, Angle, Camera, Cull, Mesh, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// # let [eye, origin] = [5, 0].map(|z| Point3::from_ints(0, 0, z));
    /// # let up = Vector3::from_ints(0, 1, 0);
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(60), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&ViewTransform::look_at(eye, origin, up)?, &lens, &viewport);
    /// let from_behind = Mesh::new(&[[-1, -1, 0], [0, 1, 0], [1, -1, 0]], 0, &[[0, 1, 2]])?; // clockwise
    /// let instance = camera.place(&from_behind, &Affine::identity());
    /// let mut display = MockDisplay::new();
    /// let statistics = instance.solid(|_| BinaryColor::On, &mut [], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (0, 1));
    /// let statistics = instance.with_cull(Cull::None).solid(|_| BinaryColor::On, &mut [], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_cull(self, cull: Cull) -> Self {
        Self { cull, ..self }
    }
}

#[cfg(feature = "defmt")]
impl<V> defmt::Format for MeshInstance<'_, V> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Rectangle { top_left, size } = *self.area();
        defmt::write!(f, "{} in {} at {}, cull {}", self.mesh, size, top_left, self.cull);
    }
}
