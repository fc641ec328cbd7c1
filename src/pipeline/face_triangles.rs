//! The triangles of one face: the face itself, or the fan of the polygon that clipping leaves of it.

use super::cull::{Cull, Facing};
use super::statistics::Outcome;
use crate::camera::UnpackedVertex;
use crate::clip::{SlotOrder, Varying, CLIP_SLOTS};
use crate::math::hints::keep_rolled;
use crate::math::unrolled::map3;
use crate::math::ClipCoords;
use crate::raster::{self, DepthTriangle, Scissor};
use crate::shading::Shader;

/// A clipped face: a convex polygon on the screen.
pub(super) struct Polygon {
    /// Corners: in clip space during clipping, then on the screen as x, y, depth and clip space's w. `None` until the first face
    /// needs them: clearing them takes 170 instructions, for each band.
    slots: Option<[ClipCoords; CLIP_SLOTS]>,
    /// The slots of the polygon's corners, in order.
    order: SlotOrder,
}

impl Polygon {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { slots: None, order: SlotOrder::new() }
    }

    /// The slots, and the order in which they are the polygon's corners.
    pub(super) fn parts(&mut self) -> (&mut [ClipCoords], &mut SlotOrder) {
        (self.slots.get_or_insert([ClipCoords::ZERO; CLIP_SLOTS]), &mut self.order)
    }

    /// The corner in a slot; `None` for a slot that does not exist.
    fn corner(&self, slot: usize) -> Option<&ClipCoords> {
        self.slots.as_ref()?.get(slot)
    }

    /// The bounding box of the polygon's pixels.
    fn bounds(&self) -> Scissor {
        let mut bounds = Scissor::UNION_IDENTITY;
        for &slot in &self.order {
            keep_rolled();
            if let Some(corner) = self.corner(usize::from(slot)) {
                bounds =
                    bounds.union(&Scissor::bounding_box(&[UnpackedVertex::from_clip_slot(corner).point; 3]));
            }
        }
        bounds
    }
}

/// The triangles of one face with the varyings of their corners; reused for face after face.
pub(super) struct FaceTriangles<'v, K> {
    pub(super) fan: Fan<'v>,
    /// The varyings of the corner in each slot of the polygon.
    pub(super) varyings: [K; CLIP_SLOTS],
}

impl<'v, K: Varying> FaceTriangles<'v, K> {
    #[inline(always)]
    pub(super) fn new(viewport: &'v Scissor) -> Self {
        Self { fan: Fan::new(viewport), varyings: [K::of(0); CLIP_SLOTS] }
    }

    /// The shader of the current triangle: the face's own, or the one of a part of the face.
    #[inline(always)]
    pub(super) fn shader<S: Shader<Varying = K>>(&self, shader: &S) -> S {
        if self.fan.is_cut() {
            // A function for textures: firmware that draws them with depth and without has four callers.
            let slots = if S::NEEDS_W { self.fan.slots_called() } else { self.fan.slots() };
            shader.sub_face(slots.map(|slot| match self.varyings.get(slot) {
                Some(varying) => *varying,
                None => K::of(0), // the fan's slots exist
            }))
        } else {
            *shader
        }
    }
}

/// The triangles of one face after the other, with one triangle as the current one. It does not depend on varyings: it is
/// compiled once for all shaders.
pub(super) struct Fan<'v> {
    triangle: DepthTriangle<'v>,
    pub(super) polygon: Polygon,
    /// Whether clipping removed a part of the face. Valid only if `end` is not 0.
    is_cut: bool,
    /// Whether the polygon's corners are taken from the last to the first, so that its triangles face the viewer.
    reversed: bool,
    /// The fan about the polygon's first corner: its next triangle has the two corners after this one.
    at: u8,
    /// The number of triangles in the fan; 0 for a face that was not passed to the clipper. All other fields of the fan are
    /// ignored then, so that the common case sets only this one.
    end: u8,
}

impl<'v> Fan<'v> {
    #[inline(always)]
    pub(super) fn new(viewport: &'v Scissor) -> Self {
        let triangle = DepthTriangle::new(viewport);
        Self { triangle, polygon: Polygon::new(), is_cut: false, reversed: false, at: 0, end: 0 }
    }

    /// Sets a face with all corners on the screen, the common case: one triangle.
    #[inline(always)]
    pub(super) fn set_unclipped<const DEPTH: bool>(&mut self, corners: &[UnpackedVertex; 3], area: i64) {
        self.end = 0;
        set_triangle::<DEPTH>(&mut self.triangle, corners, area);
    }

    /// Whether the face is drawn from cached vertices: it was not passed to the clipper.
    #[inline(always)]
    pub(super) fn is_cached(&self) -> bool {
        self.end == 0
    }

    /// Whether clipping removed a part of the face: then its corners are those of the polygon.
    #[inline(always)]
    pub(super) fn is_cut(&self) -> bool {
        !self.is_cached() && self.is_cut
    }

    /// Begins the fan of the polygon, with its first triangle as the current one, and returns what becomes of the face. `cut`:
    /// clipping removed a part of the face.
    #[inline(never)] // rare path: code size counts
    pub(super) fn begin(&mut self, cull: Cull, cut: bool) -> Outcome {
        (self.is_cut, self.reversed) = (cut, false);
        let (mut area, mut count) = (0, 0u8);
        if let (Some(first), Some(mut last)) = (self.corner(0), self.corner(1)) {
            while let Some(next) = self.corner(usize::from(count) + 2) {
                area += raster::area(&[first.point, last.point, next.point]); // < 7·2⁴⁵
                (last, count) = (next, count + 1); // at most clip::CORNERS
            }
        }
        let outcome = match (count, cull.facing(area)) {
            (0, _) => Outcome::Outside,
            (_, Facing::EdgeOn) => Outcome::Degenerate,
            (_, Facing::Culled) => Outcome::Culled,
            (_, Facing::Drawn) if cut => Outcome::Clipped,
            (_, Facing::Drawn) => Outcome::Unclipped,
        };
        // The triangles of a cut face are made counter-clockwise.
        self.reversed = cut && area < 0;
        (self.at, self.end) = (0, if outcome.is_drawn() { count } else { 0 });
        if outcome.is_drawn() {
            self.step_on(); // an area that is not zero has a triangle
        }
        outcome
    }

    /// The current triangle.
    #[inline(always)]
    pub(super) fn triangle(&self) -> &DepthTriangle<'v> {
        &self.triangle
    }

    /// Makes the next triangle of the face the current one; false if there is none.
    #[inline(always)]
    pub(super) fn advance(&mut self) -> bool {
        !self.is_cached() && self.step_on()
    }

    /// Makes the next triangle of the fan that has the polygon's orientation the current one. Rounding may turn a sliver over,
    /// which would then be drawn on top of its neighbour.
    #[cold]
    #[inline(never)]
    fn step_on(&mut self) -> bool {
        while self.at < self.end {
            let at = usize::from(self.at);
            let (Some(a), Some(b), Some(c)) = (self.corner(0), self.corner(at + 1), self.corner(at + 2))
            else {
                break;
            };
            self.at += 1; // at most clip::CORNERS
            let area = raster::area(&[a.point, b.point, c.point]);
            if area > 0 || !self.is_cut {
                set_triangle::<true>(&mut self.triangle, &[a, b, c], area);
                return true;
            }
        }
        false
    }

    /// Clip space's w at the corners of the current triangle, for a clipped face.
    #[inline(never)] // rare path: code size counts
    pub(super) fn clip_w(&self) -> [i32; 3] {
        self.slots_called().map(|slot| match self.polygon.corner(slot) {
            Some(ClipCoords { xydw: [.., w] }) => *w,
            None => 1, // the fan's slots exist
        })
    }

    /// Whether the clipped face is seen from behind.
    #[cfg(test)]
    pub(super) fn is_reversed(&self) -> bool {
        self.reversed
    }

    /// The bounding box of the face's pixels.
    #[inline(always)]
    pub(super) fn bounds(&self) -> Scissor {
        if self.is_cached() {
            Scissor::bounding_box(self.triangle.triangle.corners())
        } else {
            self.polygon_bounds()
        }
    }

    #[cold]
    #[inline(never)]
    fn polygon_bounds(&self) -> Scissor {
        self.polygon.bounds()
    }

    /// The slots of the current triangle's corners.
    fn slots(&self) -> [usize; 3] {
        let at = usize::from(self.at);
        [0, at, at + 1].map(|corner| self.slot(corner))
    }

    /// [`slots`](Self::slots) as a function, where code size matters more than speed.
    #[inline(never)]
    fn slots_called(&self) -> [usize; 3] {
        self.slots()
    }

    /// The slot of a corner of the polygon.
    fn slot(&self, corner: usize) -> usize {
        let order = &self.polygon.order;
        let corner = if self.reversed { order.len().wrapping_sub(corner + 1) } else { corner };
        order.get(corner).map_or(CLIP_SLOTS, |&slot| slot.into()) // beyond the polygon: no slot
    }

    /// A corner of the polygon, if there is one.
    #[inline(never)] // rare path: code size counts
    fn corner(&self, corner: usize) -> Option<UnpackedVertex> {
        self.polygon.corner(self.slot(corner)).map(UnpackedVertex::from_clip_slot)
    }
}

/// Sets the corners, the area and, with `DEPTH`, the depths of a triangle.
#[inline(always)]
fn set_triangle<const DEPTH: bool>(
    triangle: &mut DepthTriangle<'_>,
    corners: &[UnpackedVertex; 3],
    area: i64,
) {
    triangle.triangle.set(map3(*corners, |corner| corner.point), area);
    if DEPTH {
        triangle.depths = map3(*corners, |corner| corner.depth);
    }
}
