//! What is drawn at a time.

use crate::camera::Image;
use crate::raster::{Scissor, ScreenPoint, Triangle};

/// A triangle to draw, a face or a part of one. There is room for one, used for all of a mesh.
pub(super) struct Piece<'v> {
    pub(super) triangle: Triangle<'v>,
    /// Of its corners, if depth was computed.
    pub(super) depths: [i32; 3],
}

impl<'v> Piece<'v> {
    /// None yet.
    #[inline(always)]
    pub(super) fn new(viewport: &'v Scissor) -> Self {
        Self { triangle: Triangle::new([ScreenPoint::ORIGIN; 3], 0, viewport), depths: [0; 3] }
    }

    /// Takes these corners, and their [`raster::area`](crate::raster::area).
    #[inline(always)]
    pub(super) fn put<const DEPTH: bool>(&mut self, corners: &[Image; 3], area: i64) {
        self.triangle.put(corners.map(|corner| corner.point), area);
        if DEPTH {
            self.depths = corners.map(|corner| corner.depth);
        }
    }
}
