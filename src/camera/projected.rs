//! The answer of every projection: a position on the screen with its depth, or why there is none.

use super::VertexTransform;
use crate::camera::CameraError;
use crate::math::ClipCoords;
use crate::raster::ScreenPoint;
use embedded_graphics_core::geometry::Point;

/// A projected point: where it is seen, and how deep.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use pinhole::{camera::{CameraError, Projected}, meshes::CUBE, prelude::*, Angle};
/// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
/// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(30), Angle::ZERO, Angle::ZERO)?;
/// let Projected { point, depth } = camera.project(Point3::from_ints(0, 0, 0))?;
/// assert_eq!((point.x(), point.y()), (32 * 256, 32 * 256)); // in 1/256 pixel
/// assert!(depth > 0 && depth < 65_534);
/// let label: Point = camera.project(Point3::from_ints(0, 1, 0))?.into(); // for text and icons
/// assert_eq!(label.x, 32);
/// assert_eq!(camera.project(Point3::from_ints(0, 0, 100)), Err(CameraError::BeforeNear));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Projected {
    /// The position on the screen; it may lie outside of the viewport. For upright text on a turned picture, convert it by
    /// [`upright_point`](crate::Viewport::upright_point).
    pub point: ScreenPoint,
    /// The depth: 0 near to 65534 far.
    pub depth: u16,
}

/// The pixel that contains the point, as a point of `embedded-graphics`.
impl From<Projected> for Point {
    fn from(projected: Projected) -> Self {
        projected.point.into()
    }
}

impl VertexTransform {
    /// Why a point has no position on the screen; `None` if it has one.
    pub(crate) fn why_not_projected(&self, h: &ClipCoords) -> Option<CameraError> {
        let outside = |plane: usize| self.distance(plane, h) < 0;
        let [.., w] = h.xydw;
        if outside(0) || w <= 0 {
            Some(CameraError::BeforeNear)
        } else if (1..5).any(outside) {
            Some(CameraError::OutsideGuardBand)
        } else if self.clips_at_far() && outside(5) {
            Some(CameraError::BeyondFar)
        } else {
            None
        }
    }
}
