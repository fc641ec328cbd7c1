//! The viewport transform: NDC to the screen.

use super::rotation::Rotation;
use crate::camera::CameraError;
use crate::math::num::scale;
use crate::math::Point3;
use crate::raster::{ScreenPoint, GUARD_BAND};
use crate::space::Ndc;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The rectangle of the target, in pixels, that shows the picture. It may extend beyond the target: only pixels inside both are
/// drawn.
///
/// NDC −1 and +1 of a picture that is neither [turned](Self::rotated) nor [jittered](Self::jittered) map to its outer borders, not to pixel
/// centres; y is negated, because screen y grows downwards:
/// `x = x₀ + (x + 1)·W/2`, `y = y₀ + (1 − y)·H/2`.
///
/// ```
/// use embedded_graphics::geometry::{Point, Size};
/// use pinhole::{Point3, Viewport};
/// let viewport = Viewport::new(Point::new(10, 20), Size::new(240, 180))?;
/// let corner = viewport.apply(Point3::from_ints(-1, 1, 0)); // NDC top left
/// assert_eq!((corner.x(), corner.y()), (10 * 256, 20 * 256));
/// # Ok::<(), pinhole::camera::CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    area: Rectangle,
    rotation: Rotation,
    /// How far the picture is moved, in 2⁻⁸ pixel: less than half a pixel.
    jitter: [i8; 2],
}

impl Viewport {
    /// The viewport of `size` pixels with its top left corner at `top_left`, in pixels of the target.
    ///
    /// # Errors
    ///
    /// [`CameraError::Viewport`] if width or height is zero, or the viewport extends beyond ±8192 pixels.
    pub const fn new(top_left: Point, size: Size) -> Result<Self, CameraError> {
        if size.width == 0 || size.height == 0 {
            return Err(CameraError::Viewport);
        }
        const fn inside(low: i32, extent: u32) -> bool {
            low >= -GUARD_BAND && low as i64 + extent as i64 <= GUARD_BAND as i64
        }
        if !inside(top_left.x, size.width) || !inside(top_left.y, size.height) {
            return Err(CameraError::Viewport);
        }
        Ok(Self { area: Rectangle::new(top_left, size), rotation: Rotation::Deg0, jitter: [0; 2] })
    }

    /// This viewport with its picture turned, for a panel that is mounted turned: the camera draws the turned picture at no cost for a pixel,
    /// and bands of the [area](Self::area) run along the rows that the controller scans. [`size`](Self::size) is then that of the picture as
    /// its viewer sees it, while depths, bands, touched pixels and projected points keep the coordinates of the panel.
    ///
    /// Text and icons are turned by [`upright`](Self::upright), their points by [`upright_point`](Self::upright_point), sprites by [`Sprite::rotated`](crate::sprite::Sprite::rotated).
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{camera::Rotation, prelude::*, Angle};
    /// // A roof, whose ridge is its upper vertex, on a panel of 12 × 8 pixels whose left border is at the top of the device.
    /// const ROOF: [[i16; 3]; 3] = [[-60, -30, 0], [60, -30, 0], [0, 30, 0]];
    /// let mesh = Mesh::new(&ROOF, 0, &[[0, 1, 2]])?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(12, 8))?.rotated(Rotation::Deg270);
    /// assert_eq!(viewport.size(), Size::new(8, 12));
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut panel = MockDisplay::new();
    /// camera.place(&mesh, &Affine::identity()).faces(|_| BinaryColor::On).draw(&mut panel)?;
    /// panel.assert_pattern(&[
    ///     "            ",
    ///     "       #    ",
    ///     "      ##    ",
    ///     "     ###    ",
    ///     "     ###    ",
    ///     "      ##    ",
    ///     "       #    ",
    /// ]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn rotated(self, rotation: Rotation) -> Self {
        Self { rotation, ..self }
    }

    /// This viewport with its picture moved by a part of a pixel: to the right and downwards on the target, in 1/256 pixel, −127 to 127; −128
    /// counts as −127. Every point moves by exactly so much, and the [area](Self::area) stays. The mean of frames that are jittered evenly is
    /// anti-aliased, textures and intersections included, without more memory for a frame's depth: for still pictures, and for displays that
    /// are slower than drawing, as e-paper (accumulation buffer: Haeberli and Akeley, SIGGRAPH 1990).
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// const SIZE: Size = Size::new(64, 64);
    /// let viewport = Viewport::new(Point::zero(), SIZE)?;
    /// let mut mean = [0; 64 * 64];
    /// for jitter in [[-32, -96], [96, -32], [32, 96], [-96, 32]] { // four samples, turned against rows and columns
    ///     let viewport = viewport.jittered(jitter);
    ///     let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::degrees(30), Angle::degrees(20))?;
    ///     let mut pixels = [Gray8::BLACK; 64 * 64];
    ///     let mut picture = Picture::new(&mut pixels, SIZE)?;
    ///     camera.place(&CUBE, &Affine::identity()).faces(|_| Gray8::WHITE).draw(&mut picture.pixels())?;
    ///     for (mean, pixel) in mean.iter_mut().zip(&pixels) {
    ///         *mean += pixel.luma() / 4;
    ///     }
    /// }
    /// let mixed = mean.iter().filter(|&&level| level != 0 && level != 252).count();
    /// assert!(mixed > 100); // the outline
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn jittered(self, [x, y]: [i8; 2]) -> Self {
        // Less than half a pixel: what lies beyond a border covers no pixel's centre before it.
        Self { jitter: [if x < -127 { -127 } else { x }, if y < -127 { -127 } else { y }], ..self }
    }

    /// Width and height of the picture in pixels, as its viewer sees it; also serves as the aspect ratio for
    /// [`Projection::perspective`](crate::Projection::perspective).
    pub const fn size(&self) -> Size {
        self.rotation.of_size(self.area.size)
    }

    /// The rectangle of the target.
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// How far the picture is [turned](Self::rotated).
    pub const fn rotation(&self) -> Rotation {
        self.rotation
    }

    /// The screen position of a point in NDC, rounded to the nearest 1/256 pixel (ties up) and clamped to the guard band.
    pub fn apply(&self, p: Point3<Ndc>) -> ScreenPoint {
        let [x, y, _] = p.bits();
        let (is_swapped, [across, up]) = self.rotation.axes();
        let [x, y] = if is_swapped { [y, x] } else { [x, y] };
        let (half_width, half_height) = self.half_extent();
        let (centre_x, centre_y) = self.centre();
        // Half pixels times NDC in 2⁻¹⁶ are in 2⁻¹⁷, screen positions in 2⁻⁸. Products have 15 + 32 bits.
        let along = |centre: i32, half: i64| {
            let v = i64::from(centre) + scale(half, -9);
            v.clamp(i64::from(-GUARD_BAND * 256), i64::from(GUARD_BAND * 256)) as i32
        };
        ScreenPoint::clamped(
            along(centre_x, half_width * i64::from(x) * i64::from(across)),
            along(centre_y, -half_height * i64::from(y) * i64::from(up)),
        )
    }

    /// The centre in 24.8: a multiple of half a pixel, and the jitter.
    pub(super) const fn centre(&self) -> (i32, i32) {
        // ±8192 px · 256 = 2²¹; half an extent of at most 2¹⁴ px adds 2²¹.
        let Rectangle { top_left, size } = self.area;
        let (x, y) =
            (top_left.x * 256 + size.width as i32 * 128, top_left.y * 256 + size.height as i32 * 128);
        (x + self.jitter[0] as i32, y + self.jitter[1] as i32)
    }

    /// Half of width and height in half pixels, which equals width and height in pixels.
    fn half_extent(&self) -> (i64, i64) {
        (i64::from(self.area.size.width), i64::from(self.area.size.height))
    }
}

defmt_format!(
    [] Viewport, self,
    "{=u32}x{=u32}+{=i32}+{=i32} {}",
    self.area.size.width, self.area.size.height, self.area.top_left.x, self.area.top_left.y, self.rotation
);
