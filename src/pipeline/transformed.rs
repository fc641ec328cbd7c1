//! Vertices on the screen, and what becomes of faces and edges there.

use super::clip_face::FaceClipper;
use super::fan::{ClipVaryings, Fan, Polygon};
use super::{put, Cull, MeshInstance, Shader, Statistics};
use crate::camera::{DepthOf, ScreenVertex, UnpackedVertex, VertexTransform};
use crate::clip::{Varying, CLIP_SLOTS};
use crate::math::num::{after, keep_rolled};
use crate::math::{ClipCoords, Coordinate};
use crate::raster::{self, DepthTriangle, Scissor};
use core::hint::black_box;

/// A placed mesh with its vertices on the screen, each transformed once. `DEPTH` tells whether their
/// depth was computed too.
///
/// Vertices beyond the end of the corners lent are computed whenever a face or an edge needs them: the
/// picture is the same, so a mesh may be larger than its storage. [`MeshInstance::transform`] has an example.
#[derive(Debug)]
pub struct TransformedMesh<'a, V = i16, const DEPTH: bool = false> {
    pub(super) placed: &'a MeshInstance<'a, V>,
    /// Whether what lies beyond the far plane is cut off.
    far: bool,
    /// Whether all corners have a place.
    complete: bool,
    corners: &'a [ScreenVertex],
}

// Not derived: what is borrowed need not be Clone.
impl<V, const DEPTH: bool> Clone for TransformedMesh<'_, V, DEPTH> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<V, const DEPTH: bool> Copy for TransformedMesh<'_, V, DEPTH> {}

impl<'a, V: Coordinate, const DEPTH: bool> TransformedMesh<'a, V, DEPTH> {
    /// Fills the corners from the start of the vertex list. Depth ends at the far plane, whatever the
    /// camera says.
    pub(super) fn new(placed: &'a MeshInstance<'_, V>, corners: &'a mut [ScreenVertex]) -> Self {
        let complete = project::<V, DEPTH>(placed, DEPTH, corners);
        // A number of which the compiler knows nothing is compared in one instruction, many a constant in two. Without depth
        // the constant is better: there a register is not.
        let corners: &[ScreenVertex] = if DEPTH { black_box(corners) } else { corners };
        Self { complete, ..Self::with_corners(placed, DEPTH, corners) }
    }

    /// With corners that were filled elsewhere. `far`: cut at the far plane, whatever the camera says.
    #[inline(always)]
    pub(super) fn with_corners(
        placed: &'a MeshInstance<'_, V>,
        far: bool,
        corners: &'a [ScreenVertex],
    ) -> Self {
        Self { placed, far: far || placed.placement.cuts_at_far(), complete: false, corners }
    }

    #[inline(always)]
    pub(super) fn corner(&self, index: u16) -> ScreenVertex {
        match self.corners.get(usize::from(index)) {
            Some(corner) => *corner,
            None => self.uncached(index),
        }
    }

    #[cold]
    #[inline(never)]
    fn uncached(&self, index: u16) -> ScreenVertex {
        let mut corner = [ScreenVertex::EMPTY];
        // Checked by Mesh: there is such a vertex.
        let vertex = self.placed.mesh.vertices().get(usize::from(index)..).unwrap_or_default();
        project_all::<V, DEPTH>(&self.placed.placement, self.far, vertex, &mut corner);
        let [corner] = corner;
        corner
    }

    /// The vertices in clip space, before the planes.
    fn before_planes<'c>(
        &self,
        indices: &[u16],
        places: &'c mut [ClipCoords],
        carried: Option<&'c mut dyn ClipVaryings>,
    ) -> FaceClipper<'c>
    where
        'a: 'c,
    {
        let placement = &self.placed.placement;
        to_clip_space(placement, self.placed.mesh.vertices(), indices, places);
        let depth: Option<DepthOf> = if DEPTH { Some(VertexTransform::depth) } else { None };
        FaceClipper { placement, far: self.far, depth, places, carried }
    }

    /// Where a vertex lies on the screen, if no plane cuts it off.
    pub(super) fn image(&self, index: u16) -> Option<UnpackedVertex> {
        let corner = self.corner(index);
        if corner.whole() {
            return Some(self.placed.placement.at::<DEPTH>(corner));
        }
        let mut places = [ClipCoords::ZERO];
        self.before_planes(&[index], &mut places, None).point()
    }

    /// The ends of an edge on the screen, or `None` when nothing is left of it; counts what is cut, and what is not drawn.
    #[inline(always)]
    pub(super) fn edge(&self, edge: [u16; 2], statistics: &mut Statistics) -> Option<[UnpackedVertex; 2]> {
        let ends = edge.map(|index| self.corner(index));
        if ends.iter().all(|end| end.whole()) {
            Some(ends.map(|end| self.placed.placement.at::<DEPTH>(end)))
        } else {
            statistics.count_edge(self.cut_edge(edge))
        }
    }

    /// The same where small is better than fast.
    #[inline(never)]
    pub(super) fn ends_of(&self, edge: [u16; 2], statistics: &mut Statistics) -> Option<[UnpackedVertex; 2]> {
        self.edge(edge, statistics)
    }

    /// The same for ends that have no place, and whether the planes took anything of it.
    #[cold]
    #[inline(never)]
    fn cut_edge(&self, edge: [u16; 2]) -> Option<([UnpackedVertex; 2], bool)> {
        let mut places = [ClipCoords::ZERO; 2];
        self.before_planes(&edge, &mut places, None).edge()
    }

    /// All edges in the mesh's order: `draw` gets their numbers and ends.
    #[inline(always)]
    pub(super) fn all_edges<E>(
        &self,
        mut draw: impl FnMut(usize, [UnpackedVertex; 2]) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        let mut statistics = Statistics::default();
        let edges = self.placed.mesh.edges();
        for (index, &edge) in edges.iter().enumerate() {
            if let Some(ends) = self.edge(edge, &mut statistics) {
                draw(index, ends)?;
            }
        }
        Ok(statistics.with_the_rest_drawn(edges.len()))
    }

    /// A face's corners, if all of them were kept.
    #[inline(always)]
    pub(super) fn kept(&self, &[a, b, c]: &[u16; 3]) -> Option<[&ScreenVertex; 3]> {
        let corner = |index: u16| self.corners.get(usize::from(index));
        Some([corner(a)?, corner(b)?, corner(c)?])
    }

    /// The same, if they lie on the screen too.
    #[inline(always)]
    pub(super) fn whole(&self, face: &[u16; 3]) -> Option<[ScreenVertex; 3]> {
        let corners = self.kept(face)?.map(|corner| *corner);
        corners.iter().all(|corner| corner.whole()).then_some(corners)
    }

    /// Where the corners lie on the screen.
    #[inline(always)]
    pub(super) fn images(&self, corners: [ScreenVertex; 3]) -> [UnpackedVertex; 3] {
        corners.map(|corner| self.placed.placement.at::<DEPTH>(corner))
    }

    /// Step 3 of the pipeline, for a face with corners that are not kept, or must be clipped: what is left of it. Tells
    /// whether planes took something.
    #[cold]
    #[inline(never)]
    pub(super) fn polygon(
        &self,
        face: &[u16; 3],
        polygon: &mut Polygon,
        carried: &mut dyn ClipVaryings,
    ) -> bool {
        let corners = face.map(|index| self.corner(index));
        if corners.iter().all(|corner| corner.whole()) {
            polygon.whole(&self.images(corners));
            return false;
        }
        carried.begin();
        self.before_planes(face, &mut polygon.places, Some(carried)).face(&mut polygon.order)
    }

    /// Puts the next triangle of such a face there, if there is one more; with the first one it is known what becomes of the
    /// face.
    #[inline(always)]
    pub(super) fn triangle_into<K: Varying>(
        &self,
        face: &[u16; 3],
        fan: &mut Fan<K>,
        piece: &mut DepthTriangle<'_>,
    ) -> bool {
        fan.goes_on() && self.triangle(face, fan, piece)
    }

    #[cold]
    #[inline(never)]
    fn triangle<K: Varying>(&self, face: &[u16; 3], fan: &mut Fan<K>, piece: &mut DepthTriangle<'_>) -> bool {
        if fan.next_into(piece) {
            return true;
        }
        let (mut polygon, mut carried) = (Polygon::new(), [K::of(0); CLIP_SLOTS]);
        let cut = self.polygon(face, &mut polygon, &mut carried);
        let is_drawn = fan.progress.next_into(&polygon, self.placed.cull, cut, piece);
        fan.take(&polygon, &carried);
        is_drawn
    }

    /// The first triangle of a face that takes more than its corners' places, if it has any; counts the face.
    #[cold]
    #[inline(never)]
    fn first_of_any<K: Varying>(
        &self,
        face: &[u16; 3],
        fan: &mut Fan<K>,
        statistics: &mut Statistics,
        piece: &mut DepthTriangle<'_>,
    ) -> bool {
        fan.clear();
        let is_drawn = self.triangle_into(face, fan, piece);
        statistics.count(fan.progress.outcome);
        is_drawn
    }

    /// Step 3 and 4 for all faces in the mesh's order: `draw` gets triangles, with the depths of their corners if those were
    /// computed, and what they are filled with.
    #[inline(always)]
    pub(super) fn all<I: Shader, E>(
        &self,
        viewport: &Scissor,
        shade: impl FnMut(usize) -> I,
        draw: impl FnMut(&DepthTriangle<'_>, I) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        if self.complete && self.placed.cull == Cull::Back {
            self.all_of::<true, _, _>(viewport, shade, draw)
        } else {
            self.all_of::<false, _, _>(viewport, shade, draw)
        }
    }

    /// The same; `PLAIN`: all corners that are kept have a place, and faces that are turned away are left out, so that of most a
    /// sign says all. Two loops: to ask which of both it is takes three instructions a face.
    #[inline(always)]
    fn all_of<const PLAIN: bool, I: Shader, E>(
        &self,
        viewport: &Scissor,
        mut shade: impl FnMut(usize) -> I,
        mut draw: impl FnMut(&DepthTriangle<'_>, I) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        let mut statistics = Statistics::default();
        let mut piece = DepthTriangle::new(viewport);
        let mut fan = Fan::new();
        let back = PLAIN || self.placed.cull == Cull::Back;
        let faces = self.placed.mesh.faces();
        // This face and those behind it, whose number tells which it is: a face that is turned away counts nothing else.
        let mut left = faces;
        while let [face, behind @ ..] = left {
            'face: {
                'any: {
                    let Some(kept) = self.kept(face) else { break 'any };
                    let area = self.area(&kept.map(|corner| *corner));
                    if !PLAIN && !kept.iter().all(|corner| corner.whole()) {
                        break 'any;
                    }
                    // Most faces end here.
                    if area < 0 && back {
                        break 'face;
                    }
                    if area == 0 {
                        break 'any;
                    }
                    // With depth it is loaded anew, as the way above needs the registers. It is the same face: all of it is kept.
                    let again = if DEPTH { self.kept(black_box(face)) } else { Some(kept) };
                    let Some(kept) = again else { break 'face };
                    statistics.drawn += 1;
                    put::<DEPTH>(&mut piece, &self.images(kept.map(|corner| *corner)), area);
                    draw(&piece, shade(faces.len() - left.len()))?;
                    break 'face;
                }
                let shade = || shade(faces.len() - left.len());
                self.any(face, shade, &mut fan, &mut statistics, &mut piece, &mut draw)?;
            }
            left = behind;
        }
        Ok(statistics.with_the_rest_culled(faces.len()))
    }

    /// The same for a face that takes more than its corners' places.
    #[inline(always)]
    pub(super) fn any<I: Shader, E>(
        &self,
        face: &[u16; 3],
        shade: impl FnOnce() -> I,
        fan: &mut Fan<I::Varying>,
        statistics: &mut Statistics,
        piece: &mut DepthTriangle<'_>,
        mut draw: impl FnMut(&DepthTriangle<'_>, I) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.first_of_any(face, fan, statistics, piece) {
            let ink = shade();
            loop {
                draw(piece, fan.ink(&ink))?;
                if !self.triangle_into(face, fan, piece) {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Twice the area of a face with these corners, if it is to be drawn, and counts it if it is, or has none: those that
    /// are turned away are [the others](Statistics::with_the_rest_culled).
    #[inline(always)]
    pub(super) fn front(&self, corners: &[ScreenVertex; 3], statistics: &mut Statistics) -> Option<i64> {
        let [a, b, c] = *corners;
        let back = self.area(&[a, c, b]); // not negative: not to the front, which one bit tells
        if back >= 0 {
            if back == 0 {
                statistics.degenerate += 1;
                return None;
            }
            if self.placed.cull == Cull::Back {
                return None;
            }
        }
        statistics.drawn += 1;
        Some(-back)
    }

    /// Twice the area of a face with these corners.
    #[inline(always)]
    pub(super) fn area(&self, corners: &[ScreenVertex; 3]) -> i64 {
        raster::area(&corners.map(|corner| corner.offset::<DEPTH>()))
    }
}

/// The vertex loop, from the start of the vertex list. `far`: cut at the far plane, whatever the camera says.
pub(super) fn project<V: Coordinate, const DEPTH: bool>(
    placed: &MeshInstance<'_, V>,
    far: bool,
    corners: &mut [ScreenVertex],
) -> bool {
    let far = far || placed.placement.cuts_at_far();
    project_all::<V, DEPTH>(&placed.placement, far, placed.mesh.vertices(), corners)
}

#[inline(never)] // once, for the vertices that are kept and for those that are not
fn project_all<V: Coordinate, const DEPTH: bool>(
    placement: &VertexTransform,
    far: bool,
    vertices: &[[V; 3]],
    corners: &mut [ScreenVertex],
) -> bool {
    let by_d = placement.asks_for_d(DEPTH, far);
    // Somewhere, and perhaps changed in every turn: so nothing of it is brought into registers, of which there are too
    // few, before the loop, and its numbers are loaded in pairs. RISC-V has twice as many registers, and no such loads; on a
    // Cortex-M0 the loop with depth has so much in memory that it costs nothing to have it all on the stack.
    #[cfg(target_arch = "arm")]
    let placement = match !crate::math::num::CORTEX_M0 || !DEPTH {
        true => black_box(placement),
        false => placement,
    };
    let mut complete = true;
    for (corner, vertex) in pairs(corners, vertices) {
        keep_rolled();
        *corner = placement.project::<V, DEPTH>(vertex, by_d, far);
        if !corner.whole() {
            complete = false;
        }
    }
    complete
}

/// Both side by side, as many as there are of both.
#[cfg(not(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32")))]
#[inline(always)]
fn pairs<'a, A, B>(corners: &'a mut [A], vertices: &'a [B]) -> impl Iterator<Item = (&'a mut A, &'a B)> {
    corners.iter_mut().zip(vertices)
}

/// The same by two pointers and one count in place of an index, where normalising w is a loop: the compiler makes them of an
/// index in innermost loops alone.
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
#[inline(always)]
fn pairs<'a, A, B>(corners: &'a mut [A], vertices: &'a [B]) -> impl Iterator<Item = (&'a mut A, &'a B)> {
    let kept = corners.len().min(vertices.len());
    let mut corners = corners.get_mut(..kept).unwrap_or_default();
    let mut vertices = vertices.get(..kept).unwrap_or_default();
    core::iter::from_fn(move || {
        let (corner, vertex);
        (corner, corners) = core::mem::take(&mut corners).split_first_mut()?;
        (vertex, vertices) = vertices.split_first()?;
        Some((corner, vertex))
    })
}

/// The vertices of these indices, which were checked by [`Mesh`](crate::Mesh).
#[inline(never)] // rare: small is better
fn to_clip_space<V: Coordinate>(
    placement: &VertexTransform,
    vertices: &[[V; 3]],
    indices: &[u16],
    places: &mut [ClipCoords],
) {
    let mut i = 0;
    while let (Some(&index), Some(place)) = (indices.get(i), places.get_mut(i)) {
        if let Some(&vertex) = vertices.get(usize::from(index)) {
            placement.clip_into(vertex, place);
        }
        i = after(i);
    }
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for TransformedMesh<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{}, {=usize} corners kept", self.placed, self.corners.len());
    }
}
