//! Vertices on the screen: transformed once into memory that the caller provides.
//!
//! Two caches: [`TransformedMesh`] transforms all vertices before the first face, [`LazyCache`] a vertex when the first
//! face that needs it is drawn.

use super::instance::MeshInstance;
use crate::camera::{ScreenVertex, UnpackedVertex, VertexTransform};
use crate::math::hints::keep_rolled;
use crate::math::Coordinate;
use crate::raster::{self, ScreenPoint};
use core::hint::black_box;

/// A cache of a mesh's vertices, as the face loop asks it.
pub(super) trait VertexCache<'a, V, const DEPTH: bool> {
    /// Whether all faces that the loop meets were culled before: then the loop does not test them again.
    const CULLED: bool = false;

    /// The corners of a face, if the cache holds all of them and they lie on the screen.
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]>;

    /// The corners that [`corners`](Self::corners) returned for this face before, from memory where that saves registers.
    fn corners_again(&mut self, face: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]>;

    /// The instance whose vertices are cached.
    fn instance(&self) -> &'a MeshInstance<'a, V>;

    /// A view of the cache that transforms nothing.
    fn view(&self) -> TransformedMesh<'_, V, DEPTH>;
}

/// A mesh instance with its vertices on the screen, each transformed once. `DEPTH`: with their depths.
///
/// Vertices beyond the end of the cache are transformed whenever a face or an edge needs them: the picture is the same, so
/// a mesh may have more vertices than its cache. [`MeshInstance::transform`] has an example.
#[derive(Debug)]
pub struct TransformedMesh<'a, V = i16, const DEPTH: bool = false> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    /// Whether the far plane cuts.
    pub(super) far: bool,
    cache: &'a [ScreenVertex],
}

// Not derived: V need not be Clone behind a reference.
impl<V, const DEPTH: bool> Clone for TransformedMesh<'_, V, DEPTH> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<V, const DEPTH: bool> Copy for TransformedMesh<'_, V, DEPTH> {}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Transforms every vertex once, without depth, for drawing in bands. Vertices beyond the end of `cache` are
    /// transformed again whenever they are needed.
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
    pub fn transform<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V> {
        TransformedMesh::new(self, cache)
    }

    /// Like [`transform`](Self::transform), with depth, for drawing against depth strips. What lies beyond the far
    /// plane is clipped, whatever the camera says.
    pub fn transform_depth<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V, true> {
        TransformedMesh::new(self, cache)
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
        let vertex = TransformedMesh::<V, true>::with_cache(self, false, &[]).vertex(index)?;
        Some((vertex.point, vertex.step()))
    }

    /// Where vertex `index` lies before its place is rounded to 1/256 px: x and y in 2⁻³² px, and depth
    /// in 2⁻³² of its 65536 steps, not cut off at either end. For measuring. `None` when there is no
    /// such vertex, or it lies in front of the near plane; what is beyond ±2³⁰ saturates.
    pub fn project_unsnapped(&self, index: usize) -> Option<[i64; 3]> {
        let vertex = *self.mesh.vertices().get(index)?;
        let h = self.vertex_transform.clip(vertex);
        let [_, _, d, w] = h.xydw;
        (d >= 0 && w > 0).then(|| self.vertex_transform.unsnapped(&h))
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Transforms the vertices from the start of the vertex list into the cache. With depth the far plane cuts, whatever
    /// the camera says.
    pub(super) fn new(instance: &'a MeshInstance<'_, V>, cache: &'a mut [ScreenVertex]) -> Self {
        let far = DEPTH || instance.vertex_transform.clips_at_far();
        transform_all::<V, DEPTH>(&instance.vertex_transform, far, instance.mesh.vertices(), cache);
        // A length that the compiler does not know is compared in one instruction, many a constant in two. Without depth
        // the constant is better: no register is left for the length.
        let cache: &[ScreenVertex] = if DEPTH { black_box(cache) } else { cache };
        Self::with_cache(instance, DEPTH, cache)
    }

    /// A view of a cache that was filled elsewhere. `far`: the far plane cuts, whatever the camera says.
    #[inline(always)]
    pub(super) fn with_cache(
        instance: &'a MeshInstance<'_, V>,
        far: bool,
        cache: &'a [ScreenVertex],
    ) -> Self {
        Self { instance, far: far || instance.vertex_transform.clips_at_far(), cache }
    }

    /// A vertex: from the cache, or transformed again if the cache does not hold it.
    #[inline(always)]
    pub(super) fn screen_vertex(&self, index: u16) -> ScreenVertex {
        match self.cache.get(usize::from(index)) {
            Some(vertex) => *vertex,
            None => self.uncached(index),
        }
    }

    #[cold]
    #[inline(never)]
    fn uncached(&self, index: u16) -> ScreenVertex {
        let mut vertex = [ScreenVertex::EMPTY];
        // Mesh has checked that there is such a vertex.
        let vertices = self.instance.mesh.vertices().get(usize::from(index)..).unwrap_or_default();
        transform_all::<V, DEPTH>(&self.instance.vertex_transform, self.far, vertices, &mut vertex);
        let [vertex] = vertex;
        vertex
    }

    /// The corners of a face, if the cache holds all of them and they lie on the screen.
    #[inline(always)]
    pub(super) fn on_screen(&self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        let corners = self.cached(face)?;
        corners.iter().all(|corner| corner.is_on_screen()).then_some(corners.map(|corner| *corner))
    }

    #[inline(always)]
    fn cached(&self, &[a, b, c]: &[u16; 3]) -> Option<[&ScreenVertex; 3]> {
        let corner = |index: u16| self.cache.get(usize::from(index));
        Some([corner(a)?, corner(b)?, corner(c)?])
    }

    /// The corners' positions on the screen, with their depths.
    #[inline(always)]
    pub(super) fn unpack(&self, corners: [ScreenVertex; 3]) -> [UnpackedVertex; 3] {
        corners.map(|corner| self.instance.vertex_transform.unpack::<DEPTH>(corner))
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for TransformedMesh<'a, V, DEPTH> {
    #[inline(always)]
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        self.on_screen(face)
    }

    #[inline(always)]
    fn corners_again(&mut self, face: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]> {
        if DEPTH {
            // With depth, culling needs the registers that the corners are in: they are loaded again.
            return Some(self.cached(black_box(face))?.map(|corner| *corner));
        }
        Some(corners)
    }

    #[inline(always)]
    fn instance(&self) -> &'a MeshInstance<'a, V> {
        self.instance
    }

    #[inline(always)]
    fn view(&self) -> TransformedMesh<'_, V, DEPTH> {
        *self
    }
}

/// The cache of faces that were binned, and culled then.
pub(super) struct BinnedVertices<'a, V, const DEPTH: bool>(pub(super) TransformedMesh<'a, V, DEPTH>);

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for BinnedVertices<'a, V, DEPTH> {
    const CULLED: bool = true;

    #[inline(always)]
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        self.0.on_screen(face)
    }

    #[inline(always)]
    fn corners_again(&mut self, _: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]> {
        Some(corners)
    }

    #[inline(always)]
    fn instance(&self) -> &'a MeshInstance<'a, V> {
        self.0.instance
    }

    #[inline(always)]
    fn view(&self) -> TransformedMesh<'_, V, DEPTH> {
        self.0
    }
}

/// A cache that transforms a vertex when it is asked for it the first time.
pub(super) struct LazyCache<'a, 'c, V, const DEPTH: bool> {
    instance: &'a MeshInstance<'a, V>,
    /// Whether the far plane cuts.
    far: bool,
    cache: &'c mut [ScreenVertex],
}

impl<'a, 'c, V: Coordinate, const DEPTH: bool> LazyCache<'a, 'c, V, DEPTH> {
    /// Marks all vertices as not transformed. `far`: the far plane cuts.
    #[inline(always)]
    pub(super) fn new(instance: &'a MeshInstance<'a, V>, far: bool, cache: &'c mut [ScreenVertex]) -> Self {
        let count = instance.mesh.vertices().len().min(cache.len());
        let cache = cache.get_mut(..count).unwrap_or_default();
        // A value that the compiler does not know: it would call its `memset` for zeros, which is slower.
        let empty = black_box(ScreenVertex::EMPTY);
        for vertex in cache.iter_mut() {
            *vertex = empty;
        }
        Self { instance, far, cache }
    }

    /// The vertices, those that no face needed among them: these are empty.
    pub(super) fn into_cache(self) -> &'c mut [ScreenVertex] {
        self.cache
    }

    /// A vertex, transformed now if it was not before. `None` for a vertex that is not on the screen or has no room in the
    /// cache.
    #[inline(always)]
    fn vertex(&mut self, index: u16) -> Option<ScreenVertex> {
        let vertex = self.cache.get_mut(usize::from(index))?;
        if !vertex.is_on_screen() {
            transform_one::<V, DEPTH>(self.instance, self.far, index, vertex);
            if !vertex.is_on_screen() {
                return None;
            }
        }
        Some(*vertex)
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for LazyCache<'a, '_, V, DEPTH> {
    #[inline(always)]
    fn corners(&mut self, &[a, b, c]: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        Some([self.vertex(a)?, self.vertex(b)?, self.vertex(c)?])
    }

    #[inline(always)]
    fn corners_again(&mut self, _: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]> {
        Some(corners)
    }

    #[inline(always)]
    fn instance(&self) -> &'a MeshInstance<'a, V> {
        self.instance
    }

    #[inline(always)]
    fn view(&self) -> TransformedMesh<'_, V, DEPTH> {
        TransformedMesh::with_cache(self.instance, self.far, self.cache)
    }
}

/// Twice the area of a face with these corners on the screen, positive counter-clockwise with y up.
#[inline(always)]
pub(super) fn area<const DEPTH: bool>(corners: &[ScreenVertex; 3]) -> i64 {
    raster::area(&corners.map(|corner| corner.offset::<DEPTH>()))
}

#[inline(never)] // the transform gets all registers
fn transform_one<V: Coordinate, const DEPTH: bool>(
    instance: &MeshInstance<'_, V>,
    far: bool,
    index: u16,
    to: &mut ScreenVertex,
) {
    let MeshInstance { vertex_transform, mesh, .. } = instance;
    if let Some(vertex) = mesh.vertices().get(usize::from(index)) {
        *to = vertex_transform.project::<V, DEPTH>(vertex, vertex_transform.needs_d(DEPTH, far), far);
    }
}

/// The vertex loop. `far`: the far plane cuts.
#[inline(never)] // one copy, for cached and uncached vertices
pub(super) fn transform_all<V: Coordinate, const DEPTH: bool>(
    vertex_transform: &VertexTransform,
    far: bool,
    vertices: &[[V; 3]],
    cache: &mut [ScreenVertex],
) {
    let by_d = vertex_transform.needs_d(DEPTH, far);
    // Somewhere, and perhaps changed in every turn: so nothing of it is brought into registers, of which there are too
    // few, before the loop, and its numbers are loaded in pairs. RISC-V has twice as many registers, and no such loads; on a
    // Cortex-M0 the loop with depth has so much in memory that it costs nothing to have it all on the stack.
    #[cfg(target_arch = "arm")]
    let vertex_transform = match !crate::math::cores::CORTEX_M0 || !DEPTH {
        true => black_box(vertex_transform),
        false => vertex_transform,
    };
    for (packed, vertex) in pairs(cache, vertices) {
        keep_rolled();
        *packed = vertex_transform.project::<V, DEPTH>(vertex, by_d, far);
    }
}

/// Both side by side, as many as there are of both.
#[cfg(not(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32")))]
#[inline(always)]
fn pairs<'a, A, B>(cache: &'a mut [A], vertices: &'a [B]) -> impl Iterator<Item = (&'a mut A, &'a B)> {
    cache.iter_mut().zip(vertices)
}

/// The same by two pointers and one count in place of an index, where normalising w is a loop: the compiler makes them of an
/// index in innermost loops alone.
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
#[inline(always)]
fn pairs<'a, A, B>(cache: &'a mut [A], vertices: &'a [B]) -> impl Iterator<Item = (&'a mut A, &'a B)> {
    let kept = cache.len().min(vertices.len());
    let mut cache = cache.get_mut(..kept).unwrap_or_default();
    let mut vertices = vertices.get(..kept).unwrap_or_default();
    core::iter::from_fn(move || {
        let (packed, vertex);
        (packed, cache) = core::mem::take(&mut cache).split_first_mut()?;
        (vertex, vertices) = vertices.split_first()?;
        Some((packed, vertex))
    })
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for TransformedMesh<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{}, {=usize} vertices cached", self.instance, self.cache.len());
    }
}
