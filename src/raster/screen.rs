//! Points and pixels of the screen.

use embedded_graphics_core::geometry::Point;

/// The guard band: 3D geometry is clipped this many pixels to each side of the target's origin.
pub(crate) const GUARD_BAND: i32 = 8192;

/// A point on the screen in 24.8: x to the right and y downwards, in sub-pixels of 1/256 pixel. Pixel (i, j) covers
/// [256·i, 256·i + 256) × [256·j, 256·j + 256). All points lie inside the guard band or on its border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScreenPoint {
    pub(crate) x: i32,
    pub(crate) y: i32,
}

impl ScreenPoint {
    pub(crate) const ORIGIN: Self = Self { x: 0, y: 0 };

    /// The point with these coordinates in 1/256 pixel, for 2D drawing; `None` beyond ±2²¹, which is 8192 pixels.
    pub const fn from_subpixels(x: i32, y: i32) -> Option<Self> {
        const LIMIT: i32 = GUARD_BAND * 256;
        // The sign bit is set if any difference is negative or wraps: one test for four comparisons.
        let room =
            x.wrapping_add(LIMIT) | LIMIT.wrapping_sub(x) | y.wrapping_add(LIMIT) | LIMIT.wrapping_sub(y);
        if room < 0 {
            return None;
        }
        Some(Self { x, y })
    }

    /// The point (x, y), in sub-pixels, clamped to the guard band.
    pub(crate) fn clamped(x: i32, y: i32) -> Self {
        const LIMIT: i32 = GUARD_BAND * 256;
        Self { x: x.clamp(-LIMIT, LIMIT), y: y.clamp(-LIMIT, LIMIT) }
    }

    /// A point that the caller has shown to lie in the guard band: see `VertexTransform::project`.
    #[inline(always)]
    pub(crate) fn inside(x: i32, y: i32) -> Self {
        debug_assert!(Self::from_subpixels(x, y).is_some(), "({x}, {y})");
        Self { x, y }
    }

    /// The distance right of the target's origin in 1/256 pixel.
    pub const fn x(self) -> i32 {
        self.x
    }

    /// The distance below the target's origin in 1/256 pixel.
    pub const fn y(self) -> i32 {
        self.y
    }

    /// The pixel that contains the point: (⌊x⌋, ⌊y⌋).
    pub(crate) const fn pixel(self) -> Pixel {
        // ±2²¹ / 256 fits 16 bits.
        Pixel { x: (self.x >> 8) as i16, y: (self.y >> 8) as i16 }
    }
}

/// A pixel by its column and row, such as an end of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pixel {
    pub(crate) x: i16,
    pub(crate) y: i16,
}

/// Columns and rows beyond −32768 … 32767 count as the nearest of these.
impl From<Point> for Pixel {
    #[inline(always)] // at opt-level s a call for each end takes 6 % more of S6 `dt-s` on an M3
    fn from(Point { x, y }: Point) -> Self {
        let nearest = |at: i32| at.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        Self { x: nearest(x), y: nearest(y) }
    }
}

/// The pixel that contains the point, (⌊x⌋, ⌊y⌋): for text and icons at a projected point.
///
/// ```
/// use embedded_graphics::prelude::Point;
/// use pinhole::raster::ScreenPoint;
/// let corner = ScreenPoint::from_subpixels(10 * 256 + 255, -1).unwrap();
/// assert_eq!(Point::from(corner) + Point::new(4, 0), Point::new(14, -1));
/// ```
impl From<ScreenPoint> for Point {
    fn from(point: ScreenPoint) -> Self {
        let Pixel { x, y } = point.pixel();
        Self::new(x.into(), y.into())
    }
}
