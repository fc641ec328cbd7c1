//! View volumes along −z: frustums (perspective) and boxes (orthographic).

use super::parts::{extent, offset, ratio, row};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::num::scale;
use crate::math::{Angle, Row, Scalar};
use embedded_graphics_core::geometry::Size;

impl Projection {
    /// The symmetric perspective with a vertical field of view of `fov_y`. `aspect` is width : height as any pair, usually the
    /// viewport's size; `near` and `far` are distances from the eye in world units.
    ///
    /// ```text
    ///     | cot(fov/2)·h/w  0           0             0           |
    ///     | 0               cot(fov/2)  0             0           |
    ///     | 0               0           −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0               0           −1            0           |
    /// ```
    ///
    /// cot(fov/2) has a relative error of 2⁻²⁷/sin(fov); (z + w)/2 a relative error of 2⁻³⁰ plus 2⁻³³.
    ///
    /// (*OpenGL Programming Guide*, appendix on homogeneous coordinates; Marschner and Shirley,
    /// *Fundamentals of Computer Graphics*, section on perspective projection.)
    ///
    /// ```
    /// use embedded_graphics::geometry::Size;
    /// use pinhole::{camera::CameraError, Angle, Projection, Scalar};
    /// let (near, far) = (Scalar::from_int(1), Scalar::from_int(20));
    /// let _ = Projection::perspective(Angle::degrees(60), Size::new(240, 240), near, far)?;
    /// let flat = Projection::perspective(Angle::degrees(180), Size::new(240, 240), near, far);
    /// assert_eq!(flat, Err(CameraError::FieldOfView));
    /// # Ok::<(), CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::FieldOfView`], [`Viewport`](CameraError::Viewport),
    /// [`NearNotPositive`](CameraError::NearNotPositive) and [`NearNotBeforeFar`](CameraError::NearNotBeforeFar).
    #[inline(never)] // set-up: code size counts
    pub const fn perspective(
        fov_y: Angle,
        aspect: Size,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, CameraError> {
        if !Self::is_field_of_view(fov_y) {
            return Err(CameraError::FieldOfView);
        }
        if aspect.width == 0 || aspect.height == 0 {
            return Err(CameraError::Viewport);
        }
        let (sine, cosine) = Angle::from_bits(fov_y.bits() / 2).sin_cos();
        // Half angles of 1/8192 … 2047/8192 turn: both positive, 30 bits; times 32-bit sides.
        let across = ratio(cosine as i64 * aspect.height as i64, sine as u64 * aspect.width as u64);
        let up = ratio(cosine as i64, sine as u64);
        Self::by_distance(&row(0, across, 0), &row(1, up, 0), near, far)
    }

    /// Whether a field of view is 1/4096 … 2047/4096 turn, so that the sine and cosine of its half are positive.
    pub(in crate::camera) const fn is_field_of_view(angle: Angle) -> bool {
        const LEAST: u32 = 1 << 20; // 1/4096 turn
        angle.bits() >= LEAST && angle.bits() <= (1 << 31) - LEAST
    }

    /// [`perspective`](Self::perspective) with the field of view across the narrower direction, for a field of view and an aspect
    /// ratio that are in range.
    pub(in crate::camera) const fn perspective_across(
        field_of_view: Angle,
        aspect: Size,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, CameraError> {
        let (sine, cosine) = Angle::from_bits(field_of_view.bits() / 2).sin_cos();
        let (sine, cosine) = (sine as u64, cosine as i64); // positive, 30 bits
        let Size { width, height } = aspect; // a viewport's, so at most 2¹⁴
        let narrower = if width < height { width } else { height } as i64;
        let across = ratio(cosine * narrower, sine * width as u64);
        let up = ratio(cosine * narrower, sine * height as u64);
        Self::by_distance(&row(0, across, 0), &row(1, up, 0), near, far)
    }

    /// The perspective whose frustum cuts `window` out of the near plane; the window may be off-axis. `near` and `far` are distances
    /// from the eye along −z, in world units.
    ///
    /// ```text
    ///     | 2n/(r−l)  0         (r+l)/(r−l)   0           |
    ///     | 0         2n/(t−b)  (t+b)/(t−b)   0           |
    ///     | 0         0         −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0         0         −1            0           |
    /// ```
    ///
    /// Coefficients of x and y are within 2⁻²⁹ of the row's largest, (z + w)/2 has a relative error of 2⁻³⁰ plus 2⁻³³.
    ///
    /// (OpenGL 1.x, `glFrustum`; *OpenGL Programming Guide*, appendix on homogeneous coordinates.)
    ///
    /// ```
    /// use pinhole::{camera::Window, prelude::*, space::View};
    /// let [zero, one, two] = [0, 1, 2].map(Scalar::from_int);
    /// // The right half of a picture, for the second of two displays.
    /// let right = Window { left: zero, right: one, bottom: -one, top: one };
    /// let lens = Projection::frustum(right, one, two)?;
    /// assert_eq!(lens.apply(Point3::<View>::from_ints(0, 0, -2)), Some(Point3::from_ints(-1, 0, 1)));
    /// assert_eq!(lens.apply(Point3::<View>::from_ints(1, 0, -1)), Some(Point3::from_ints(1, 0, -1)));
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::EmptyWindow`], [`NearNotPositive`](CameraError::NearNotPositive) and
    /// [`NearNotBeforeFar`](CameraError::NearNotBeforeFar).
    pub const fn frustum(window: Window, near: Scalar, far: Scalar) -> Result<Self, CameraError> {
        let Window { left, right, bottom, top } = window;
        let (Some(x), Some(y)) = (Self::shear(0, left, right, near), Self::shear(1, bottom, top, near))
        else {
            return Err(CameraError::EmptyWindow);
        };
        Self::by_distance(&x, &y, near, far)
    }

    /// The row x or y of a frustum: `(2n·x + (high + low)·z)/(high − low)`.
    const fn shear(axis: usize, low: Scalar, high: Scalar, near: Scalar) -> Option<Row> {
        let Some(extent) = extent(low, high) else { return None };
        // Both coefficients over one denominator: the numerators, 33 bits, are exact.
        let (focal, shear) = (2 * near.to_bits() as i64, high.to_bits() as i64 + low.to_bits() as i64);
        let ((focal, e), (shear, own)) = (ratio(focal, extent), ratio(shear, extent));
        // Both with the larger exponent; a zero has no exponent.
        let unit = if focal == 0 || (shear != 0 && own > e) { own } else { e };
        let (focal, shear) = (scale(focal, e - unit), scale(shear, own - unit));
        let linear = if axis == 0 { [focal, 0, shear] } else { [0, focal, shear] };
        Some(Row::new(&linear, unit, 0))
    }

    /// The rows d and w of a frustum: `d = (f·(−z) − f·n)/(f − n)`, `w = −z`.
    #[inline(never)] // set-up: code size counts
    const fn by_distance(x: &Row, y: &Row, near: Scalar, far: Scalar) -> Result<Self, CameraError> {
        if near.to_bits() <= 0 {
            return Err(CameraError::NearNotPositive);
        }
        let Some(depth) = extent(near, far) else { return Err(CameraError::NearNotBeforeFar) };
        let (n, f) = (near.to_bits() as i64, far.to_bits() as i64);
        let Some(at_eye) = offset(-n * f, depth << 16) else {
            return Err(CameraError::NearNotBeforeFar);
        };
        let d = row(2, ratio(-f, depth), at_eye);
        let w = row(2, (-1, 0), 0);
        Ok(Self { rows: [*x, *y, d, w] })
    }

    /// The orthographic projection of a box in view space: size does not change with distance. `near` and `far` are distances
    /// along −z in world units, and may be negative (behind the eye).
    ///
    /// ```text
    ///     | 2/(r−l)  0        0         −(r+l)/(r−l) |
    ///     | 0        2/(t−b)  0         −(t+b)/(t−b) |
    ///     | 0        0        −2/(f−n)  −(f+n)/(f−n) |
    ///     | 0        0        0         1            |
    /// ```
    ///
    /// Coefficients have a relative error of 2⁻³⁰, constants of 2⁻³⁰ plus 2⁻³³.
    ///
    /// (OpenGL 1.x, `glOrtho`.)
    ///
    /// ```
    /// use pinhole::{camera::Window, prelude::*, space::View};
    /// let [one, two, three] = [1, 2, 3].map(Scalar::from_int);
    /// let window = Window { left: -two, right: two, bottom: -one, top: one };
    /// let lens = Projection::orthographic(window, one, three)?;
    /// let ndc = |z| lens.apply(Point3::<View>::from_ints(1, 1, z));
    /// assert_eq!(ndc(-1), Point3::from_f32(0.5, 1.0, -1.0).ok()); // on the near plane
    /// assert_eq!(ndc(-3), Point3::from_f32(0.5, 1.0, 1.0).ok()); // on the far plane: no smaller
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::EmptyWindow`] and [`NearNotBeforeFar`](CameraError::NearNotBeforeFar).
    pub const fn orthographic(window: Window, near: Scalar, far: Scalar) -> Result<Self, CameraError> {
        let Window { left, right, bottom, top } = window;
        let (x, y) = match (Self::centred(0, left, right), Self::centred(1, bottom, top)) {
            (Ok(x), Ok(y)) => (x, y),
            (Err(error), _) | (_, Err(error)) => return Err(error),
        };
        let Some(depth) = extent(near, far) else { return Err(CameraError::NearNotBeforeFar) };
        let Some(at_eye) = offset(-(near.to_bits() as i64), depth) else {
            return Err(CameraError::NearNotBeforeFar);
        };
        let d = row(2, ratio(-1 << 16, depth), at_eye);
        let w = Row { offset: 1 << 32, ..Row::ZERO };
        Ok(Self { rows: [x, y, d, w] })
    }

    /// The row x or y of a box: `(2·x − (high + low))/(high − low)`.
    const fn centred(axis: usize, low: Scalar, high: Scalar) -> Result<Row, CameraError> {
        let Some(extent) = extent(low, high) else { return Err(CameraError::EmptyWindow) };
        let sum = low.to_bits() as i64 + high.to_bits() as i64;
        let Some(centre) = offset(-sum, extent) else { return Err(CameraError::EmptyWindow) };
        Ok(row(axis, ratio(2 << 16, extent), centre))
    }
}
