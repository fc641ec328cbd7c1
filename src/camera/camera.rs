//! The camera: view transform, projection and viewport folded into four linear forms.

use super::depth_by_w::DepthByW;
use super::projection::Projection;
use super::screen_vertex::ScreenVertex;
use super::view_transform::ViewTransform;
use super::viewport::Viewport;
use crate::math::num::{max, min, mul_translation};
use crate::math::Row;
use crate::raster::GUARD_BAND;

use embedded_graphics_core::primitives::Rectangle;

/// View transform, projection and viewport, composed into one 4 × 4 matrix. [`place`](Self::place) combines it with a mesh and
/// its model transform; [`MeshInstance::project`](crate::draw::MeshInstance::project) documents the error of projected vertices.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use pinhole::{prelude::*, Angle};
/// let viewport = Viewport::new(Point::zero(), Size::new(240, 240))?;
/// let camera = Camera::new(
///     &ViewTransform::look_at(Point3::from_ints(0, 2, 6), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))?,
///     &Projection::perspective(Angle::degrees(50), viewport.size(), Scalar::from_int(1), Scalar::from_int(50))?,
///     &viewport,
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A camera that never moves can be a `const`: it takes 224 bytes of flash and no set-up code, and wrong parameters do not
/// compile.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use pinhole::{prelude::*, Angle};
/// const CAMERA: Camera = {
///     let (eye, origin, up) = (Point3::from_ints(0, 2, 6), Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0));
///     let Ok(viewing) = ViewTransform::look_at(eye, origin, up) else { panic!("the direction") };
///     let Ok(viewport) = Viewport::new(Point::zero(), Size::new(240, 240)) else { panic!("the size") };
///     let (near, far) = (Scalar::from_int(1), Scalar::from_int(50));
///     let Ok(lens) = Projection::perspective(Angle::degrees(50), viewport.size(), near, far) else { panic!("the lens") };
///     Camera::new(&viewing, &lens, &viewport)
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Camera {
    pub(super) axes: [[i32; 3]; 3],
    pub(super) eye: [i64; 3],
    /// x, y, d, w as linear forms of view coordinates.
    pub(super) rows: [Row; 4],
    /// Depth as a function of w, if the rows d and w are parallel.
    pub(super) depth_by_w: Option<DepthByW>,
    pub(super) screen: Screen,
    pub(super) far_clip: bool,
}

/// The viewport transform: normalised x and y to 24.8 screen coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Screen {
    /// The screen point of a packed vertex whose [offset](ScreenVertex::offset) is 0, in 24.8: a packed vertex is unpacked by one
    /// addition.
    pub(crate) packed_origin: [i32; 2],
    /// x/w and y/w are in units of 2^unit sub-pixels: 7 … 21.
    pub(crate) unit: i32,
    /// A point with |x/w| and |y/w| below 2^room lies inside the guard band, wherever the viewport's centre is: 0 … 14.
    pub(crate) room: i32,
    pub(crate) area: Rectangle,
}

impl Screen {
    /// The viewport's centre in 24.8.
    pub(crate) const fn centre(&self) -> [i32; 2] {
        let ([x, y], [cx, cy]) = (self.packed_origin, ScreenVertex::CENTRE);
        [x + cx, y + cy] // it lies in the guard band
    }
}

impl Camera {
    /// The camera with this view transform, projection and viewport. The near plane always clips; the far plane clips on
    /// [request](Self::with_far_clip).
    #[inline(never)] // set-up: code size counts
    pub const fn new(viewing: &ViewTransform, projection: &Projection, viewport: &Viewport) -> Self {
        let area = viewport.area();
        let ((x, y), [cx, cy]) = (viewport.centre(), ScreenVertex::CENTRE);
        // Half a pixel to 2²¹ sub-pixels, because the viewport is not empty and lies inside the guard band.
        let free = GUARD_BAND * 256 - max(x.abs(), y.abs());
        let half = max(area.size.width as i32, area.size.height as i32) * 128;
        // Binary logarithms, rounded down and up; `ilog2` would panic at 0.
        let room = 31 - max(free, 128).leading_zeros() as i32;
        let unit = min(32 - (max(half, 128) - 1).leading_zeros() as i32, room);
        let [x_row, y_row, d_row, w_row] = projection.rows();
        let (is_swapped, [across, up]) = viewport.rotation().axes();
        let (x_row, y_row) = if is_swapped { (y_row, x_row) } else { (x_row, y_row) };
        // Half the viewport in units of 2^unit sub-pixels; y is negated, because screen y grows downwards.
        let rows = [
            scaled_row(x_row, area.size.width as i32 * 128 * across, -unit),
            scaled_row(y_row, area.size.height as i32 * -128 * up, -unit),
            scaled_row(d_row, 65_535, -16),
            *w_row,
        ];
        Self {
            axes: viewing.rows(),
            eye: viewing.eye(),
            depth_by_w: DepthByW::new(&rows[2], w_row),
            rows,
            screen: Screen { packed_origin: [x - cx, y - cy], unit, room: room - unit, area },
            far_clip: false,
        }
    }

    /// Whether the far plane clips; by default it does not, and points beyond it are drawn with the largest depth, 65534.
    /// Drawing with a depth buffer always clips at the far plane.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{camera::CameraError, meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let beyond = Point3::from_ints(0, 0, -20); // the far plane is just behind the cube
    /// assert_eq!(camera.project(beyond).map(|seen| seen.depth), Ok(65_534));
    /// assert_eq!(camera.with_far_clip(true).project(beyond), Err(CameraError::BeyondFar));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn with_far_clip(self, far_clip: bool) -> Self {
        Self { far_clip, ..self }
    }
}

/// `row · factor · 2^exponent` for a factor of at most 23 bits.
#[inline(never)] // set-up: code size counts
const fn scaled_row(row: &Row, factor: i32, exponent: i32) -> Row {
    let ([a, b, c], m) = (row.linear, factor as i64); // 30 × 23 bits
    let offset = mul_translation(factor, exponent, row.offset);
    Row::new(&[a as i64 * m, b as i64 * m, c as i64 * m], row.exponent - 30 + exponent, offset)
}

defmt_format!(
    [] Camera, self,
    "axes {}/2^30, eye {}/2^32, centre ({=i32}, {=i32})/256",
    self.axes, self.eye, self.screen.centre()[0], self.screen.centre()[1]
);
