//! Clipping in clip space: the slow path for points, edges and faces with a vertex that is not on the screen.

use super::face_triangles::{FaceTriangles, Fan};
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::TransformedMesh;
use crate::camera::{DepthOf, UnpackedVertex, VertexTransform};
use crate::clip::{self, ClipCorners, Varying, CLIP_SLOTS};
use crate::math::hints::{keep_rolled, opaque_next};
use crate::math::{ClipCoords, Coordinate};

/// Clips the vertices of an edge or a face at the near and far planes and at the guard band.
struct Clipper<'a> {
    vertex_transform: &'a VertexTransform,
    /// Whether the far plane clips.
    far: bool,
    depth: Option<DepthOf>,
    slots: &'a mut [ClipCoords],
    varyings: Option<&'a mut dyn ClipVaryings>,
}

/// The varyings of all slots. As a trait object they have one type, so that the clipper is compiled once.
trait ClipVaryings {
    /// Sets the varyings of an unclipped face in slots 0, 1 and 2.
    fn begin(&mut self);

    /// Interpolates the varying where a plane cuts an edge: see [`ClipCorners::put`].
    fn interpolate(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

impl<K: Varying> ClipVaryings for [K; CLIP_SLOTS] {
    fn begin(&mut self) {
        for (corner, varying) in self.iter_mut().take(3).enumerate() {
            *varying = K::of(corner);
        }
    }

    fn interpolate(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        if let (Some(a), Some(b)) = (self.get(inside), self.get(outside)) {
            let varying = a.towards(b, t.into());
            if let Some(slot) = self.get_mut(at) {
                *slot = varying;
            }
        }
    }
}

impl ClipCorners for Clipper<'_> {
    #[inline(never)] // rare, like all of this file: code size matters more than speed
    fn distance(&self, plane: usize, at: usize) -> i64 {
        self.slots.get(at).map_or(0, |point| self.vertex_transform.distance(plane, point))
    }

    fn planes_outside(&self, at: usize) -> u32 {
        self.slots.get(at).map_or(0, |point| self.vertex_transform.planes_outside(point, self.far))
    }

    #[inline(never)]
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        ClipCoords::put(self.slots, at, inside, outside, t);
        if let Some(varyings) = &mut self.varyings {
            varyings.interpolate(at, inside, outside, t);
        }
    }
}

impl Clipper<'_> {
    /// The ends of an edge on the screen and whether clipping shortened it, or `None` if clipping leaves nothing.
    #[inline(never)]
    fn edge(mut self) -> Option<([UnpackedVertex; 2], bool)> {
        let cut = clip::clip_line(&mut self)?;
        Some(([self.to_screen(0), self.to_screen(1)], cut))
    }

    /// Clips a face: writes the slots of the polygon's corners to `order`, moves the corners to the screen, and returns whether
    /// clipping removed a part of the face.
    #[inline(never)]
    fn face(mut self, order: &mut clip::SlotOrder) -> bool {
        let cut = clip::clip_triangle(&mut self, order);
        for &slot in order.iter() {
            let vertex = self.to_screen(slot.into());
            if let Some(corner) = self.slots.get_mut(usize::from(slot)) {
                let [.., w] = corner.xydw;
                corner.xydw = [vertex.point.x(), vertex.point.y(), vertex.depth, w];
            }
        }
        cut
    }

    #[inline(never)]
    fn to_screen(&self, at: usize) -> UnpackedVertex {
        self.vertex_transform.project_wide(self.slots.get(at).unwrap_or(&ClipCoords::ZERO), self.depth)
    }
}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    fn clipper<'c>(
        &'c self,
        indices: &[u16],
        slots: &'c mut [ClipCoords],
        varyings: Option<&'c mut dyn ClipVaryings>,
    ) -> Clipper<'c> {
        let vertex_transform = &self.instance.vertex_transform;
        to_clip_space(vertex_transform, self.instance.mesh.vertices(), indices, slots);
        Clipper { vertex_transform, far: self.far, depth: Self::depth(), slots, varyings }
    }

    fn depth() -> Option<DepthOf> {
        if DEPTH {
            Some(VertexTransform::depth)
        } else {
            None
        }
    }

    /// The clip planes that vertices lie outside of: all of them (`[0]`) and any of them (`[1]`). A vertex before the near plane
    /// may lie outside of others, too, that are not counted.
    #[inline(never)] // one copy for faces, edges and points
    fn planes_outside(&self, indices: &[u16]) -> [u32; 2] {
        let mut planes = [u32::MAX, 0];
        for &index in indices {
            keep_rolled();
            let own = self.vertex_planes(index);
            planes = [planes[0] & own, planes[1] | own];
        }
        planes
    }

    #[inline(always)]
    fn vertex_planes(&self, index: u16) -> u32 {
        let vertex = self.screen_vertex(index);
        if vertex.is_on_screen() {
            return 0;
        }
        vertex.planes().unwrap_or_else(|| self.planes_of_unknown(index))
    }

    /// The planes of a vertex that a cache has neither on the screen nor with its planes.
    #[cold]
    #[inline(never)]
    fn planes_of_unknown(&self, index: u16) -> u32 {
        let vertex = self.instance.mesh.vertices().get(usize::from(index)); // `Mesh` has checked that there is one
        let vertex =
            vertex.map(|vertex| self.instance.vertex_transform.without_position(vertex, self.far));
        vertex.and_then(|vertex| vertex.planes()).unwrap_or(0)
    }

    /// The position of a vertex that lies inside of all planes, also farther out than the cache can store.
    #[inline(never)] // one copy for faces, edges and points
    fn position(&self, index: u16) -> UnpackedVertex {
        let (vertex, transform) = (self.screen_vertex(index), &self.instance.vertex_transform);
        if vertex.is_on_screen() {
            return transform.unpack::<DEPTH>(vertex);
        }
        let mut slot = [ClipCoords::ZERO];
        to_clip_space(transform, self.instance.mesh.vertices(), &[index], &mut slot);
        transform.project_wide(&slot[0], Self::depth())
    }

    /// A vertex on the screen, or `None` if it is clipped.
    pub(super) fn vertex(&self, index: u16) -> Option<UnpackedVertex> {
        (self.vertex_planes(index) == 0).then(|| self.position(index))
    }

    /// The ends of an edge on the screen, or `None` if clipping leaves nothing. Counts edges that are clipped or not drawn.
    #[inline(always)]
    pub(super) fn edge(&self, edge: [u16; 2], statistics: &mut Statistics) -> Option<[UnpackedVertex; 2]> {
        let ends = edge.map(|index| self.screen_vertex(index));
        if ends.iter().all(|end| end.is_on_screen()) {
            Some(ends.map(|end| self.instance.vertex_transform.unpack::<DEPTH>(end)))
        } else {
            statistics.count_edge(self.clip_edge(edge))
        }
    }

    /// The slow path for an edge with an end that has no position. Most such edges have both ends outside of one plane.
    #[cold]
    #[inline(never)]
    fn clip_edge(&self, edge: [u16; 2]) -> Option<([UnpackedVertex; 2], bool)> {
        match self.planes_outside(&edge) {
            [0, 0] => Some((edge.map(|index| self.position(index)), false)),
            [0, _] => self.cut_edge(edge),
            _ => None,
        }
    }

    #[inline(never)] // its stack frame is not set up for edges that are outside
    fn cut_edge(&self, edge: [u16; 2]) -> Option<([UnpackedVertex; 2], bool)> {
        let mut slots = [ClipCoords::ZERO; 2];
        self.clipper(&edge, &mut slots, None).edge()
    }

    /// The slow path for a face with an uncached vertex, or one without a position. Returns what becomes of the face, with its
    /// first triangle in `triangles` if it is drawn.
    #[inline(always)]
    pub(super) fn clip_face<K: Varying>(
        &self,
        face: &[u16; 3],
        triangles: &mut FaceTriangles<'_, K>,
    ) -> Outcome {
        self.clip_with(face, &mut triangles.fan, &mut triangles.varyings)
    }

    /// Most faces that come here have all corners outside of one plane.
    #[cold]
    #[inline(never)] // one copy for all varyings
    fn clip_with(&self, face: &[u16; 3], fan: &mut Fan<'_>, varyings: &mut dyn ClipVaryings) -> Outcome {
        let [all, any] = self.planes_outside(face);
        if all != 0 {
            return Outcome::Outside;
        }
        let cut = any != 0;
        if cut {
            self.cut_face(face, fan, varyings);
        } else {
            fan.polygon.set_face(&face.map(|index| self.position(index)));
        }
        fan.begin(self.instance.cull, cut)
    }

    #[inline(never)] // its stack frame is not set up for faces that are outside
    fn cut_face(&self, face: &[u16; 3], fan: &mut Fan<'_>, varyings: &mut dyn ClipVaryings) {
        varyings.begin();
        let (slots, order) = fan.polygon.parts();
        self.clipper(face, slots, Some(varyings)).face(order);
    }
}

/// Transforms the vertices with these indices to clip space. `Mesh` has checked the indices.
#[inline(never)] // rare: code size matters more than speed
fn to_clip_space<V: Coordinate>(
    vertex_transform: &VertexTransform,
    vertices: &[[V; 3]],
    indices: &[u16],
    slots: &mut [ClipCoords],
) {
    let mut i = 0;
    while let (Some(&index), Some(slot)) = (indices.get(i), slots.get_mut(i)) {
        if let Some(&vertex) = vertices.get(usize::from(index)) {
            vertex_transform.clip_into(vertex, slot);
        }
        i = opaque_next(i);
    }
}
