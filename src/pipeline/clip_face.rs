//! Clipping in clip space: the slow path for points, edges and faces with a vertex that is not on the screen.

use super::cull::{Cull, Facing};
use super::face_triangles::{FaceTriangles, Fan};
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::{area, TransformedMesh};
use crate::camera::{DepthOf, ScreenVertex, UnpackedVertex, VertexTransform};
use crate::clip::{self, ClipCorners, Varying, CLIP_SLOTS};
use crate::fast;
use crate::math::hints::opaque_next;
use crate::math::{ClipCoords, Coordinate};

/// Clips the vertices of an edge or a face at the near and far planes and at the guard band.
struct Clipper<'a> {
    vertex_transform: &'a VertexTransform,
    /// Whether the far plane clips.
    far: bool,
    depth: Option<DepthOf>,
    /// The vertices in slots 0, 1 and 2. One that is on the screen is never cut off, so it keeps its slot.
    vertices: [ScreenVertex; 3],
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
    #[inline(never)] // rare, like all of this file: code size counts
    fn distance(&self, plane: usize, at: usize) -> i64 {
        self.slots.get(at).map_or(0, |point| self.vertex_transform.distance(plane, point))
    }

    fn planes_outside(&self, at: usize) -> u32 {
        match (self.on_screen(at), self.slots.get(at)) {
            (None, Some(point)) => self.vertex_transform.planes_outside(point, self.far),
            _ => 0,
        }
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
        if let Some(varyings) = &mut self.varyings {
            varyings.begin();
        }
        let cut = clip::clip_triangle(&mut self, order);
        for &slot in order.iter() {
            let vertex = self.to_screen(slot.into());
            if let Some(slot) = self.slots.get_mut(usize::from(slot)) {
                vertex.store_in(slot);
            }
        }
        cut
    }

    /// The vertex in this slot, if it is on the screen.
    #[inline(always)]
    fn on_screen(&self, at: usize) -> Option<ScreenVertex> {
        self.vertices.get(at).copied().filter(|vertex| vertex.is_on_screen())
    }

    #[inline(never)]
    fn to_screen(&self, at: usize) -> UnpackedVertex {
        match (self.on_screen(at), self.depth) {
            (Some(vertex), Some(_)) => self.vertex_transform.unpack::<true>(vertex),
            (Some(vertex), None) => self.vertex_transform.unpack::<false>(vertex),
            (None, depth) => {
                self.vertex_transform.project_wide(self.slots.get(at).unwrap_or(&ClipCoords::ZERO), depth)
            }
        }
    }
}

impl<V: Coordinate, const DEPTH: bool> TransformedMesh<'_, V, DEPTH> {
    fn clipper<'c>(
        &'c self,
        indices: &[u16],
        slots: &'c mut [ClipCoords],
        varyings: Option<&'c mut dyn ClipVaryings>,
    ) -> Clipper<'c> {
        let vertex_transform = self.instance.vertex_transform();
        let vertex =
            |i: usize| indices.get(i).map_or(ScreenVertex::EMPTY, |&index| self.screen_vertex(index));
        let vertices = [vertex(0), vertex(1), vertex(2)];
        // A face on the screen is not clipped.
        if !vertices.iter().all(|vertex| vertex.is_on_screen()) {
            to_clip_space(vertex_transform, self.instance.mesh().vertices, indices, slots);
        }
        let depth: Option<DepthOf> = if DEPTH { Some(VertexTransform::depth) } else { None };
        Clipper { vertex_transform, far: self.far, depth, vertices, slots, varyings }
    }

    /// A vertex on the screen, or `None` if it is clipped.
    pub(super) fn vertex(&self, index: u16) -> Option<UnpackedVertex> {
        let vertex = self.screen_vertex(index);
        if vertex.is_on_screen() {
            return Some(self.instance.vertex_transform().unpack::<DEPTH>(vertex));
        }
        if !V::CLIPS {
            return None;
        }
        let mut slots = [ClipCoords::ZERO];
        let clipper = self.clipper(&[index], &mut slots, None);
        (clipper.planes_outside(0) == 0).then(|| clipper.to_screen(0))
    }

    /// The ends of an edge on the screen, or `None` if clipping leaves nothing. Counts edges that are clipped or not drawn.
    #[inline(always)]
    pub(super) fn edge(&self, edge: [u16; 2], statistics: &mut Statistics) -> Option<[UnpackedVertex; 2]> {
        let ends = edge.map(|index| self.screen_vertex(index));
        if ends.iter().all(|end| end.is_on_screen()) {
            Some(ends.map(|end| self.instance.vertex_transform().unpack::<DEPTH>(end)))
        } else {
            statistics.count_edge(if V::CLIPS { self.clip_edge(edge) } else { None })
        }
    }

    /// The slow path for an edge with an end that has no position. Most such edges have both ends outside of one plane.
    #[cold]
    #[inline(never)]
    fn clip_edge(&self, [a, b]: [u16; 2]) -> Option<([UnpackedVertex; 2], bool)> {
        if ScreenVertex::share_a_plane(self.known_planes(a) & self.known_planes(b)) {
            return None;
        }
        self.cut_edge([a, b])
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
        if !V::CLIPS {
            return self.face_on_screen(face, &mut triangles.fan);
        }
        self.clip_with(face, &mut triangles.fan, &mut triangles.varyings)
    }

    /// [`clip_face`](Self::clip_face) for an instance that is not clipped: a face with a corner that is not on the screen is not
    /// drawn.
    fn face_on_screen(&self, face: &[u16; 3], fan: &mut Fan<'_>) -> Outcome {
        let Some(corners) = self.uncached_corners(face) else { return Outcome::Outside };
        let area = area::<DEPTH>(&corners);
        match self.instance.cull().facing(area) {
            Facing::Drawn => {}
            Facing::Culled => return Outcome::Culled,
            Facing::EdgeOn => return Outcome::Degenerate,
        }
        fan.set_unclipped::<DEPTH>(&self.unpack(corners), area);
        Outcome::Unclipped
    }

    /// Most faces that come here have all corners outside of one plane.
    #[cold]
    #[inline(never)] // one copy for all varyings
    fn clip_with(&self, face: &[u16; 3], fan: &mut Fan<'_>, varyings: &mut dyn ClipVaryings) -> Outcome {
        let &[a, b, c] = face;
        let all = self.known_planes(a) & self.known_planes(b) & self.known_planes(c);
        if ScreenVertex::share_a_plane(all) {
            return Outcome::Outside;
        }
        self.cut_face(face, fan, varyings)
    }

    /// The planes of a cached vertex, for [`ScreenVertex::share_a_plane`].
    #[inline(always)]
    fn known_planes(&self, index: u16) -> u32 {
        self.cached_vertex(index).map_or(0, |vertex| vertex.known_planes())
    }

    /// Clips a face at the planes that it crosses, if any.
    #[inline(never)] // its stack frame is not set up for faces that are outside
    fn cut_face(&self, face: &[u16; 3], fan: &mut Fan<'_>, varyings: &mut dyn ClipVaryings) -> Outcome {
        let (slots, order) = fan.polygon.parts();
        let clipper = self.clipper(face, slots, Some(varyings));
        let [a, b, c] = clipper.vertices.map(|vertex| vertex.known_planes());
        if ScreenVertex::share_a_plane(a & b & c) {
            return Outcome::Outside; // of vertices that are not cached
        }
        let culls_back = match self.instance.cull() {
            Cull::Back => true,
            Cull::Front | Cull::None => false,
        };
        let may_be_known = ScreenVertex::is_near_alone(a | b | c) && culls_back;
        if may_be_known && fast::is_back_face(clipper.slots, clipper.vertex_transform.sub_pixels()) {
            return Outcome::Culled;
        }
        let cut = clipper.face(order);
        fan.begin(self.instance.cull(), cut)
    }
}

/// Transforms the vertices with these indices to clip space. `Mesh` has checked the indices.
#[inline(never)] // rare path: code size counts
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Projection, ViewTransform, Viewport};
    use crate::math::random::Random;
    use crate::math::{Affine, Angle, Point3, Scalar, Vector3};
    use crate::raster::Scissor;
    use crate::scene::Mesh;
    use embedded_graphics_core::geometry::{Point, Size};

    /// Random faces about the near plane, also large, small, slender and edge-on ones: whether culled before or after cutting, a
    /// face is culled exactly if what clipping leaves of it is turned away after rounding.
    #[test]
    fn back_faces_are_known_before_they_are_cut() {
        let number = |v| Scalar::try_from(v).expect("in range");
        let viewport = Viewport::new(Point::new(-7, 3), Size::new(240, 180)).unwrap();
        let (eye, near) = (1.2, 0.5);
        let lens =
            Projection::perspective(Angle::degrees(60), viewport.size(), number(near), number(20.0)).unwrap();
        let at = Point3::new(Scalar::ZERO, Scalar::ZERO, number(eye));
        let view =
            ViewTransform::look_at(at, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0)).unwrap();
        let camera = Camera::new(&view, &lens, &viewport);
        let (mut random, mut cut, mut back, mut early) = (Random(17), 0, 0, 0);
        for i in 0..400_000 {
            let size = [0.8, 0.2, 0.05, 0.01, 0.002][i % 5];
            let mut vector = |size: f64| [0; 3].map(|_| size * random.unit());
            let mut about = vector(0.6);
            about[2] = eye - near + vector(size)[2];
            let mut points = [0; 3].map(|_| vector(size)).map(|v| [0, 1, 2].map(|k| about[k] + v[k]));
            let small = vector([0.1, 0.01, 0.001][i / 5 % 3] * size);
            let [a, b, _] = points;
            match i / 15 % 4 {
                0 => points[2] = [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0 + small[k]), // slender
                1 => points[2] = [0, 1, 2].map(|k| a[k] * 1.2 - [0.0, 0.0, eye][k] * 0.2 + small[k]), // edge-on
                _ => {}
            }
            let vertices = points.map(|point| point.map(|c| (c * 16_384.0).round() as i16));
            let mesh = Mesh::new(&vertices, -14, &[[0, 1, 2]]).unwrap();
            let instance = camera.place(&mesh, &Affine::identity());
            let both_sides = instance.with_cull(Cull::None);
            let mut triangles = FaceTriangles::<()>::new(&Scissor::GUARD_BAND);
            let face = [0, 1, 2];
            let all = TransformedMesh::<_, true>::new(&both_sides, &mut []).clip_face(&face, &mut triangles);
            if all != Outcome::Clipped {
                continue;
            }
            cut += 1;
            let expected = if triangles.fan.is_reversed() { Outcome::Culled } else { all };
            let transformed = TransformedMesh::<_, true>::new(&instance, &mut []);
            assert!(transformed.clip_face(&face, &mut triangles) == expected, "{vertices:?}");
            let mut slots = [ClipCoords::ZERO; 3];
            let clipper = transformed.clipper(&face, &mut slots, None);
            let is_early = fast::is_back_face(clipper.slots, clipper.vertex_transform.sub_pixels());
            back += u32::from(expected == Outcome::Culled);
            early += u32::from(is_early);
        }
        assert!(cut > 100_000 && back > cut / 3, "{cut} {back}");
        assert!(cfg!(pinhole_plain) || early > back / 5, "{early} of {back}");
    }
}
