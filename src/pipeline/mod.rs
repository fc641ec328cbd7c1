//! The pipeline on one page.
//!
//! 1. [`Camera::place`] folds model, viewing, projection and viewport into integer forms, once per
//!    object.
//! 2. Every vertex goes through them to the screen, once, into the caller's corners; those that
//!    need clipping are marked.
//! 3. Faces are sorted out: turned away, without area, outside, whole, or cut (and then clipped in
//!    homogeneous coordinates and taken as a fan).
//! 4. What is left is rasterised span by span into the DrawTarget: as edges
//!    ([`MeshInstance::wireframe`]), as faces in the mesh's order ([`MeshInstance::solid`]), from far to near
//!    ([`Painter`]), or where they are nearer than a depth buffer says ([`MeshInstance::depth_tested`]).

mod banded;
mod binned;
mod bins;
mod clip_face;
mod draw_2d;
mod fan;
mod lines;
mod painter;
mod plane_culled;
mod polyline;
mod statistics;
mod transformed;

pub use banded::{BinnedEdges, BinnedFaces};
use binned::Binned;
pub use bins::BinError;
pub use draw_2d::{draw_line, fill_triangle};
use fan::{Fan, Outcome, Polygon, Progress};
pub use painter::{Painter, PainterError, PaintersOrder};
pub use plane_culled::PlaneCulled;
pub use statistics::Statistics;
pub use transformed::TransformedMesh;

use crate::camera::{Camera, ScreenVertex, UnpackedVertex, VertexTransform};
use crate::math::{Affine, Coordinate};
use crate::raster::{DepthTriangle, Scissor, ScreenPoint, Triangle};
use crate::scene::Mesh;
use crate::shading::{Shader, SpanShader};
use crate::space::{Model, World};
use crate::surface::{inside, DepthBuffer, DepthTarget, Target};

use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

/// A mesh placed before a camera, ready to be drawn: [`Camera::place`] makes it, once per object and frame.
///
/// Each way to draw is a method. [The book](crate::book::ch4_visibility) says which to choose.
#[derive(Clone, Copy, Debug)]
pub struct MeshInstance<'m, V = i16> {
    mesh: &'m Mesh<'m, V>,
    placement: VertexTransform,
    cull: Cull,
}

/// Which faces are culled by their winding on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cull {
    /// Back faces: right for closed meshes.
    #[default]
    Back,
    /// None: both sides show.
    None,
}

impl Camera {
    /// The mesh before this camera. All that depends on the object but not on its vertices is
    /// computed here, in integers.
    #[inline(never)] // what it makes is large, and is made where it stays: inlined it would stand there twice
    pub fn place<'m, V: Coordinate>(
        &self,
        mesh: &'m Mesh<'m, V>,
        model: &Affine<Model, World>,
    ) -> MeshInstance<'m, V> {
        let placement = VertexTransform::new(self, model, mesh.exponent().into(), mesh.justify(), V::NARROW);
        MeshInstance { mesh, placement, cull: Cull::Back }
    }
}

impl<V> MeshInstance<'_, V> {
    /// The viewport's pixels.
    pub(crate) const fn area(&self) -> &Rectangle {
        self.placement.area()
    }
}

impl<'m, V: Coordinate> MeshInstance<'m, V> {
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
    /// let placed = camera.place(&from_behind, &Affine::identity());
    /// let mut display = MockDisplay::new();
    /// let statistics = placed.solid(|_| BinaryColor::On, &mut [], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (0, 1));
    /// let statistics = placed.with_cull(Cull::None).solid(|_| BinaryColor::On, &mut [], &mut display)?;
    /// assert_eq!((statistics.drawn, statistics.culled), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_cull(self, cull: Cull) -> Self {
        Self { cull, ..self }
    }

    /// Transforms every vertex once, without depth, for drawing in bands. Vertices beyond the end of `corners` are
    /// computed again whenever they are needed.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{
    ///     space::{Model, World}, Affine, Angle, Camera, ScreenVertex, Frame, Mesh, Point3, Projection, Scalar,
    ///     Vector3, ViewTransform, Viewport,
    /// };
    /// const VERTICES: [[i16; 3]; 3] = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]];
    /// let mesh = Mesh::new(&VERTICES, 0, &[[0, 1, 2]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
    ///     &viewport,
    /// );
    /// let model = Affine::<Model, World>::identity();
    /// let (mut corners, mut records) = ([ScreenVertex::EMPTY; 3], [0; 2]); // a face, and one for every 16
    /// let placed = camera.place(&mesh, &model);
    /// let mut faces = placed.transform(&mut corners).bin_faces(&mut records)?;
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     faces.solid(|_face| Gray8::WHITE, &mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!(display.get_pixel(Point::new(32, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn transform<'a>(&'a self, corners: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V> {
        TransformedMesh::new(self, corners)
    }

    /// Like [`transform`](Self::transform), with depth, for drawing against depth strips. What lies beyond the far
    /// plane is clipped, whatever the camera says.
    pub fn transform_depth<'a>(&'a self, corners: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V, true> {
        TransformedMesh::new(self, corners)
    }

    /// The mesh that was placed.
    pub const fn mesh(&self) -> &'m Mesh<'m, V> {
        self.mesh
    }

    /// Where vertex `index` lies on the screen, and its depth (0 near … 65534 far). `None` when
    /// there is no such vertex, or it lies in front of the near plane or outside the guard band
    /// (and beyond the far plane, where the camera clips there).
    ///
    /// Within 1/256 px of the exact image of the quantised input, the rounding to 1/256 px
    /// included, for objects whose half extent is at most 300 times the vertex's distance;
    /// beyond, within `1/512 + 6.5·10⁻⁶ · extent/distance` px, for 480 × 320 pixels and focal lengths up
    /// to 700 px; ARCHITECTURE.md has the formula for all others. Depth is within 1 of
    /// `65535·(z/w + 1)/2` there, where far is at least twice near: what rounding costs grows as
    /// far/(far − near).
    ///
    /// ```
    /// # use embedded_graphics::geometry::{Point, Size};
    /// # use pinhole::{Affine, Angle, Camera, Mesh, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// # let [eye, origin] = [5, 0].map(|z| Point3::from_ints(0, 0, z));
    /// # let up = Vector3::from_ints(0, 1, 0);
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(60), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&ViewTransform::look_at(eye, origin, up)?, &lens, &viewport);
    /// let mesh = Mesh::new(&[[0, 0, 0], [0, 0, 8]], 0, &[])?;
    /// let placed = camera.place(&mesh, &Affine::identity());
    /// let (at, depth) = placed.project(0).ok_or("hidden")?;
    /// assert_eq!((at.x(), at.y()), (32 * 256, 32 * 256)); // the centre of 64 × 64 pixels
    /// assert!(depth > 0 && depth < 65_534);
    /// assert_eq!(placed.project(1), None); // behind the eye
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn project(&self, index: usize) -> Option<(ScreenPoint, u16)> {
        let index = u16::try_from(index).ok().filter(|_| index < self.mesh.vertices().len())?;
        let image = TransformedMesh::<V, true>::with_corners(self, false, &[]).image(index)?;
        Some((image.point, image.step()))
    }

    /// Where vertex `index` lies before its place is rounded to 1/256 px: x and y in 2⁻³² px, and depth
    /// in 2⁻³² of its 65536 steps, not cut off at either end. For measuring. `None` when there is no
    /// such vertex, or it lies in front of the near plane; what is beyond ±2³⁰ saturates.
    pub fn project_unsnapped(&self, index: usize) -> Option<[i64; 3]> {
        let vertex = *self.mesh.vertices().get(index)?;
        let h = self.placement.clip(vertex);
        let [_, _, d, w] = h.xydw;
        (d >= 0 && w > 0).then(|| self.placement.unsnapped(&h))
    }

    /// Draws the mesh's edges, each as a Bresenham line of one colour. Clipping at the target's border does not
    /// change an edge's pixels; ends cut by the near or far plane or the guard band are rounded to 1/256 px.
    ///
    /// `cache` holds transformed vertices; one as long as the vertex list computes each once, a
    /// shorter one (even an empty one) computes the rest whenever an edge needs them. The picture
    /// is the same.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn wireframe<T: Target>(
        &self,
        colour: T::Color,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let DrawRegion { scissor, .. } = DrawRegion::new(target, self.area());
        TransformedMesh::<V, false>::new(self, cache)
            .all_edges(|_, [from, to]| target.line(from.point.pixel(), to.point.pixel(), &scissor, colour))
    }

    /// Draws the faces in the mesh's order, one colour each: right for convex meshes, where front
    /// faces never hide each other; [`Painter`] draws the others. `shade` gives face `i` its
    /// colour, and is asked once for each face drawn. `cache` is as in
    /// [`wireframe`](Self::wireframe).
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn solid<T: Target, I: SpanShader<T::Color>>(
        &self,
        shade: impl FnMut(usize) -> I,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let limits = DrawRegion::new(target, self.area());
        TransformedMesh::<V, false>::new(self, cache)
            .all(&limits.viewport, shade, |piece, ink| fill(&piece.triangle, &ink, &limits.scissor, target))
    }

    /// Draws the faces, one colour each, where they are nearer than what `depth` holds: right for all
    /// meshes, also those that pierce each other. `shade` gives face `i` its colour, and is asked once
    /// for each face drawn. `cache` is as in [`wireframe`](Self::wireframe).
    ///
    /// **Depth** is that of the face's plane at the pixel's centre, in steps from 0 near to 65534 far, linear on
    /// the screen. Of equal depths the first drawn stays. What lies beyond the far plane is clipped, whatever the
    /// camera says. Nothing is drawn outside the depth buffer.
    ///
    /// **Error**: within 0.54 of a step for faces within 512 pixels; for larger ones within ½ + 2⁻¹³ and 2⁻¹⁷ for
    /// every column and row of the viewport. A face that reaches the far plane is drawn half a step nearer there
    /// (65535 stands for nothing): within 1.1. So faces two steps apart are told apart.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::{
    ///     space::{Model, World}, Affine, Angle, Camera, Cull, DepthBuffer, Mesh, Point3, Projection,
    ///     Scalar, Vector3, ViewTransform, Viewport,
    /// };
    /// // Two triangles through each other: one upright, one lying.
    /// const VERTICES: [[i16; 3]; 6] = [[-9, -9, 0], [9, -9, 0], [0, 9, 0], [-9, 0, 9], [9, 0, 9], [0, 0, -9]];
    /// let mesh = Mesh::new(&VERTICES, -3, &[[0, 1, 2], [3, 4, 5]])?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
    /// let camera = Camera::new(
    ///     &ViewTransform::look_at(Point3::from_ints(0, 2, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
    ///     &Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
    ///     &viewport,
    /// );
    /// let mut display = MockDisplay::<Gray8>::new();
    /// display.set_allow_overdraw(true);
    /// let mut storage = [0; 32 * 32];
    /// let area = Rectangle::new(Point::zero(), viewport.size());
    /// let mut depth = DepthBuffer::new(area, &mut storage)?;
    /// let model = Affine::<Model, World>::identity();
    /// camera.place(&mesh, &model).with_cull(Cull::None).depth_tested(
    ///     |face| Gray8::new(100 + face as u8),
    ///     &mut [],
    ///     &mut depth,
    ///     &mut display,
    /// )?;
    /// let seen = |x, y| display.get_pixel(Point::new(x, y)).map(|c| c.luma());
    /// assert_eq!((seen(16, 20), seen(16, 10)), (Some(101), Some(100))); // in front of it, and behind
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn depth_tested<T: Target, I: SpanShader<T::Color>>(
        &self,
        shade: impl FnMut(usize) -> I,
        cache: &mut [ScreenVertex],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let limits = DrawRegion::new(target, self.area()).with_depth(depth);
        let mut against = target.against(depth);
        TransformedMesh::<V, true>::new(self, cache).all(&limits.viewport, shade, |piece, ink| {
            fill_nearer(piece, &ink, &limits.scissor, &mut against, target)
        })
    }
}

/// Where it may be drawn, and the pixels of the viewport, to which what varies over a triangle is referred.
struct DrawRegion {
    scissor: Scissor,
    viewport: Scissor,
}

/// The pixels of a viewport, which lies inside the guard band: no sum saturates.
fn pixels(viewport: &Rectangle) -> Scissor {
    let Rectangle { top_left: Point { x, y }, size } = *viewport;
    Scissor::unclamped(x, y, x.wrapping_add_unsigned(size.width), y.wrapping_add_unsigned(size.height))
}

impl DrawRegion {
    #[inline(always)]
    fn new(target: &impl Target, viewport: &Rectangle) -> Self {
        Self::of(&target.area(), viewport)
    }

    /// What of a viewport lies in a target of these pixels.
    #[inline(always)]
    fn of(target: &Rectangle, viewport: &Rectangle) -> Self {
        let viewport = pixels(viewport);
        Self { scissor: inside(target).clipped_to(&viewport), viewport }
    }

    /// Less what a depth buffer does not hold.
    fn with_depth(self, depth: &DepthBuffer<'_>) -> Self {
        Self { scissor: depth.scissor().clipped_to(&self.scissor), ..self }
    }

    /// The same for what is drawn in several ways in one firmware: in bands, in painter's order, lines against depth.
    #[inline(never)]
    fn shared(target: &Rectangle, viewport: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> Self {
        let limits = Self::of(target, viewport);
        match depth {
            Some(depth) => limits.with_depth(depth),
            None => limits,
        }
    }
}

/// Makes a triangle with these corners, and their area, what is drawn next.
#[inline(always)]
fn put<const DEPTH: bool>(piece: &mut DepthTriangle<'_>, corners: &[UnpackedVertex; 3], area: i64) {
    piece.triangle.set(corners.map(|corner| corner.point), area);
    if DEPTH {
        piece.depths = corners.map(|corner| corner.depth);
    }
}

/// Step 4: a triangle over all that is there.
#[inline(always)]
fn fill<T: Target, I: SpanShader<T::Color>>(
    triangle: &Triangle<'_>,
    ink: &I,
    scissor: &Scissor,
    target: &mut T,
) -> Result<(), T::Error> {
    match ink.solid_color() {
        Some(colour) => target.triangle(triangle, scissor, colour),
        None => {
            let fill = ink.set_up(triangle);
            target.shaded(triangle, scissor, |span| I::span(&fill, span))
        }
    }
}

/// Step 4: a triangle where it is nearer.
#[inline(always)]
fn fill_nearer<T: Target, I: SpanShader<T::Color>>(
    piece: &DepthTriangle<'_>,
    ink: &I,
    scissor: &Scissor,
    against: &mut DepthTarget<'_, '_>,
    target: &mut T,
) -> Result<(), T::Error> {
    match ink.solid_color() {
        Some(colour) => target.nearer(piece, scissor, against, colour),
        None => match ink.shades() {
            Some(shades) => target.shades_nearer(piece, scissor, against, &shades),
            None => {
                let fill = ink.set_up(&piece.triangle);
                target.shaded_nearer(piece, scissor, against, |span| I::span(&fill, span))
            }
        },
    }
}

#[cfg(feature = "defmt")]
impl<V> defmt::Format for MeshInstance<'_, V> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Rectangle { top_left, size } = *self.area();
        defmt::write!(f, "{} in {} at {}, cull {}", self.mesh, size, top_left, self.cull);
    }
}
