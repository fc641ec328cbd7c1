//! A mesh instance: a mesh, the transform of one object, and a camera.

use super::cull::Cull;
use crate::camera::{Camera, VertexTransform};
use crate::math::{Affine, Coordinate, Inside};
use crate::scene::Mesh;
use crate::space::{Model, World};
use core::marker::PhantomData;
use embedded_graphics_core::primitives::Rectangle;

/// A mesh with the transform of one object before one camera, ready to be drawn. [`Camera::place`] makes it, once per object
/// and frame.
///
/// Each drawing mode is a method: lines, solid faces, faces with a depth test, hidden lines, points. [The
/// book](crate::draw#hidden-surface-removal) compares them.
#[derive(Clone, Copy, Debug)]
pub struct MeshInstance<'m, V: Coordinate = i16> {
    parts: Parts<'m, V::Stored>,
    clipping: PhantomData<V>,
}

/// All of an instance except whether it is clipped. These fields are a struct of their own so that they are moved as one: if each
/// field were moved to the instance that [`without_clipping`](MeshInstance::without_clipping) returns, LLVM would keep both
/// instances, and call `memcpy`, which is 394 bytes on an M3.
#[derive(Clone, Copy, Debug)]
struct Parts<'m, S: Coordinate> {
    mesh: &'m Mesh<'m, S>,
    vertex_transform: VertexTransform,
    cull: Cull,
}

impl Camera {
    /// Places a mesh before this camera: `model` takes the mesh's vertices to the world. Everything that depends on the
    /// object but not on its vertices is computed here, in integers.
    #[inline(never)] // the result is large and is written directly to the caller's variable: inlined, it would be on the stack twice
    pub fn place<'m, V: Coordinate<Stored = V>>(
        &self,
        mesh: &'m Mesh<'m, V>,
        model: &Affine<Model, World>,
    ) -> MeshInstance<'m, V> {
        let vertex_transform =
            VertexTransform::new(self, model, mesh.exponent().into(), mesh.justify(), V::NARROW);
        MeshInstance::of(Parts { mesh, vertex_transform, cull: Cull::Back })
    }

    /// An instance for vertices that are cached and on the screen: it unpacks them, and can transform none.
    #[inline(never)] // as `place`
    pub(super) fn place_cached<'m, V: Coordinate<Stored = V>>(
        &self,
        mesh: &'m Mesh<'m, V>,
    ) -> MeshInstance<'m, V> {
        MeshInstance::of(Parts { mesh, vertex_transform: VertexTransform::of_cached(self), cull: Cull::Back })
    }
}

impl<'m, V: Coordinate> MeshInstance<'m, V> {
    /// The viewport's pixels.
    pub(super) const fn area(&self) -> &Rectangle {
        self.parts.vertex_transform.area()
    }

    /// The transform of the mesh's vertices.
    #[inline(always)]
    pub(super) const fn vertex_transform(&self) -> &VertexTransform {
        &self.parts.vertex_transform
    }

    /// Which faces are culled.
    #[inline(always)]
    pub(super) const fn cull(&self) -> Cull {
        self.parts.cull
    }

    #[inline(always)]
    const fn of(parts: Parts<'m, V::Stored>) -> Self {
        Self { parts, clipping: PhantomData }
    }

    /// The mesh of this instance.
    #[inline(always)]
    pub const fn mesh(&self) -> &'m Mesh<'m, V::Stored> {
        self.parts.mesh
    }

    /// The instance without clipping, for an object that stays in view: beyond the near plane, before a far plane that clips, and
    /// within 1024 pixels of the viewport's centre. Firmware then links no code that cuts faces and edges: 2 to 5 KB less.
    ///
    /// Faces, edges and points with a vertex elsewhere are not drawn; [`Statistics`](crate::draw::Statistics) counts them as `outside`.
    /// All others are drawn as with clipping, pixel by pixel.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// // The second triangle reaches behind the eye.
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 9, 9]], 0, &[[0, 1, 2], [0, 1, 3]])?;
    /// let instance = camera.place(&mesh, &Affine::identity()).with_cull(Cull::None).without_clipping();
    /// let statistics = instance.faces(|_| BinaryColor::On).draw(&mut MockDisplay::new())?;
    /// assert_eq!((statistics.drawn, statistics.outside), (1, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn without_clipping(self) -> MeshInstance<'m, Inside<V>> {
        MeshInstance::of(self.parts)
    }

    /// Sets which faces are culled; the default is [`Cull::Back`].
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let mut display = MockDisplay::new();
    /// display.set_allow_overdraw(true);
    /// let from_behind = Mesh::new(&[[-1, -1, 0], [0, 1, 0], [1, -1, 0]], 0, &[[0, 1, 2]])?; // clockwise
    /// let camera = Camera::framing(&from_behind.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let instance = camera.place(&from_behind, &Affine::identity());
    /// let statistics = instance.faces(|_| BinaryColor::On).draw(&mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (0, 1));
    /// let statistics = instance.with_cull(Cull::None).faces(|_| BinaryColor::On).draw(&mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 0));
    /// let statistics = instance.with_cull(Cull::Front).faces(|_| BinaryColor::On).draw(&mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_cull(mut self, cull: Cull) -> Self {
        self.parts.cull = cull;
        self
    }
}

defmt_format!(
    [V: Coordinate] MeshInstance<'_, V>, self,
    "{} in {} at {}, cull {}", self.mesh(), self.area().size, self.area().top_left, self.cull()
);
