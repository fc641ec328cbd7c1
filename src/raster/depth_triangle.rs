//! Triangles with depth, as the pipeline passes them to fills.

use super::{Scissor, ScreenPoint, Triangle};

/// A triangle to fill, a face or a part of a clipped face, with the depths of its corners. A draw call keeps one and
/// overwrites it for each triangle.
#[derive(Debug)]
pub(crate) struct DepthTriangle<'v> {
    pub(crate) triangle: Triangle<'v>,
    /// The corners' depths in 16.8, or zeros if depth is not computed.
    pub(crate) depths: [i32; 3],
}

impl<'v> DepthTriangle<'v> {
    /// A placeholder that is overwritten before it is filled.
    #[inline(always)]
    pub(crate) fn new(viewport: &'v Scissor) -> Self {
        Self { triangle: Triangle::new([ScreenPoint::ORIGIN; 3], 0, viewport), depths: [0; 3] }
    }
}
