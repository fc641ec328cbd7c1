//! What is drawn at a time.

use super::{Gradient, Scissor, ScreenPoint, Triangle};

/// A triangle to draw, a face or a part of one. There is room for one, used for all of a mesh.
#[derive(Debug)]
pub(crate) struct DepthTriangle<'v> {
    pub(crate) triangle: Triangle<'v>,
    /// Of its corners, if depth was computed.
    pub(crate) depths: [i32; 3],
}

impl<'v> DepthTriangle<'v> {
    /// None yet.
    #[inline(always)]
    pub(crate) fn new(viewport: &'v Scissor) -> Self {
        Self { triangle: Triangle::new([ScreenPoint::ORIGIN; 3], 0, viewport), depths: [0; 3] }
    }

    /// Its depth.
    #[inline(always)]
    pub(crate) fn plane(&self) -> Gradient {
        Gradient::of_depth(&self.triangle, &self.depths)
    }
}
