//! NDC to screen: where on the target the picture goes.

use crate::math::num::scale;
use crate::math::Point3;
use crate::raster::{ScreenPoint, GUARD_BAND};
use crate::space::Ndc;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// A rectangle of the target, in pixels. It may lie partly or wholly outside the target; only
/// what lies in both is drawn.
///
/// NDC −1 and +1 fall on its outer borders, not on pixel centres; y is mirrored, since rows count
/// downwards: `x = x₀ + (x + 1)·W/2`, `y = y₀ + (1 − y)·H/2`.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use pinhole::{Point3, Viewport, ViewportError};
/// let viewport = Viewport::new(Point::new(10, 20), Size::new(240, 180))?;
/// let corner = viewport.apply(Point3::from_ints(-1, 1, 0)); // NDC top left
/// assert_eq!((corner.x(), corner.y()), (10 * 256, 20 * 256));
/// # Ok::<(), ViewportError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    area: Rectangle,
}

/// Why there is no such viewport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ViewportError {
    /// Width or height is zero: give it pixels.
    Empty,
    /// It leaves ±8192 pixels about the target's origin: place it, or scale it, inside.
    OutsideGuardBand,
}

impl core::fmt::Display for ViewportError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Empty => "the viewport has no pixels",
            Self::OutsideGuardBand => "the viewport leaves the guard band of ±8192 pixels",
        })
    }
}

impl core::error::Error for ViewportError {}

impl Viewport {
    /// The rectangle of `size` with its corner at `top_left`.
    ///
    /// # Errors
    ///
    /// [`ViewportError::Empty`], and [`OutsideGuardBand`](ViewportError::OutsideGuardBand) beyond ±8192 pixels.
    pub const fn new(top_left: Point, size: Size) -> Result<Self, ViewportError> {
        if size.width == 0 || size.height == 0 {
            return Err(ViewportError::Empty);
        }
        const fn inside(low: i32, extent: u32) -> bool {
            low >= -GUARD_BAND && low as i64 + extent as i64 <= GUARD_BAND as i64
        }
        if !inside(top_left.x, size.width) || !inside(top_left.y, size.height) {
            return Err(ViewportError::OutsideGuardBand);
        }
        Ok(Self { area: Rectangle::new(top_left, size) })
    }

    /// Width and height in pixels: also the aspect that a perspective wants.
    pub const fn size(&self) -> Size {
        self.area.size
    }

    /// The corner at the smallest x and y, in pixels of the target.
    pub const fn top_left(&self) -> Point {
        self.area.top_left
    }

    /// A point of NDC on the screen, rounded to the nearest 1/256 pixel (ties up) and saturated
    /// at the guard band.
    pub fn apply(&self, p: Point3<Ndc>) -> ScreenPoint {
        let [x, y, _] = p.bits();
        let (half_width, half_height) = self.half_extent();
        let (centre_x, centre_y) = self.centre();
        // Pixels in 2⁻¹ times NDC in 2⁻¹⁶ are 2⁻¹⁷; 24.8 wants 2⁻⁸. 15 × 32 bits fit easily.
        let along = |centre: i32, half: i64| {
            let v = i64::from(centre) + scale(half, -9);
            v.clamp(i64::from(-GUARD_BAND * 256), i64::from(GUARD_BAND * 256)) as i32
        };
        ScreenPoint::clamped(
            along(centre_x, half_width * i64::from(x)),
            along(centre_y, -half_height * i64::from(y)),
        )
    }

    /// The centre in 24.8: a whole number of half pixels.
    pub(super) const fn centre(&self) -> (i32, i32) {
        // ±8192 px · 256 = 2²¹; half an extent of at most 2¹⁴ px is 2²¹ more.
        let Rectangle { top_left, size } = self.area;
        (top_left.x * 256 + size.width as i32 * 128, top_left.y * 256 + size.height as i32 * 128)
    }

    /// Half the extents in half pixels, which are the extents in pixels.
    fn half_extent(&self) -> (i64, i64) {
        (i64::from(self.area.size.width), i64::from(self.area.size.height))
    }

    pub(super) const fn area(&self) -> Rectangle {
        self.area
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for Viewport {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Rectangle { top_left, size } = self.area;
        defmt::write!(f, "{=u32}x{=u32}+{=i32}+{=i32}", size.width, size.height, top_left.x, top_left.y);
    }
}
