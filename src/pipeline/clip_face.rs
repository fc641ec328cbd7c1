//! Clipping in clip space: the slow path for points, edges and faces with a vertex that is not on the screen.

use super::face_triangles::{FaceTriangles, Fan};
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::TransformedMesh;
use crate::camera::{DepthOf, UnpackedVertex, VertexTransform};
use crate::clip::{self, ClipCorners, Varying, CLIP_SLOTS};
use crate::math::hints::opaque_next;
use crate::math::{ClipCoords, Coordinate};

/// Clips the vertices of a point, an edge or a face at the near and far planes and at the guard band.
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

    #[inline(never)]
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        ClipCoords::put(self.slots, at, inside, outside, t);
        if let Some(varyings) = &mut self.varyings {
            varyings.interpolate(at, inside, outside, t);
        }
    }
}

impl Clipper<'_> {
    fn planes(&self) -> usize {
        5 + usize::from(self.far)
    }

    /// The vertex in slot 0 on the screen, or `None` if it is clipped.
    #[inline(never)]
    fn point(self) -> Option<UnpackedVertex> {
        (0..self.planes()).all(|plane| self.distance(plane, 0) >= 0).then(|| self.to_screen(0))
    }

    /// The ends of an edge on the screen and whether clipping shortened it, or `None` if clipping leaves nothing.
    #[inline(never)]
    fn edge(mut self) -> Option<([UnpackedVertex; 2], bool)> {
        let planes = self.planes();
        let cut = clip::clip_line(&mut self, planes)?;
        Some(([self.to_screen(0), self.to_screen(1)], cut))
    }

    /// Clips a face: writes the slots of the polygon's corners to `order`, moves the corners to the screen, and returns whether
    /// clipping removed a part of the face.
    #[inline(never)]
    fn face(mut self, order: &mut clip::SlotOrder) -> bool {
        let planes = self.planes();
        let cut = clip::clip_triangle(&mut self, planes, order);
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
        let depth: Option<DepthOf> = if DEPTH { Some(VertexTransform::depth) } else { None };
        Clipper { vertex_transform, far: self.far, depth, slots, varyings }
    }

    /// A vertex on the screen, or `None` if it is clipped.
    pub(super) fn vertex(&self, index: u16) -> Option<UnpackedVertex> {
        let vertex = self.screen_vertex(index);
        if vertex.is_on_screen() {
            return Some(self.instance.vertex_transform.unpack::<DEPTH>(vertex));
        }
        let mut slots = [ClipCoords::ZERO];
        self.clipper(&[index], &mut slots, None).point()
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

    #[cold]
    #[inline(never)]
    fn clip_edge(&self, edge: [u16; 2]) -> Option<([UnpackedVertex; 2], bool)> {
        let mut slots = [ClipCoords::ZERO; 2];
        self.clipper(&edge, &mut slots, None).edge()
    }

    /// The slow path for a face with an uncached vertex, or one that must be clipped. Returns what becomes of the face, with
    /// its first triangle in `triangles` if it is drawn.
    #[inline(always)]
    pub(super) fn clip_face<K: Varying>(
        &self,
        face: &[u16; 3],
        triangles: &mut FaceTriangles<'_, K>,
    ) -> Outcome {
        self.clip_with(face, &mut triangles.fan, &mut triangles.varyings)
    }

    #[cold]
    #[inline(never)] // one copy for all varyings
    fn clip_with(&self, face: &[u16; 3], fan: &mut Fan<'_>, varyings: &mut dyn ClipVaryings) -> Outcome {
        let corners = face.map(|index| self.screen_vertex(index));
        let cut = if corners.iter().all(|corner| corner.is_on_screen()) {
            fan.polygon.set_face(&self.unpack(corners));
            false
        } else {
            varyings.begin();
            let (slots, order) = fan.polygon.parts();
            self.clipper(face, slots, Some(varyings)).face(order)
        };
        fan.begin(self.instance.cull, cut)
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
