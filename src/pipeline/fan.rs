//! What is drawn of a face: itself, or the triangles of a polygon that the planes left.

use super::{put, Cull, Shader};
use crate::camera::UnpackedVertex;
use crate::clip::{Order, Varying, CLIP_SLOTS};
use crate::math::num::{after, keep_rolled};
use crate::math::ClipCoords;
use crate::raster::{self, DepthTriangle, Scissor};

/// What becomes of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    Culled,
    Degenerate,
    Outside,
    /// With its corners as they are.
    Whole,
    /// As the planes leave it.
    Cut,
}

impl Outcome {
    #[inline(always)]
    pub(super) fn is_drawn(self) -> bool {
        matches!(self, Self::Whole | Self::Cut)
    }
}

impl Cull {
    /// Leaves out what has no area, or is turned away.
    #[inline(always)]
    pub(super) fn turned(self, area: i64, drawn: Outcome) -> Outcome {
        if area == 0 {
            Outcome::Degenerate
        } else if area < 0 && self == Self::Back {
            Outcome::Culled
        } else {
            drawn
        }
    }
}

/// What the planes leave of a face, on the screen.
pub(super) struct Polygon {
    /// Corners: in clip space while planes cut, then on the screen.
    pub(super) places: [ClipCoords; CLIP_SLOTS],
    /// Where those of the polygon stand, which is where they are carried.
    pub(super) order: Order,
}

impl Polygon {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { places: [ClipCoords::ZERO; CLIP_SLOTS], order: Order::new() }
    }

    /// A face with all of its corners on the screen.
    pub(super) fn whole(&mut self, corners: &[UnpackedVertex; 3]) {
        for (place, corner) in self.places.iter_mut().zip(corners) {
            *place = corner.held();
        }
        self.order.clear();
        let _ = self.order.extend_from_slice(&[0, 1, 2]); // there is room
    }

    /// Where it may cover pixels, though a triangle may be left out.
    pub(super) fn reach(&self) -> Scissor {
        let mut reach = Scissor::UNION_IDENTITY;
        for &at in &self.order {
            keep_rolled();
            if let Some(place) = self.places.get(usize::from(at)) {
                reach = reach.union(&Scissor::bounding_box(&[UnpackedVertex::of_held(place).point; 3]));
            }
        }
        reach
    }
}

/// How far one has come with the triangles of a polygon: the fan about its first corner.
pub(super) struct Progress {
    /// What becomes of the face: known with its first triangle.
    pub(super) outcome: Outcome,
    /// Whether the polygon is taken from its last corner to its first.
    turned: bool,
    /// Where the fan stands: the next triangle's corners are the first one, and the two behind this.
    at: u8,
    /// Where it ends.
    end: u8,
}

impl Progress {
    /// Of a face that was not looked at.
    pub(super) const BEGIN: Self = Self { outcome: Outcome::Outside, turned: false, at: 0, end: 1 };

    /// Of a face that is drawn with its corners as they are.
    const WHOLE: Self = Self { outcome: Outcome::Whole, turned: false, at: 0, end: 0 };

    /// Whether there may be one more triangle.
    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.at < self.end
    }

    /// A convex polygon: what becomes of it. One that is not cut is farther out than corners reach, or was not kept.
    #[inline(never)] // its frame is gone when it returns
    pub(super) fn begin(&mut self, polygon: &Polygon, cull: Cull, cut: bool) {
        (self.turned, self.at) = (false, 0);
        let (mut area, mut corners) = (0, [UnpackedVertex::ORIGIN; 3]);
        while let Some(piece) = self.step(polygon, &mut corners) {
            area += piece; // < 7·2⁴⁵
        }
        self.outcome = match self.at {
            0 => Outcome::Outside,
            _ => cull.turned(area, if cut { Outcome::Cut } else { Outcome::Whole }),
        };
        // All triangles of one that was cut are counter-clockwise from here on.
        self.turned = cut && area < 0;
        (self.at, self.end) = (0, if self.outcome.is_drawn() { self.at } else { 0 });
    }

    /// Where the polygon's corner of this number stands.
    fn place(&self, order: &Order, corner: usize) -> usize {
        let corner = if self.turned { order.len().wrapping_sub(corner + 1) } else { corner };
        order.get(corner).map_or(CLIP_SLOTS, |&place| place.into()) // where there are not so many, none stands there
    }

    /// The next triangle, and its area, if there is one more.
    #[inline(never)] // rare: small is better
    fn step(&mut self, polygon: &Polygon, corners: &mut [UnpackedVertex; 3]) -> Option<i64> {
        let at = usize::from(self.at);
        let mut i = 0;
        while let Some(image) = corners.get_mut(i) {
            let corner = if i == 0 { 0 } else { at + i };
            *image = UnpackedVertex::of_held(polygon.places.get(self.place(&polygon.order, corner))?);
            i = after(i);
        }
        self.at += 1; // fewer than CORNERS
        Some(raster::area(&corners.map(|corner| corner.point)))
    }

    /// The next triangle that faces as the polygon does, and its area, not zero: rounding of the corners may
    /// turn a sliver over, which would be drawn on top of its neighbour.
    pub(super) fn next(&mut self, polygon: &Polygon, corners: &mut [UnpackedVertex; 3]) -> Option<i64> {
        while self.goes_on() {
            let area = self.step(polygon, corners)?;
            if area > 0 || self.outcome != Outcome::Cut {
                return Some(area);
            }
        }
        None
    }

    /// Puts the next triangle there, if there is one; the first time it begins with the polygon.
    #[inline(never)]
    pub(super) fn next_into(
        &mut self,
        polygon: &Polygon,
        cull: Cull,
        cut: bool,
        piece: &mut DepthTriangle<'_>,
    ) -> bool {
        if self.at == 0 {
            self.begin(polygon, cull, cut);
        }
        let mut corners = [UnpackedVertex::ORIGIN; 3];
        let area = self.next(polygon, &mut corners);
        if let Some(area) = area {
            put::<true>(piece, &corners, area);
        }
        area.is_some()
    }
}

/// What the corners of a face carry, whatever that is.
pub(super) trait ClipVaryings {
    /// Of the whole face.
    fn begin(&mut self);

    /// Takes it along where an edge is cut: see [`Cut::put`](crate::clip::Cut::put).
    fn carry(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

impl<K: Varying> ClipVaryings for [K; CLIP_SLOTS] {
    fn begin(&mut self) {
        for (corner, carried) in self.iter_mut().take(3).enumerate() {
            *carried = K::of(corner);
        }
    }

    fn carry(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        if let (Some(a), Some(b)) = (self.get(inside), self.get(outside)) {
            let carried = a.towards(b, t.into());
            if let Some(place) = self.get_mut(at) {
                *place = carried;
            }
        }
    }
}

/// The triangles of one face, one after the other, with what their corners carry. The polygon is not kept, as all loops over
/// faces have this in their frame, but one corner of it: most faces that a plane cuts are two triangles. For every two more
/// the polygon is made again.
pub(super) struct Fan<K> {
    pub(super) progress: Progress,
    /// Of the last triangle's corners.
    carried: [K; 3],
    /// The next triangle is the last one's first and third corner, and this, if it is known.
    next: Option<(UnpackedVertex, K)>,
}

impl<K: Varying> Fan<K> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { progress: Progress::BEGIN, carried: [K::of(0); 3], next: None }
    }

    /// Goes on to another face.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        (self.progress, self.next) = (Progress::BEGIN, None);
    }

    /// Goes on to a face that is drawn with its corners as they are.
    #[inline(always)]
    pub(super) fn whole(&mut self) {
        self.progress = Progress::WHOLE;
    }

    /// Whether there may be one more triangle.
    #[inline(always)]
    pub(super) fn goes_on(&self) -> bool {
        self.progress.goes_on()
    }

    /// Of the polygon's corners, what the last triangle's carry, and the next one.
    pub(super) fn take(&mut self, polygon: &Polygon, carried: &[K; CLIP_SLOTS]) {
        let at = usize::from(self.progress.at);
        let place = |corner| self.progress.place(&polygon.order, corner);
        let carries = |corner| carried.get(place(corner)).copied().unwrap_or_else(|| K::of(0));
        self.carried = [0, at, at + 1].map(carries);
        let next = polygon.places.get(place(at + 2));
        self.next = next.map(|corner| (UnpackedVertex::of_held(corner), carries(at + 2)));
    }

    /// Puts the next triangle there, if it is known and faces as the polygon does.
    pub(super) fn next_into(&mut self, piece: &mut DepthTriangle<'_>) -> bool {
        let Some((next, carried)) = self.next.take() else { return false };
        let ([a, _, c], [x, _, z]) = (*piece.triangle.corners(), piece.depths);
        let corners = [UnpackedVertex { point: a, depth: x }, UnpackedVertex { point: c, depth: z }, next];
        self.carried = [self.carried[0], self.carried[2], carried];
        self.progress.at += 1; // fewer than CORNERS
        let area = raster::area(&corners.map(|corner| corner.point));
        put::<true>(piece, &corners, area);
        area > 0
    }

    /// What the triangle that was last is filled with.
    #[inline(always)]
    pub(super) fn ink<I: Shader<Varying = K>>(&self, ink: &I) -> I {
        match self.progress.outcome {
            Outcome::Cut => ink.sub_face(self.carried),
            _ => *ink,
        }
    }
}
