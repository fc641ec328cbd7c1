//! The bounding box of an edge.

use crate::camera::UnpackedVertex;
use crate::raster::Scissor;

/// The bounding box of the pixels of a line of one colour.
#[inline(always)]
pub(super) fn bounds([from, to]: &[UnpackedVertex; 2]) -> Scissor {
    let (from, to) = (from.point.pixel(), to.point.pixel());
    let (left, right) = (from.x.min(to.x), from.x.max(to.x));
    let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
    Scissor::new(left.into(), top.into(), i32::from(right) + 1, i32::from(bottom) + 1)
}
