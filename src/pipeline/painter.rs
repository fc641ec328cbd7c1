//! Painter's order: from far to near, over everything recorded.

use super::draw_region::DrawRegion;
use super::face_source::{FaceSource, MeshOrder};
use super::faces::{draw_triangles, each_face};
use super::fill::fill;
use super::instance::MeshInstance;
use super::plane_culled::PlaneCulled;
use super::statistics::Statistics;
use super::vertex_cache::{transform_all, LazyCache, TransformedMesh, VertexCache};
use crate::camera::ScreenVertex;
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;
use crate::raster::{self, Scissor, ScreenPoint, Triangle};
use crate::shading::{Shader, SpanShader};
use crate::surface::Target;
use core::convert::Infallible;
use core::hint::black_box;
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// Records faces of any number of placed meshes and draws them from far to near, without a depth
/// buffer.
///
/// BinnedFaces are ordered by the mean depth of their corners, in 65536 steps that are linear on the
/// screen; equal ones in the order recorded. Long faces beside short ones, and faces that pierce
/// each other, can come out wrong: that is painter's order. (Newell, Newell and Sancha, *A
/// solution to the hidden surface problem*, 1972, go further.)
///
/// Memory: 8 bytes per corner; 10 bytes and an ink (usually a colour) per face. Meshes are transformed when
/// recorded, each vertex once.
///
/// ```
/// use embedded_graphics::{geometry::{Point, Size}, mock_display::MockDisplay, pixelcolor::Gray8};
/// use pinhole::{
///     space::{Model, World}, Affine, Angle, Camera, Mesh, Painter, Point3, Projection, PainterError,
///     Scalar, Vector3, ViewTransform, Viewport,
/// };
/// const VERTICES: [[i16; 3]; 3] = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]];
/// const FACES: [[u16; 3]; 1] = [[0, 1, 2]];
/// let mesh = Mesh::new(&VERTICES, 0, &FACES)?;
/// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
/// let camera = Camera::new(
///     &ViewTransform::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
///     &Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_num(1), Scalar::from_num(9))?,
///     &viewport,
/// );
/// let mut painter = Painter::<Gray8, 6, 2>::new();
/// for (z, luma) in [(0, 80), (-2, 40)] {
///     let model = Affine::<Model, World>::translation(Vector3::from_ints(0, 0, z));
///     painter.add(&camera.place(&mesh, &model), |_face| Gray8::new(luma))?;
/// }
/// assert!(matches!(
///     painter.add(&camera.place(&mesh, &Affine::identity()), |_| Gray8::new(0)),
///     Err(PainterError::Vertices { needed: 9, capacity: 6 }),
/// ));
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// let statistics = painter.draw(&mut display)?;
/// assert_eq!(statistics.drawn, 2);
/// assert_eq!(display.get_pixel(Point::new(16, 16)), Some(Gray8::new(80))); // the nearer one
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Painter<I, const VERTICES: usize, const FACES: usize> {
    vertices: Vec<ScreenVertex, VERTICES>,
    faces: Vec<Face<I>, FACES>,
    statistics: Statistics,
    /// The viewport drawn into.
    area: Option<Rectangle>,
}

/// Why a mesh was not recorded: nothing of it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum PainterError {
    /// Raise `VERTICES` (65536 at most): every vertex takes one, and every corner of a face that
    /// was cut.
    Vertices {
        /// What this mesh would fill.
        needed: usize,
        /// What there is.
        capacity: usize,
    },
    /// Raise `FACES` (65535 at most): every face drawn takes one, and every piece of a face that
    /// was cut.
    Faces {
        /// What this mesh would fill.
        needed: usize,
        /// What there is.
        capacity: usize,
    },
    /// What is recorded already goes into another viewport: draw it first, or take two painters.
    OtherViewport,
}

impl core::fmt::Display for PainterError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Vertices { needed, capacity: 65_536 } => {
                write!(
                    f,
                    "{needed} vertices, but a painter holds at most 65536: record fewer meshes, or smaller ones"
                )
            }
            Self::Vertices { needed, capacity } => {
                write!(f, "{needed} vertices, but the painter has room for {capacity}: raise VERTICES")
            }
            Self::Faces { needed, capacity: 65_535 } => {
                write!(
                    f,
                    "{needed} faces, but a painter holds at most 65535: record fewer meshes, or smaller ones"
                )
            }
            Self::Faces { needed, capacity } => {
                write!(f, "{needed} faces, but the painter has room for {capacity}: raise FACES")
            }
            Self::OtherViewport => f.write_str("one painter draws into one viewport at a time"),
        }
    }
}

impl core::error::Error for PainterError {}

/// A triangle to draw.
#[derive(Clone, Copy, Debug)]
struct Face<I> {
    vertices: [u16; 3],
    /// 0 far … 65535 near.
    key: u16,
    /// The face to draw after this one.
    next: u16,
    shader: I,
}

/// All that a [`Painter`] recorded, from far to near: `painter.order()`, then `draw` for every band.
#[derive(Clone, Copy, Debug)]
pub struct PaintersOrder<'a, I> {
    vertices: &'a [ScreenVertex],
    faces: &'a [Face<I>],
    first: u16,
    area: Option<Rectangle>,
    statistics: Statistics,
}

impl<I: Copy> PaintersOrder<'_, I> {
    /// Draws what lies in the target, a band for instance.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn draw<T: Target>(&self, target: &mut T) -> Result<(), T::Error>
    where
        I: SpanShader<T::Color>,
    {
        let Some(area) = &self.area else { return Ok(()) };
        let region = DrawRegion::shared(&target.area(), area, None);
        let mut at = self.first;
        while let Some(face) = self.faces.get(usize::from(at)) {
            let points = face
                .vertices
                .map(|i| self.vertices.get(usize::from(i)).map_or(ScreenPoint::ORIGIN, |c| c.point()));
            if !Scissor::bounding_box(&points).intersection(&region.scissor).is_empty() {
                let triangle = Triangle::new(points, raster::area(&points), &region.viewport);
                fill(&triangle, &face.shader, &region.scissor, target)?;
            }
            at = face.next;
        }
        Ok(())
    }

    /// What became of the faces.
    pub const fn statistics(&self) -> Statistics {
        self.statistics
    }
}

/// No face: the end of a list.
const NONE: u16 = u16::MAX;

impl<I: Copy, const VERTICES: usize, const FACES: usize> Painter<I, VERTICES, FACES> {
    /// An empty recorder.
    pub const fn new() -> Self {
        Self { vertices: Vec::new(), faces: Vec::new(), statistics: Statistics::NONE, area: None }
    }

    /// Forgets what was recorded.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.faces.clear();
        self.statistics = Statistics::default();
        self.area = None;
    }

    /// Records the visible faces of a mesh. `shade` gives face `i` its shader, and is asked once for each face that is
    /// drawn.
    ///
    /// # Errors
    ///
    /// [`PainterError`] when there is no room, or the viewport is not that of the faces recorded before. Nothing of this
    /// mesh is recorded then; what was recorded before stays.
    #[inline(never)] // its frame is gone when it returns
    pub fn add<V: Coordinate>(
        &mut self,
        instance: &MeshInstance<'_, V>,
        shade: impl FnMut(usize) -> I,
    ) -> Result<(), PainterError>
    where
        I: Shader,
    {
        let far = instance.vertex_transform.clips_at_far();
        let (vertices, mut recorder) = self.begin(instance)?;
        transform_all::<V, true>(&instance.vertex_transform, far, instance.mesh.vertices(), vertices);
        let mut cache = TransformedMesh::with_cache(instance, false, vertices);
        let statistics = recorder.record(MeshOrder, &mut cache, true, shade);
        recorder.room.unpack(instance, true, vertices);
        let room = recorder.room;
        self.finish(&room, statistics)
    }

    /// Records the faces of a mesh that may be visible by their planes, as
    /// [`cull_by_planes`](MeshInstance::cull_by_planes) finds them. Only vertices that such a face needs are transformed.
    ///
    /// # Errors
    ///
    /// Those of [`add`](Self::add). A face that is cut, or has a corner farther out than a [`ScreenVertex`] holds, takes
    /// vertices of its own.
    #[inline(never)] // its frame is gone when it returns
    pub fn add_culled_by_planes<V: Coordinate>(
        &mut self,
        faces: &PlaneCulled<'_, V>,
        shade: impl FnMut(usize) -> I,
    ) -> Result<(), PainterError>
    where
        I: Shader,
    {
        let instance = faces.instance;
        let (vertices, mut recorder) = self.begin(instance)?;
        let far = instance.vertex_transform.clips_at_far();
        let mut cache = LazyCache::<V, true>::new(instance, far, vertices);
        let statistics = recorder.record(faces.source(), &mut cache, false, shade);
        let vertices = cache.into_cache();
        recorder.room.unpack(instance, false, vertices);
        let room = recorder.room;
        self.finish(&room, statistics)
    }

    /// Takes room for the vertices of a mesh, as many as there is room for, and what records its faces.
    fn begin<V>(
        &mut self,
        instance: &MeshInstance<'_, V>,
    ) -> Result<(&mut [ScreenVertex], Recorder<'_, I, FACES>), PainterError> {
        if self.vertices.is_empty() {
            self.area = Some(*instance.area());
        } else if self.area.as_ref() != Some(instance.area()) {
            return Err(PainterError::OtherViewport);
        }
        let (first, count) = (self.vertices.len(), instance.mesh.vertices().len());
        let room =
            Room { first, vertices: first + count, first_face: self.faces.len(), faces: self.faces.len() };
        // A mesh without room is reported at the end, with the room that all of it needs.
        let _ = self.vertices.resize_default(VERTICES);
        let vertices = self.vertices.get_mut(first..).unwrap_or_default();
        let (vertices, own) = vertices.split_at_mut(count.min(vertices.len()));
        Ok((vertices, Recorder { own: own.iter_mut(), faces: &mut self.faces, room }))
    }

    /// Keeps what was recorded if there was room for it, and drops it otherwise.
    fn finish(&mut self, room: &Room, statistics: Statistics) -> Result<(), PainterError> {
        let (most_vertices, most_faces) = (VERTICES.min(65_536), FACES.min(usize::from(NONE)));
        let error = if room.vertices > most_vertices {
            PainterError::Vertices { needed: room.vertices, capacity: most_vertices }
        } else if room.faces > most_faces {
            PainterError::Faces { needed: room.faces, capacity: most_faces }
        } else {
            self.vertices.truncate(room.vertices);
            self.statistics = self.statistics.and(statistics);
            return Ok(());
        };
        self.vertices.truncate(room.first);
        self.faces.truncate(room.first_face);
        if room.first == 0 {
            self.area = None;
        }
        Err(error)
    }

    /// Draws all that was recorded, far to near, and forgets it: also when the target refuses.
    ///
    /// # Errors
    ///
    /// The target's own, at the first span that it refuses.
    #[inline(never)] // its frame is gone when it returns
    pub fn draw<T: Target>(&mut self, target: &mut T) -> Result<Statistics, T::Error>
    where
        I: SpanShader<T::Color>,
    {
        let order = self.order();
        let statistics = order.statistics();
        let result = order.draw(target);
        self.clear();
        result.map(|()| statistics)
    }

    /// Puts all that was recorded in order, to be drawn more than once: band by band. What was
    /// recorded stays until it is [cleared](Self::clear).
    ///
    /// ```
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// # use pinhole::{Affine, Angle, Camera, ScreenVertex, Frame, Mesh, Painter, Point3, Projection, Scalar, Vector3, ViewTransform, Viewport};
    /// # let mesh = Mesh::new(&[[-1, -1, 0], [1, -1, 0], [0, 1, 0]], 0, &[[0, 1, 2]])?.with_edges(&[[0, 1], [1, 2], [2, 0]])?;
    /// # let mut display = MockDisplay::<Gray8>::new();
    /// # let viewport = Viewport::new(Point::zero(), display.size())?;
    /// # let view = ViewTransform::look_at(Point3::from_ints(0, 0, 4), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?;
    /// # let [near, far] = [1, 9].map(Scalar::from_num);
    /// # let lens = Projection::perspective(Angle::degrees(40), viewport.size(), near, far)?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// # let mut strip = [0; Frame::<Gray8>::strip_bytes(64, 8)];
    /// let mut painter = Painter::<Gray8, 3, 1>::new();
    /// painter.add(&camera.place(&mesh, &Affine::identity()), |_| Gray8::WHITE)?;
    /// let order = painter.order();
    /// let mut frame = Frame::new(display.bounding_box(), Gray8::BLACK);
    /// while let Some(mut band) = frame.next_band(&mut strip)? {
    ///     order.draw(&mut band.pixels())?;
    ///     band.send(&mut display)?;
    /// }
    /// assert_eq!((order.statistics().drawn, display.get_pixel(Point::new(32, 32))), (1, Some(Gray8::WHITE)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn order(&mut self) -> PaintersOrder<'_, I> {
        let first = self.sort();
        let (vertices, faces) = (self.vertices.as_slice(), self.faces.as_slice());
        PaintersOrder { vertices, faces, first, area: self.area, statistics: self.statistics }
    }

    /// Links the faces by rising key and gives the first: a radix sort of lists, four digits of
    /// four bits, stable, in time proportional to the number of faces and with no memory beside
    /// the links. (Knuth, *The Art of Computer Programming*, vol. 3, 2nd ed., section 5.2.5.)
    #[inline(never)] // its lists are gone when it returns
    fn sort(&mut self) -> u16 {
        let count = self.faces.len();
        for (i, face) in self.faces.iter_mut().enumerate() {
            keep_rolled();
            // Fewer than 65536 faces: see `add`.
            face.next = if i + 1 < count { (i + 1) as u16 } else { NONE };
        }
        let mut first = if count == 0 { NONE } else { 0 };
        for digit in 0..black_box(4u32) {
            // Four times the same code would be no faster.
            let shift = (4 * digit) & 15;
            // Each digit's list: its first face and its last.
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

/// The room that a mesh takes in a painter, counted beyond what there is.
struct Room {
    /// The first vertex of the mesh, and the end of its vertices and those of its cut faces.
    first: usize,
    vertices: usize,
    first_face: usize,
    faces: usize,
}

impl Room {
    /// Turns the vertices of the mesh from packed ones to points on the screen. `all`: also those that are not on the
    /// screen or farther out than a [`ScreenVertex`] holds, as a face that is not cut may refer to them.
    fn unpack<V: Coordinate>(
        &self,
        instance: &MeshInstance<'_, V>,
        all: bool,
        vertices: &mut [ScreenVertex],
    ) {
        let uncached = TransformedMesh::<V, true>::with_cache(instance, false, &[]);
        for (index, vertex) in vertices.iter_mut().enumerate() {
            let point = if vertex.is_on_screen() {
                Some(instance.vertex_transform.unpack::<true>(*vertex))
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

/// Records the faces of a mesh.
struct Recorder<'p, I, const FACES: usize> {
    /// Room for vertices of cut faces.
    own: core::slice::IterMut<'p, ScreenVertex>,
    faces: &'p mut Vec<Face<I>, FACES>,
    room: Room,
}

impl<I: Shader, const FACES: usize> Recorder<'_, I, FACES> {
    /// Records the triangles of the faces of a source. `shares`: a face that is not cut refers to the mesh's vertices also
    /// where they are not in the cache.
    #[inline(always)]
    fn record<'a, V: Coordinate + 'a>(
        &mut self,
        source: impl FaceSource,
        cache: &mut impl VertexCache<'a, V, true>,
        shares: bool,
        mut shade: impl FnMut(usize) -> I,
    ) -> Statistics {
        let viewport = Scissor::GUARD_BAND; // no gradient is asked for
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

    /// Stores the corners of a cut face if there is room, and counts them in any case.
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
    fn face(&mut self, vertices: [usize; 3], depths: &[i32; 3], shader: I) {
        self.room.faces += 1;
        let [a, b, c] = depths.map(|depth| (depth.unsigned_abs() + 128) >> 8); // to whole steps

        // The mean of three depths of at most 65534: 196602·21845 < 2³², and 21845/2¹⁶ falls short
        // of a third by so little that the order of sums is kept.
        let mean = ((a + b + c) * 21_845) >> 16;
        let _ = self.faces.push(Face {
            // Beyond 65535 the mesh is refused at the end, and these never meet a picture.
            vertices: vertices.map(|index| index as u16),
            key: !(mean as u16),
            next: NONE,
            shader,
        });
    }
}

#[cfg(feature = "defmt")]
impl<I, const VERTICES: usize, const FACES: usize> defmt::Format for Painter<I, VERTICES, FACES> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let (vertices, faces) = (self.vertices.len(), self.faces.len());
        defmt::write!(
            f,
            "painter of {=usize}/{=usize} vertices, {=usize}/{=usize} faces: {}",
            vertices,
            VERTICES,
            faces,
            FACES,
            self.statistics
        );
    }
}

#[cfg(feature = "defmt")]
impl<I> defmt::Format for PaintersOrder<'_, I> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "painter's order of {=usize} faces: {}", self.faces.len(), self.statistics);
    }
}
