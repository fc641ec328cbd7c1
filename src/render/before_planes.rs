//! Corners in clip space, cut and brought to the screen: one code for edges, faces and all that they carry.

use super::fan::{Outcome, Pieces};
use super::Cull;
use crate::camera::{Image, Placement};
use crate::clip::{self, Cut, Outside};
use crate::math::Homogeneous;

/// Takes along what else varies where an edge is cut: see [`Cut::put`].
pub(super) type Carry<'a> = dyn FnMut(usize, usize, usize, i64) + 'a;

/// The corners of a point, an edge or a face, and the planes of the view volume cut at the guard band.
pub(super) struct BeforePlanes<'a> {
    placement: &'a Placement,
    planes: usize,
    places: &'a mut [Homogeneous],
    carry: &'a mut Carry<'a>,
}

impl Cut for BeforePlanes<'_> {
    #[inline(never)] // rare, as all here: small is better
    fn distance(&self, plane: usize, at: usize) -> i64 {
        self.places.get(at).map_or(0, |point| self.placement.distance(plane, point))
    }

    #[inline(never)]
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i64) {
        if let (Some(a), Some(b)) = (self.places.get(inside), self.places.get(outside)) {
            let point = a.towards(b, t);
            if let Some(place) = self.places.get_mut(at) {
                *place = point;
            }
        }
        (self.carry)(at, inside, outside, t);
    }
}

impl<'a> BeforePlanes<'a> {
    /// `far`: whether the far plane cuts too.
    pub(super) fn new(
        placement: &'a Placement,
        far: bool,
        places: &'a mut [Homogeneous],
        carry: &'a mut Carry<'a>,
    ) -> Self {
        Self { placement, planes: 5 + usize::from(far), places, carry }
    }

    /// The image of the first corner, or `None` where that is outside.
    #[inline(never)]
    pub(super) fn point(self) -> Option<Image> {
        (Outside::of(&self, 1, self.planes).any == 0).then(|| self.image(0))
    }

    /// The ends of an edge on the screen and whether the planes took anything of it, or `None` when
    /// they take it all.
    #[inline(never)]
    pub(super) fn edge(mut self) -> Option<([Image; 2], bool)> {
        let outside = Outside::of(&self, 2, self.planes);
        let planes = if outside.any == 0 { 0 } else { self.planes };
        if outside.all != 0 || !clip::line_at(&mut self, planes) {
            return None;
        }
        Some(([self.image(0), self.image(1)], outside.any != 0))
    }

    /// What becomes of a face, and what is left of it as a fan.
    #[inline(never)]
    pub(super) fn face(mut self, cull: Cull, pieces: &mut Pieces) -> Outcome {
        let outside = Outside::of(&self, 3, self.planes);
        if outside.all != 0 {
            return Outcome::Outside;
        }
        // Where no plane cuts it, it is only farther out than corners reach.
        let (planes, drawn) =
            if outside.any == 0 { (0, Outcome::Whole) } else { (self.planes, Outcome::Cut) };
        let polygon = clip::triangle_at(&mut self, planes);
        if polygon.len() < 3 {
            return Outcome::Outside;
        }
        pieces.begin(polygon, |at| self.image(at));
        let outcome = cull.turned(pieces.area, drawn);
        match outcome {
            Outcome::Whole => pieces.end(),
            Outcome::Cut => pieces.face_viewer(),
            Outcome::Culled | Outcome::Degenerate | Outcome::Outside => {}
        }
        outcome
    }

    fn image(&self, at: usize) -> Image {
        // One of the places, always.
        self.placement.image(self.places.get(at).unwrap_or(&Homogeneous::ZERO))
    }
}
