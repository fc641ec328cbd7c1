//! The vertex caches: screen vertices in caller-provided memory, each transformed once.
//!
//! [`TransformedMesh`] transforms all vertices before the first face; [`LazyCache`] transforms a vertex when the first face
//! needs it.

use super::instance::MeshInstance;
use crate::camera::CameraError;
use crate::camera::{Projected, ScreenVertex, UnpackedVertex, VertexTransform};
use crate::math::hints::{keep_rolled, opaque};
use crate::math::unrolled::map3;
use crate::math::Coordinate;
use crate::raster;

/// A vertex cache, as the face loop sees it.
pub(super) trait VertexCache<'a, V: Coordinate, const DEPTH: bool> {
    /// Whether all faces that the loop meets were culled before: then the loop does not test them again.
    const CULLED: bool = false;

    /// The corners of a face, if the cache holds all of them and they lie on the screen.
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]>;

    /// The `corners` that [`corners`](Self::corners) returned for this face, loaded again if that saves registers.
    #[inline(always)]
    fn reload_corners(&mut self, _face: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]> {
        Some(corners)
    }

    /// The instance whose vertices are cached.
    fn instance(&self) -> &'a MeshInstance<'a, V>;

    /// A read-only view of the cache.
    fn view(&self) -> TransformedMesh<'_, V, DEPTH>;

    /// A read-only view of the cache, which has all corners of this face as far as it has room for them.
    #[inline(always)]
    fn view_with_corners(&mut self, _face: &[u16; 3]) -> TransformedMesh<'_, V, DEPTH> {
        self.view()
    }
}

/// A mesh instance with its vertices transformed to the screen, each once, for drawing in bands: the next step is
/// [`bin_faces`](Self::bin_faces) or [`bin_edges`](Self::bin_edges). With `DEPTH` the vertices have depth.
///
/// [`MeshInstance::transform`] makes it; [`MeshInstance::transform_depth`] makes it with depth. The vertices
/// lie in a caller-provided cache, which may be shorter than the mesh's vertex list: vertices beyond its end are transformed
/// whenever a face or an edge needs them, and the picture is equal.
#[derive(Clone, Copy, Debug)]
pub struct TransformedMesh<'a, V: Coordinate = i16, const DEPTH: bool = true> {
    pub(super) instance: &'a MeshInstance<'a, V>,
    /// Whether the far plane clips.
    pub(super) far: bool,
    pub(super) cache: &'a [ScreenVertex],
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// Transforms the mesh's vertices once, without depth, for drawing in bands. `cache` holds one screen vertex per vertex of
    /// the mesh; if it is shorter, vertices beyond its end are transformed whenever they are needed.
    ///
    /// The next step is to [bin faces](TransformedMesh::bin_faces) or [edges](TransformedMesh::bin_edges), or both. For a depth test, or fog, call
    /// [`transform_depth`](Self::transform_depth) instead.
    pub fn transform<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V, false> {
        TransformedMesh::new(self, cache)
    }

    /// Transforms the mesh's vertices once, with depth, for depth-tested bands. `cache` is as in
    /// [`transform`](Self::transform). Faces and edges are clipped at the far plane, even if the camera [does not
    /// clip](crate::Camera::with_far_clip) there.
    pub fn transform_depth<'a>(&'a self, cache: &'a mut [ScreenVertex]) -> TransformedMesh<'a, V, true> {
        TransformedMesh::new(self, cache)
    }

    /// Projects vertex `index`: its screen point and its depth.
    ///
    /// **Error.** For 480 × 320 pixels and focal lengths up to 700 px, the point is within 1/256 px of the exact image of the
    /// quantised input, including the rounding to 1/256 px, for objects whose half extent is at most 300 times the vertex's
    /// distance; for larger objects it is within `1/512 + 6.5·10⁻⁶ · extent/distance` px. ARCHITECTURE.md has the formula for
    /// all other pictures. Under these conditions depth is within 1 of `65535·(z/w + 1)/2` if far is at least twice near;
    /// otherwise its error grows as far/(far − near).
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{camera::CameraError, meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mesh = Mesh::new(&[[0, 0, 0], [0, 0, 8]], 0, &[])?;
    /// let instance = camera.place(&mesh, &Affine::identity());
    /// let seen = instance.project(0)?;
    /// assert_eq!((seen.point.x(), seen.point.y()), (32 * 256, 32 * 256)); // the centre of 64 × 64 pixels
    /// assert!(seen.depth > 0 && seen.depth < 65_534);
    /// assert_eq!(instance.project(1), Err(CameraError::BeforeNear)); // behind the eye
    /// assert_eq!(instance.project(2), Err(CameraError::NoVertex));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError`] if the mesh has no such vertex, or if the vertex lies in front of the near plane, outside the guard band
    /// or, if the camera clips there, beyond the far plane.
    pub fn project(&self, index: usize) -> Result<Projected, CameraError> {
        if let Some(seen) = self.projected(index) {
            return Ok(seen);
        }
        let vertex = *self.mesh().vertices.get(index).ok_or(CameraError::NoVertex)?;
        let transform = self.vertex_transform();
        Err(transform.why_not_projected(&transform.clip(vertex)).unwrap_or(CameraError::OutsideGuardBand))
    }

    /// Vertex `index` before it is rounded to 1/256 px, for measurements: x and y in 2⁻³² px, and depth in 2⁻³² of its 65536
    /// steps, not clamped to the range of depth. `None` if the mesh has no such vertex, or if it lies in front of the near
    /// plane. Values beyond ±2³⁰ saturate.
    pub fn project_unsnapped(&self, index: usize) -> Option<[i64; 3]> {
        let vertex = *self.mesh().vertices.get(index)?;
        let h = self.vertex_transform().clip(vertex);
        let [_, _, d, w] = h.xydw;
        (d >= 0 && w > 0).then(|| self.vertex_transform().unsnapped(&h))
    }
}

impl<V: Coordinate> MeshInstance<'_, V> {
    /// A projected vertex; `None` if it is not on the screen.
    fn projected(&self, index: usize) -> Option<Projected> {
        let index = u16::try_from(index).ok().filter(|_| index < self.mesh().vertices.len())?;
        let vertex = TransformedMesh::<V, true>::with_cache(self, false, &[]).vertex(index)?;
        Some(Projected { point: vertex.point, depth: vertex.step() })
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Transforms as many vertices as fit into the cache; the others are transformed when a face needs them. With `DEPTH`, for
    /// drawing with a depth buffer, faces are clipped at the far plane even if the camera does not clip there.
    pub(super) fn new(instance: &'a MeshInstance<'_, V>, cache: &'a mut [ScreenVertex]) -> Self {
        let far = DEPTH || instance.vertex_transform().clips_at_far();
        transform_all::<V, DEPTH>(instance.vertex_transform(), far, instance.mesh().vertices, cache);
        Self::of_full_cache(instance, cache)
    }

    /// The mesh with a cache whose vertices are all transformed.
    #[inline(always)]
    pub(super) fn of_full_cache(instance: &'a MeshInstance<'_, V>, cache: &'a [ScreenVertex]) -> Self {
        // With depth, `opaque` hides the length of the cache: comparing with a register takes one instruction, with many
        // constants two. Without depth no register is left for the length, and the constant is better.
        Self::with_cache(instance, DEPTH, if DEPTH { opaque(cache) } else { cache })
    }

    /// A view of a cache that already holds screen vertices. `far`: whether faces are clipped at the far plane.
    #[inline(always)]
    pub(super) fn with_cache(
        instance: &'a MeshInstance<'_, V>,
        far: bool,
        cache: &'a [ScreenVertex],
    ) -> Self {
        let far = far || instance.vertex_transform().clips_at_far();
        Self { instance, far, cache }
    }

    /// A vertex: from the cache, or transformed again if the cache does not hold it.
    #[inline(always)]
    pub(super) fn screen_vertex(&self, index: u16) -> ScreenVertex {
        match self.cache.get(usize::from(index)) {
            Some(vertex) => *vertex,
            None => self.uncached(index),
        }
    }

    /// A vertex, if the cache holds it.
    #[inline(always)]
    pub(super) fn cached_vertex(&self, index: u16) -> Option<ScreenVertex> {
        self.cache.get(usize::from(index)).copied()
    }

    #[cold]
    #[inline(never)]
    fn uncached(&self, index: u16) -> ScreenVertex {
        let mut vertex = [ScreenVertex::EMPTY];
        // `Mesh` has checked that this vertex exists.
        let vertices = self.instance.mesh().vertices.get(usize::from(index)..).unwrap_or_default();
        transform_all::<V, DEPTH>(self.instance.vertex_transform(), self.far, vertices, &mut vertex);
        let [vertex] = vertex;
        vertex
    }

    /// The corners of a face, if the cache holds all of them and they lie on the screen.
    #[inline(always)]
    pub(super) fn on_screen(&self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        let corners = self.cached(face)?;
        let [a, b, c] = corners;
        (a.is_on_screen() && b.is_on_screen() && c.is_on_screen()).then_some([*a, *b, *c])
    }

    #[inline(always)]
    fn cached(&self, &[a, b, c]: &[u16; 3]) -> Option<[&ScreenVertex; 3]> {
        let corner = |index: u16| self.cache.get(usize::from(index));
        Some([corner(a)?, corner(b)?, corner(c)?])
    }

    /// The corners of a face, if they lie on the screen, where code size matters more than speed: vertices that the cache does
    /// not hold are transformed again.
    #[cold]
    #[inline(never)]
    pub(super) fn uncached_corners(&self, &[a, b, c]: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        let mut corners = [ScreenVertex::EMPTY; 3];
        for (corner, index) in corners.iter_mut().zip([a, b, c]) {
            keep_rolled();
            *corner = self.screen_vertex(index);
            if !corner.is_on_screen() {
                return None;
            }
        }
        Some(corners)
    }

    /// The corners as 24.8 points, with their depths.
    #[inline(always)]
    pub(super) fn unpack(&self, corners: [ScreenVertex; 3]) -> [UnpackedVertex; 3] {
        map3(corners, |corner| self.instance.vertex_transform().unpack::<DEPTH>(corner))
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for TransformedMesh<'a, V, DEPTH> {
    #[inline(always)]
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        self.on_screen(face).or_else(|| if V::CLIPS { None } else { self.uncached_corners(face) })
    }

    #[inline(always)]
    fn reload_corners(&mut self, face: &[u16; 3], corners: [ScreenVertex; 3]) -> Option<[ScreenVertex; 3]> {
        if DEPTH && V::CLIPS {
            // With depth, culling needs the registers of the corners: load the corners again.
            return self.cached(opaque(face)).map(|[a, b, c]| [*a, *b, *c]);
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

/// The vertex cache of binned faces, which were culled when they were binned.
pub(super) struct BinnedVertices<'a, V: Coordinate, const DEPTH: bool>(
    pub(super) TransformedMesh<'a, V, DEPTH>,
);

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for BinnedVertices<'a, V, DEPTH> {
    const CULLED: bool = true;

    #[inline(always)]
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        self.0.corners(face)
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

/// A vertex cache that transforms a vertex at its first use.
pub(super) struct LazyCache<'a, 'c, V: Coordinate, const DEPTH: bool> {
    instance: &'a MeshInstance<'a, V>,
    /// Whether the far plane clips.
    far: bool,
    cache: &'c mut [ScreenVertex],
}

impl<'a, 'c, V: Coordinate, const DEPTH: bool> LazyCache<'a, 'c, V, DEPTH> {
    /// Marks all vertices as not transformed. `far`: the far plane clips.
    #[inline(always)]
    pub(super) fn new(instance: &'a MeshInstance<'a, V>, far: bool, cache: &'c mut [ScreenVertex]) -> Self {
        let count = instance.mesh().vertices.len().min(cache.len());
        let cache = cache.get_mut(..count).unwrap_or_default();
        // `opaque` hides that the value is zero: LLVM would call `memset`, which is slower.
        let empty = opaque(ScreenVertex::EMPTY);
        for vertex in cache.iter_mut() {
            *vertex = empty;
        }
        Self { instance, far, cache }
    }

    /// The vertices of the cache. A vertex that no face needed is empty.
    pub(super) fn into_cache(self) -> &'c mut [ScreenVertex] {
        self.cache
    }

    /// A vertex, transformed at its first use. `None` if it is not on the screen, or lies beyond the end of the cache.
    #[inline(always)]
    fn vertex(&mut self, index: u16) -> Option<ScreenVertex> {
        let vertex = self.cache.get_mut(usize::from(index))?;
        if !vertex.is_on_screen() {
            if vertex.planes().is_some() {
                return None;
            }
            transform_one::<V, DEPTH>(self.instance, self.far, index, vertex);
            if !vertex.is_on_screen() {
                return None;
            }
        }
        Some(*vertex)
    }

    /// Transforms the corners of a face that are not transformed yet.
    #[cold]
    #[inline(never)]
    fn transform_corners(&mut self, face: &[u16; 3]) {
        for &index in face {
            keep_rolled();
            let _ = self.vertex(index);
        }
    }
}

impl<'a, V: Coordinate, const DEPTH: bool> VertexCache<'a, V, DEPTH> for LazyCache<'a, '_, V, DEPTH> {
    #[inline(always)]
    fn corners(&mut self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        let &[a, b, c] = face;
        if V::CLIPS {
            return Some([self.vertex(a)?, self.vertex(b)?, self.vertex(c)?]);
        }
        match (self.vertex(a), self.vertex(b), self.vertex(c)) {
            (Some(a), Some(b), Some(c)) => Some([a, b, c]),
            _ => self.view().uncached_corners(face),
        }
    }

    #[inline(always)]
    fn instance(&self) -> &'a MeshInstance<'a, V> {
        self.instance
    }

    #[inline(always)]
    fn view(&self) -> TransformedMesh<'_, V, DEPTH> {
        TransformedMesh::with_cache(self.instance, self.far, self.cache)
    }

    #[inline(always)]
    fn view_with_corners(&mut self, face: &[u16; 3]) -> TransformedMesh<'_, V, DEPTH> {
        self.transform_corners(face);
        self.view()
    }
}

/// Twice the signed area of a face with these corners, positive if they are counter-clockwise with y up.
#[inline(always)]
pub(super) fn area<const DEPTH: bool>(corners: &[ScreenVertex; 3]) -> i64 {
    raster::area(&map3(*corners, |corner| corner.offset::<DEPTH>()))
}

#[inline(never)] // the transform gets all registers
fn transform_one<V: Coordinate, const DEPTH: bool>(
    instance: &MeshInstance<'_, V>,
    far: bool,
    index: u16,
    to: &mut ScreenVertex,
) {
    let vertex_transform = instance.vertex_transform();
    if let Some(vertex) = instance.mesh().vertices.get(usize::from(index)) {
        *to = match vertex_transform.project::<V::Stored, DEPTH>(
            vertex,
            vertex_transform.needs_d(DEPTH, far),
            far,
        ) {
            Some(vertex) => vertex,
            None if V::CLIPS => vertex_transform.without_position(vertex, far),
            None => ScreenVertex::without_position(ScreenVertex::ASIDE),
        };
    }
}

/// Transforms as many vertices as fit into the cache. `far`: the far plane clips.
#[inline(never)] // one copy, for cached and uncached vertices
pub(super) fn transform_all<V: Coordinate, const DEPTH: bool>(
    vertex_transform: &VertexTransform,
    far: bool,
    vertices: &[[V::Stored; 3]],
    cache: &mut [ScreenVertex],
) {
    // `is_near`: the previous vertex lies outside of the near plane; so does the next one, probably.
    let (mut done, mut is_near) = (0, false);
    loop {
        if !is_near {
            let (vertices, cache) = (vertices.get(done..), cache.get_mut(done..));
            let (vertices, cache) = (vertices.unwrap_or_default(), cache.unwrap_or_default());
            done += transform_run::<V, DEPTH>(vertex_transform, far, vertices, cache);
        }
        let (Some(vertex), Some(packed)) = (vertices.get(done), cache.get_mut(done)) else { return };
        if !V::CLIPS {
            *packed = ScreenVertex::without_position(ScreenVertex::ASIDE);
            done += 1; // not beyond the slices
            continue;
        }
        let stored = vertex_transform.without_position(vertex, far);
        let was_near = is_near;
        is_near = stored.planes() == Some(ScreenVertex::NEAR);
        if is_near || !was_near {
            *packed = stored;
            done += 1; // not beyond the slices
        }
    }
}

/// The vertex loop: transforms vertices up to the first that has no position, and returns their number. `far`: the far plane
/// clips. It ends there because a call inside the loop would take registers from it.
#[inline(never)] // the transform gets all registers
fn transform_run<V: Coordinate, const DEPTH: bool>(
    vertex_transform: &VertexTransform,
    far: bool,
    vertices: &[[V::Stored; 3]],
    cache: &mut [ScreenVertex],
) -> usize {
    let count = vertices.len().min(cache.len());
    let by_d = vertex_transform.needs_d(DEPTH, far);
    // `opaque` hides the transform, so that LLVM does not load its fields into registers before the loop: Arm has too few
    // registers, and the fields would be spilled. Inside the loop LLVM loads them in pairs. RISC-V has twice as many registers
    // and no paired loads. On a Cortex-M0, the loop with depth keeps so much in memory that spilled fields cost nothing.
    #[cfg(target_arch = "arm")]
    let vertex_transform = match !crate::math::cores::CORTEX_M0 || !DEPTH {
        true => opaque(vertex_transform),
        false => vertex_transform,
    };
    let mut pairs = pairs(cache, vertices);
    while let Some((packed, vertex)) = pairs.next() {
        keep_rolled();
        match vertex_transform.project::<V::Stored, DEPTH>(vertex, by_d, far) {
            Some(vertex) => *packed = vertex,
            None => return count.wrapping_sub(pairs.len() + 1), // not below 0
        }
    }
    count
}

/// The vertices and their cache entries in pairs, as many as both slices have.
#[cfg(not(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32")))]
#[inline(always)]
fn pairs<'a, A, B>(
    cache: &'a mut [A],
    vertices: &'a [B],
) -> impl ExactSizeIterator<Item = (&'a mut A, &'a B)> {
    cache.iter_mut().zip(vertices)
}

/// The vertices and their cache entries in pairs, as many as both slices have, for cores on which normalising w is a loop. It
/// advances two slices: LLVM replaces an index by pointers only in innermost loops, and this loop contains another.
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
#[inline(always)]
fn pairs<'a, A, B>(
    cache: &'a mut [A],
    vertices: &'a [B],
) -> impl ExactSizeIterator<Item = (&'a mut A, &'a B)> {
    let count = cache.len().min(vertices.len());
    Pairs {
        cache: cache.get_mut(..count).unwrap_or_default(),
        vertices: vertices.get(..count).unwrap_or_default(),
    }
}

/// Two slices of equal length.
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
struct Pairs<'a, A, B> {
    cache: &'a mut [A],
    vertices: &'a [B],
}

#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
impl<'a, A, B> Iterator for Pairs<'a, A, B> {
    type Item = (&'a mut A, &'a B);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let (packed, vertex);
        (packed, self.cache) = core::mem::take(&mut self.cache).split_first_mut()?;
        (vertex, self.vertices) = self.vertices.split_first()?;
        Some((packed, vertex))
    }

    #[inline(always)]
    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.vertices.len(), Some(self.vertices.len()))
    }
}

#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
impl<A, B> ExactSizeIterator for Pairs<'_, A, B> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.vertices.len()
    }
}

defmt_format!(
    [V: Coordinate, const DEPTH: bool] TransformedMesh<'_, V, DEPTH>, self,
    "{}, {=usize} vertices cached", self.instance, self.cache.len()
);
