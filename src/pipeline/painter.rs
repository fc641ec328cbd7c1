//! The painter's algorithm: stored faces are drawn from far to near.

use super::draw_region::DrawRegion;
use super::drawable::ShaderFor;
use super::face_source::{ClusterOrder, FaceSource, MeshOrder, PlaneOrder};
use super::faces::{draw_triangles, each_face, Faces, NOTHING, PLANES};
use super::fill::{fill, fill_nearer};
use super::instance::MeshInstance;
use super::statistics::Statistics;
use super::vertex_cache::{transform_all, LazyCache, TransformedMesh, VertexCache};
use crate::camera::ScreenVertex;
use crate::math::hints::{keep_rolled, opaque};
use crate::math::Coordinate;
use crate::raster::{self, DepthTriangle, Scissor, ScreenPoint, Triangle};
use crate::shading::{DepthTested, Shader};
use crate::surface::{BufferError, DepthBuffer, DepthTarget, Surface, Target, Tested, Unmatched, Untested};
use core::convert::Infallible;
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// The painter's algorithm: stores the visible faces of any number of mesh instances and draws them from far to near, without
/// a depth buffer, or tested against one: see [`DepthTested`].
///
/// Faces are sorted by the mean depth of their corners, in 65536 steps that are linear on the screen; faces with equal mean
/// depth are drawn in the order in which they were added. As a whole face is drawn before or after another one, a long face
/// beside a short one, and faces that pierce each other, can come out wrong. (Newell, Newell and Sancha, *A solution to the
/// hidden surface problem*, 1972, split such faces; this painter does not.)
///
/// `VERTICES` and `FACES` are the capacities, of which 65 536 and 65 535 are used at most: room for all vertices of all meshes, and for all
/// visible faces. Memory: 8 bytes per vertex; 10 bytes and a shader (usually a colour) per face. [`Faces::sorted`] adds a mesh and transforms each of its vertices once.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, mock_display::MockDisplay, pixelcolor::Gray8};
/// use pinhole::{prelude::*, target::BufferError, Angle};
/// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
/// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
/// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
/// let mut painter = Painter::<Gray8, 6, 2>::new();
/// for (z, luma) in [(0, 80), (-2, 40)] {
///     let model = Affine::<Model, World>::translation(Vector3::from_ints(0, 0, z));
///     camera.place(&mesh, &model).faces(|_face| Gray8::new(luma)).sorted(&mut painter)?;
/// }
/// assert!(matches!(
///     camera.place(&mesh, &Affine::identity()).faces(|_| Gray8::new(0)).sorted(&mut painter),
///     Err(BufferError::Full { parameter: "VERTICES", needed: 9, capacity: 6 }),
/// ));
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// let statistics = painter.draw(&mut display)?;
/// assert_eq!(statistics.drawn, 2);
/// assert_eq!(display.get_pixel(Point::new(16, 16)), Some(Gray8::new(80))); // the nearer one
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Painter<S, const VERTICES: usize, const FACES: usize> {
    vertices: [ScreenVertex; VERTICES],
    /// How many vertices belong to stored faces.
    used: usize,
    faces: Vec<Face<S>, FACES>,
    statistics: Statistics,
    /// The viewport of the stored faces.
    area: Option<Rectangle>,
}

/// A triangle to draw.
#[derive(Clone, Copy, Debug)]
struct Face<S> {
    vertices: [u16; 3],
    /// 0 far … 65535 near.
    key: u16,
    /// The index of the face to draw after this one.
    next: u16,
    shader: S,
}

/// The faces of a [`Painter`] from far to near, to be drawn more than once: [`Painter::order`] makes it, [`draw`](Self::draw)
/// draws one band.
#[must_use = "`.draw(&mut target)` draws the faces"]
#[derive(Clone, Copy, Debug)]
pub struct PaintersOrder<'a, S> {
    vertices: &'a [ScreenVertex],
    faces: &'a [Face<S>],
    first: u16,
    area: Option<Rectangle>,
    statistics: Statistics,
}

impl<S: Copy> PaintersOrder<'_, S> {
    /// Draws the faces that lie in the target, for instance in a band. With a depth buffer, whose shaders must be [`DepthTested`], it draws
    /// the pixels that are nearer than the buffer; their depth is stored if the shader [writes
    /// depth](crate::shading::SpanShader::WRITES_DEPTH).
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target>(&self, target: &mut T) -> Result<(), T::Error>
    where
        S: StoredShader<T::Surface, T::Test>,
    {
        target.dispatch(
            (),
            |(), surface| S::draw(self, surface, None),
            |(), surface, depth| S::draw(self, surface, Some(depth)),
        )
    }

    /// The pixels that may be drawn; `None` if there is no face.
    #[inline(always)]
    fn region(&self, target: &Rectangle, depth: Option<&DepthBuffer<'_>>) -> Option<DrawRegion> {
        Some(DrawRegion::shared(target, self.area.as_ref()?, depth))
    }

    /// Calls `draw` with the shader and the triangle of each face that may have pixels in the region.
    #[inline(always)]
    fn each<E>(
        &self,
        region: &DrawRegion,
        mut draw: impl FnMut(&S, Triangle<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut at = self.first;
        while let Some(face) = self.faces.get(usize::from(at)) {
            let points = self.points(face);
            if !Scissor::bounding_box(&points).intersection(&region.scissor).is_empty() {
                let triangle = Triangle::new(points, raster::area(&points), &region.viewport);
                draw(&face.shader, triangle)?;
            }
            at = face.next;
        }
        Ok(())
    }

    /// The corners of a stored face.
    #[inline(always)]
    fn points(&self, face: &Face<S>) -> [ScreenPoint; 3] {
        face.vertices.map(|i| self.vertices.get(usize::from(i)).map_or(ScreenPoint::ORIGIN, |c| c.point()))
    }

    /// How many faces were drawn, culled and clipped, summed over all meshes that were added.
    pub const fn statistics(&self) -> Statistics {
        self.statistics
    }
}

/// A shader that a [`Painter`] can store for a target with this [test](crate::target::Target::Test): with a depth buffer, a [`DepthTested`] one.
/// Implemented for every such shader.
#[diagnostic::on_unimplemented(
    message = "a painter's faces cannot be filled with `{Self}`",
    label = "not a shader for the target, or without the depths of its triangle",
    note = "into a target with a depth buffer, add faces whose shader is `DepthTested::new(..)` of another"
)]
pub trait StoredShader<T: Surface, Test>: Copy {
    /// Draws faces from far to near, with a depth buffer if the test is [`Tested`].
    #[doc(hidden)]
    fn draw(
        order: &PaintersOrder<'_, Self>,
        surface: &mut T,
        depth: Option<&mut DepthBuffer<'_>>,
    ) -> Result<(), T::Error> {
        let _ = (order, surface, depth);
        Ok(()) // never called: no target has the mark `Unmatched`
    }
}

impl<T: Surface, S: ShaderFor<T>> StoredShader<T, Unmatched> for S {}

impl<T: Surface, S: ShaderFor<T>> StoredShader<T, Untested> for S {
    #[inline(never)] // its stack frame is gone when it returns
    fn draw(
        order: &PaintersOrder<'_, S>,
        surface: &mut T,
        _: Option<&mut DepthBuffer<'_>>,
    ) -> Result<(), T::Error> {
        let Some(region) = order.region(&surface.area(), None) else { return Ok(()) };
        order.each(&region, |shader, triangle| fill(&triangle, shader, &region.scissor, false, surface))
    }
}

impl<T: Surface, S: ShaderFor<T>> StoredShader<T, Tested> for DepthTested<S> {
    #[inline(never)] // its stack frame is gone when it returns
    fn draw(
        order: &PaintersOrder<'_, Self>,
        surface: &mut T,
        depth: Option<&mut DepthBuffer<'_>>,
    ) -> Result<(), T::Error> {
        let Some(depth) = depth else { return Ok(()) }; // a test has one
        let Some(region) = order.region(&surface.area(), Some(depth)) else { return Ok(()) };
        let mut depth = DepthTarget::new(depth, surface);
        order.each(&region, |shader, triangle| {
            let (shader, depths) = shader.parts();
            let triangle = DepthTriangle { triangle, depths };
            fill_nearer(&triangle, shader, &region.scissor, false, &mut depth, surface)
        })
    }
}

impl<V: Coordinate, F, const CULLED_BY: u8> Faces<'_, V, F, CULLED_BY> {
    /// Stores the visible faces in a [`Painter`], which draws them and those of other objects from far to near. The closure is called once for
    /// each visible face. A face that is clipped takes vertices of its own; [culled by planes](Self::culled_by_planes) also a face with a
    /// corner farther out than a [`ScreenVertex`] can hold.
    ///
    /// # Errors
    ///
    /// [`BufferError`] if there is no room, or if the viewport differs from that of the stored faces. Nothing of this mesh is
    /// stored then; the faces of other meshes stay.
    pub fn sorted<S: Shader + Copy, const VERTICES: usize, const FACES: usize>(
        self,
        painter: &mut Painter<S, VERTICES, FACES>,
    ) -> Result<(), BufferError>
    where
        F: FnMut(usize) -> S,
    {
        painter.add::<V, CULLED_BY>(self.instance, self.shade)
    }
}

impl<S: Copy, const VERTICES: usize, const FACES: usize> Default for Painter<S, VERTICES, FACES> {
    fn default() -> Self {
        Self::new()
    }
}

/// No face: the end of a list.
const NONE: u16 = u16::MAX;

impl<S: Copy, const VERTICES: usize, const FACES: usize> Painter<S, VERTICES, FACES> {
    /// A painter without faces.
    pub const fn new() -> Self {
        let vertices = [ScreenVertex::EMPTY; VERTICES];
        Self { vertices, used: 0, faces: Vec::new(), statistics: Statistics::NONE, area: None }
    }

    /// Removes all faces.
    pub fn clear(&mut self) {
        self.used = 0;
        self.faces.clear();
        self.statistics = Statistics::default();
        self.area = None;
    }

    #[inline(never)] // its stack frame is gone when it returns
    fn add<V: Coordinate, const CULLED_BY: u8>(
        &mut self,
        instance: &MeshInstance<'_, V>,
        shade: impl FnMut(usize) -> S,
    ) -> Result<(), BufferError>
    where
        S: Shader,
    {
        let far = S::NEEDS_DEPTH || instance.vertex_transform().clips_at_far();
        let (vertices, mut recorder) = self.begin(instance)?;
        let statistics = if CULLED_BY != NOTHING {
            let mut cache = LazyCache::<V, true>::new(instance, far, vertices);
            let statistics = match CULLED_BY {
                PLANES => recorder.record(PlaneOrder::new(instance), &mut cache, false, shade),
                _ => recorder.record(ClusterOrder::new(instance), &mut cache, false, shade),
            };
            recorder.room.unpack(instance, false, cache.into_cache());
            statistics
        } else {
            let all = instance.mesh().vertices;
            transform_all::<V, true>(instance.vertex_transform(), far, all, vertices);
            let mut cache = TransformedMesh::with_cache(instance, far, vertices);
            let statistics = recorder.record(MeshOrder, &mut cache, true, shade);
            recorder.room.unpack(instance, true, vertices);
            statistics
        };
        let room = recorder.room;
        self.finish(&room, statistics)
    }

    /// Reserves the vertices of a mesh, as many as fit, and returns the recorder of its faces.
    fn begin<V: Coordinate>(
        &mut self,
        instance: &MeshInstance<'_, V>,
    ) -> Result<(&mut [ScreenVertex], Recorder<'_, S, FACES>), BufferError> {
        if self.used == 0 {
            self.area = Some(*instance.area());
        } else if self.area.as_ref() != Some(instance.area()) {
            return Err(BufferError::OtherViewport);
        }
        let (first, count) = (self.used, instance.mesh().vertices.len());
        let room =
            Room { first, vertices: first + count, first_face: self.faces.len(), faces: self.faces.len() };
        // A mesh that does not fit is reported by `finish`, when its needs are known.
        let vertices = self.vertices.get_mut(first..).unwrap_or_default();
        let (vertices, own) = vertices.split_at_mut(count.min(vertices.len()));
        Ok((vertices, Recorder { own: own.iter_mut(), faces: &mut self.faces, room }))
    }

    /// Keeps the faces of the mesh if all of them fit, and removes them otherwise.
    fn finish(&mut self, room: &Room, statistics: Statistics) -> Result<(), BufferError> {
        let (most_vertices, most_faces) = (VERTICES.min(65_536), FACES.min(usize::from(NONE)));
        let error = if room.vertices > most_vertices {
            BufferError::Full { parameter: "VERTICES", needed: room.vertices, capacity: most_vertices }
        } else if room.faces > most_faces {
            BufferError::Full { parameter: "FACES", needed: room.faces, capacity: most_faces }
        } else {
            self.used = room.vertices;
            self.statistics = self.statistics + statistics;
            return Ok(());
        };
        self.faces.truncate(room.first_face);
        Err(error)
    }

    /// Draws all faces from far to near and removes them, even if the target returns an error. With a depth buffer, see
    /// [`DepthTested`].
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(never)] // its stack frame is gone when it returns
    pub fn draw<T: Target>(&mut self, target: &mut T) -> Result<Statistics, T::Error>
    where
        S: StoredShader<T::Surface, T::Test>,
    {
        let order = self.order();
        let statistics = order.statistics();
        let result = order.draw(target);
        self.clear();
        result.map(|()| statistics)
    }

    /// Sorts the faces, to be drawn more than once: band by band. The faces stay until they are [cleared](Self::clear).
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?;
    /// let mut display = MockDisplay::<Gray8>::new();
    /// let viewport = Viewport::new(Point::zero(), display.size())?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let mut painter = Painter::<Gray8, 3, 1>::new();
    /// camera.place(&mesh, &Affine::identity()).faces(|_| Gray8::WHITE).sorted(&mut painter)?;
    /// let order = painter.order();
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     order.draw(&mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!((order.statistics().drawn, display.get_pixel(Point::new(32, 32))), (1, Some(Gray8::WHITE)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn order(&mut self) -> PaintersOrder<'_, S> {
        let first = self.sort();
        let (vertices, faces) = (&self.vertices, self.faces.as_slice());
        PaintersOrder { vertices, faces, first, area: self.area, statistics: self.statistics }
    }

    /// Links the faces by ascending key and returns the index of the first: a stable radix sort of linked lists, four digits of
    /// four bits, in time proportional to the number of faces and without memory beyond the links. (Knuth, *The Art of Computer
    /// Programming*, vol. 3, 2nd ed., section 5.2.5.)
    #[inline(never)] // its arrays leave the stack when it returns
    fn sort(&mut self) -> u16 {
        for (i, face) in self.faces.iter_mut().enumerate() {
            keep_rolled();
            // At most 65535 faces: see `add`. No face follows the last one, so its link ends the list.
            face.next = (i + 1) as u16;
        }
        let mut first = 0;
        for digit in 0..opaque(4u32) {
            // `opaque` prevents unrolling: four copies of the loop would be no faster.
            let shift = (4 * digit) & 15;
            // The list of each digit: its first face and its last face.
            let mut lists = [(NONE, NONE); 16];
            let mut at = first;
            while let Some(face) = self.faces.get_mut(usize::from(at)) {
                let next = face.next;
                face.next = NONE;
                if let Some((head, tail)) = lists.get_mut(usize::from(face.key >> shift & 15)) {
                    match self.faces.get_mut(usize::from(*tail)) {
                        Some(before) => before.next = at,
                        None => *head = at,
                    }
                    *tail = at;
                }
                at = next;
            }
            first = NONE;
            let mut end = NONE;
            for &(head, tail) in &lists {
                keep_rolled();
                if head == NONE {
                    continue;
                }
                match self.faces.get_mut(usize::from(end)) {
                    Some(before) => before.next = head,
                    None => first = head,
                }
                end = tail;
            }
        }
        first
    }
}

/// The vertices and faces that a mesh takes in a painter. They are counted even if they exceed the capacities.
struct Room {
    /// The index of the mesh's first vertex. `vertices`: the end of its vertices and those of its clipped faces.
    first: usize,
    vertices: usize,
    first_face: usize,
    faces: usize,
}

impl Room {
    /// Converts the mesh's vertices from packed screen vertices to points. `all`: also vertices that are not on the screen, or
    /// that lie farther out than a [`ScreenVertex`] can hold, because unclipped faces may refer to them.
    fn unpack<V: Coordinate>(
        &self,
        instance: &MeshInstance<'_, V>,
        all: bool,
        vertices: &mut [ScreenVertex],
    ) {
        let uncached = TransformedMesh::<V, true>::with_cache(instance, false, &[]);
        for (index, vertex) in vertices.iter_mut().enumerate() {
            let point = if vertex.is_on_screen() {
                Some(instance.vertex_transform().unpack::<true>(*vertex))
            } else if all {
                uncached.vertex(index as u16) // a mesh has at most 65536 vertices
            } else {
                None
            };
            // No face refers to a vertex without a point.
            *vertex = ScreenVertex::unpacked_point(point.map_or(ScreenPoint::ORIGIN, |vertex| vertex.point));
        }
    }
}

/// Stores the faces of one mesh in a painter.
struct Recorder<'p, S, const FACES: usize> {
    /// Room for the vertices of clipped faces.
    own: core::slice::IterMut<'p, ScreenVertex>,
    faces: &'p mut Vec<Face<S>, FACES>,
    room: Room,
}

impl<S: Shader, const FACES: usize> Recorder<'_, S, FACES> {
    /// Stores the triangles of a source's faces. `shares`: an unclipped face refers to the mesh's vertices even if they are not
    /// cached.
    #[inline(always)]
    fn record<'a, V: Coordinate + 'a>(
        &mut self,
        source: impl FaceSource,
        cache: &mut impl VertexCache<'a, V, true>,
        shares: bool,
        mut shade: impl FnMut(usize) -> S,
    ) -> Statistics {
        let viewport = Scissor::GUARD_BAND; // no gradient is computed
        let instance = cache.instance();
        let Ok(statistics) = each_face(source, cache, &viewport, |index, face, triangles| {
            let shared = !triangles.fan.is_cut() && (shares || triangles.fan.is_cached());
            draw_triangles(instance, face, triangles, &shade(index), |triangle, shader| {
                let vertices = match shared {
                    true => face.map(|index| self.room.first.wrapping_add(usize::from(index))),
                    false => self.own_vertices(triangle.triangle.corners()),
                };
                self.face(vertices, &triangle.depths, *shader);
                Ok::<(), Infallible>(())
            })?;
            Ok::<bool, Infallible>(true)
        });
        statistics
    }

    /// Stores the corners of a clipped face's triangle as three vertices of the painter, if there is room. Returns the indices
    /// that they have, or would have: they count in any case.
    #[cold]
    #[inline(never)]
    fn own_vertices(&mut self, corners: &[ScreenPoint; 3]) -> [usize; 3] {
        let first = self.room.vertices;
        self.room.vertices += 3;
        for corner in corners {
            if let Some(vertex) = self.own.next() {
                *vertex = ScreenVertex::unpacked_point(*corner);
            }
        }
        [first, first + 1, first + 2]
    }

    /// Stores a triangle if there is room, and counts it in any case.
    #[inline(always)]
    fn face(&mut self, vertices: [usize; 3], depths: &[i32; 3], shader: S) {
        self.room.faces += 1;
        let [a, b, c] = depths.map(|depth| (depth.unsigned_abs() + 128) >> 8); // to whole steps

        // The mean of three depths of at most 65534: 196602·21845 < 2³². 21845/2¹⁶ is slightly less than a third, but still
        // increases with the sum.
        let mean = ((a + b + c) * 21_845) >> 16;
        let _ = self.faces.push(Face {
            // If an index exceeds 65535, `finish` removes the mesh: the truncated index is never used.
            vertices: vertices.map(|index| index as u16),
            key: !(mean as u16),
            next: NONE,
            shader,
        });
    }
}

defmt_format!(
    [S, const VERTICES: usize, const FACES: usize] Painter<S, VERTICES, FACES>, self,
    "painter of {=usize}/{=usize} vertices, {=usize}/{=usize} faces: {}",
    self.used, VERTICES, self.faces.len(), FACES, self.statistics
);

defmt_format!(
    [S] PaintersOrder<'_, S>, self,
    "painter's order of {=usize} faces: {}", self.faces.len(), self.statistics
);
