//! Corners in clip space, cut and brought to the screen: one code for edges, faces and all that they carry.

use super::fan::ClipVaryings;
use crate::camera::{DepthOf, UnpackedVertex, VertexTransform};
use crate::clip::{self, Cut, Order};
use crate::math::ClipCoords;

/// The corners of a point, an edge or a face, and the planes of the view volume cut at the guard band.
pub(super) struct FaceClipper<'a> {
    pub(super) placement: &'a VertexTransform,
    /// Whether the far plane cuts too.
    pub(super) far: bool,
    pub(super) depth: Option<DepthOf>,
    pub(super) places: &'a mut [ClipCoords],
    pub(super) carried: Option<&'a mut dyn ClipVaryings>,
}

impl Cut for FaceClipper<'_> {
    #[inline(never)] // rare, as all here: small is better
    fn distance(&self, plane: usize, at: usize) -> i64 {
        self.places.get(at).map_or(0, |point| self.placement.distance(plane, point))
    }

    #[inline(never)]
    fn put(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        ClipCoords::put(self.places, at, inside, outside, t);
        if let Some(carried) = &mut self.carried {
            carried.carry(at, inside, outside, t);
        }
    }
}

impl FaceClipper<'_> {
    fn planes(&self) -> usize {
        5 + usize::from(self.far)
    }

    /// The image of the first corner, or `None` where that is outside.
    #[inline(never)]
    pub(super) fn point(self) -> Option<UnpackedVertex> {
        (0..self.planes()).all(|plane| self.distance(plane, 0) >= 0).then(|| self.image(0))
    }

    /// The ends of an edge on the screen and whether the planes took anything of it, or `None` when
    /// they take it all.
    #[inline(never)]
    pub(super) fn edge(mut self) -> Option<([UnpackedVertex; 2], bool)> {
        let planes = self.planes();
        let cut = clip::line_at(&mut self, planes)?;
        Some(([self.image(0), self.image(1)], cut))
    }

    /// What is left of a face as a polygon, on the screen, and whether the planes took anything of it.
    #[inline(never)]
    pub(super) fn face(mut self, polygon: &mut Order) -> bool {
        let planes = self.planes();
        let cut = clip::triangle_at(&mut self, planes, polygon);
        for &at in polygon.iter() {
            let image = self.image(at.into());
            if let Some(place) = self.places.get_mut(usize::from(at)) {
                *place = image.held();
            }
        }
        cut
    }

    #[inline(never)]
    fn image(&self, at: usize) -> UnpackedVertex {
        // One of the places, always.
        self.placement.image(self.places.get(at).unwrap_or(&ClipCoords::ZERO), self.depth)
    }
}
