//! View volumes: frustums and boxes along −z.

use super::parts::{extent, offset, ratio, row};
use super::{Projection, ProjectionError, Window};
use crate::math::num::scale;
use crate::math::{Angle, Row, Scalar};
use embedded_graphics_core::geometry::Size;

impl Projection {
    /// A frustum by its vertical field of view, symmetric about the axis. `aspect` gives
    /// width : height as any pair, usually the viewport's size; `near` and `far` are distances.
    ///
    /// ```text
    ///     | cot(fov/2)·h/w  0           0             0           |
    ///     | 0               cot(fov/2)  0             0           |
    ///     | 0               0           −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0               0           −1            0           |
    /// ```
    ///
    /// cot(fov/2) is within 2⁻²⁷/sin(fov) of itself, (z + w)/2 within 2⁻³⁰ of itself.
    ///
    /// (*OpenGL Programming Guide*, appendix on homogeneous coordinates; Marschner and Shirley,
    /// *Fundamentals of Computer Graphics*, section on perspective projection.)
    ///
    /// ```
    /// use embedded_graphics::geometry::Size;
    /// use pinhole::{Angle, Projection, ProjectionError, Scalar};
    /// let (near, far) = (Scalar::from_num(1), Scalar::from_num(20));
    /// let _ = Projection::perspective(Angle::degrees(60), Size::new(240, 240), near, far)?;
    /// let flat = Projection::perspective(Angle::degrees(180), Size::new(240, 240), near, far);
    /// assert_eq!(flat, Err(ProjectionError::FieldOfView));
    /// # Ok::<(), ProjectionError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`ProjectionError::FieldOfView`], [`EmptyAspect`](ProjectionError::EmptyAspect),
    /// [`NearNotPositive`](ProjectionError::NearNotPositive),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn perspective(
        fov_y: Angle,
        aspect: Size,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, ProjectionError> {
        const LEAST: u32 = 1 << 20; // 1/4096 turn
        if !(LEAST..=(1 << 31) - LEAST).contains(&fov_y.bits()) {
            return Err(ProjectionError::FieldOfView);
        }
        if aspect.width == 0 || aspect.height == 0 {
            return Err(ProjectionError::EmptyAspect);
        }
        let (sine, cosine) = Angle::from_bits(fov_y.bits() / 2).sin_cos();
        // Half angles of 1/8192 … 2047/8192 turn: both positive, 30 bits; times 32-bit sides.
        let (sine, cosine) = (i64::from(sine), i64::from(cosine));
        let across =
            ratio(cosine * i64::from(aspect.height), (sine * i64::from(aspect.width)).unsigned_abs());
        let up = ratio(cosine, sine.unsigned_abs());
        Self::by_distance(row(0, across, 0), row(1, up, 0), near, far)
    }

    /// A frustum by the window that it cuts out of the near plane; it may lie off the axis.
    ///
    /// ```text
    ///     | 2n/(r−l)  0         (r+l)/(r−l)   0           |
    ///     | 0         2n/(t−b)  (t+b)/(t−b)   0           |
    ///     | 0         0         −(f+n)/(f−n)  −2fn/(f−n)  |
    ///     | 0         0         −1            0           |
    /// ```
    ///
    /// Coefficients of x and y are within 2⁻²⁹ of the row's largest, (z + w)/2 within 2⁻³⁰ of itself.
    ///
    /// (OpenGL 1.x, `glFrustum`; *OpenGL Programming Guide*, appendix on homogeneous coordinates.)
    ///
    /// # Errors
    ///
    /// [`ProjectionError::EmptyWindow`], [`NearNotPositive`](ProjectionError::NearNotPositive),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn frustum(window: Window, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        let form = |axis: usize, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(ProjectionError::EmptyWindow)?;
            let (low, high) = (i64::from(low.to_bits()), i64::from(high.to_bits()));
            // Both coefficients over one denominator: the numerators, 33 bits, are exact.
            let (numerator, shear) = (2 * i64::from(near.to_bits()), high + low);
            let (_, e) = ratio(numerator.abs().max(shear.abs()).max(1), extent);
            // Both in the larger one's unit.
            let small = |n: i64| {
                let (m, own) = ratio(n, extent);
                scale(m, own - e)
            };
            let mut linear = [0, 0, small(shear)];
            if let Some(focal) = linear.get_mut(axis) {
                *focal = small(numerator);
            }
            Ok(Row::new(linear, e, 0))
        };
        let x = form(0, window.left, window.right)?;
        let y = form(1, window.bottom, window.top)?;
        Self::by_distance(x, y, near, far)
    }

    /// The rows d and w of a frustum: `d = (f·(−z) − f·n)/(f − n)`, `w = −z`.
    fn by_distance(x: Row, y: Row, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        if near <= Scalar::ZERO {
            return Err(ProjectionError::NearNotPositive);
        }
        let depth = extent(near, far).ok_or(ProjectionError::NearNotBeforeFar)?;
        let (n, f) = (i64::from(near.to_bits()), i64::from(far.to_bits()));
        let at_eye = match offset(-n * f, depth << 16) {
            Some(value) => value,
            None => return Err(ProjectionError::NearTooCloseToFar),
        };
        let d = row(2, ratio(-f, depth), at_eye);
        let w = row(2, (-1, 0), 0);
        Ok(Self { rows: [x, y, d, w] })
    }

    /// A box in view space, seen along −z: no size change with distance. `near` and `far` are
    /// distances along −z and may be negative (behind the eye point).
    ///
    /// ```text
    ///     | 2/(r−l)  0        0         −(r+l)/(r−l) |
    ///     | 0        2/(t−b)  0         −(t+b)/(t−b) |
    ///     | 0        0        −2/(f−n)  −(f+n)/(f−n) |
    ///     | 0        0        0         1            |
    /// ```
    ///
    /// Coefficients are within 2⁻³⁰ of themselves, constants within 2⁻³⁰ of themselves and 2⁻³³.
    ///
    /// (OpenGL 1.x, `glOrtho`.)
    ///
    /// # Errors
    ///
    /// [`ProjectionError::EmptyWindow`], [`WindowTooSmall`](ProjectionError::WindowTooSmall),
    /// [`NearNotBeforeFar`](ProjectionError::NearNotBeforeFar) and
    /// [`NearTooCloseToFar`](ProjectionError::NearTooCloseToFar).
    pub fn orthographic(window: Window, near: Scalar, far: Scalar) -> Result<Self, ProjectionError> {
        let form = |axis: usize, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(ProjectionError::EmptyWindow)?;
            let sum = i64::from(low.to_bits()) + i64::from(high.to_bits());
            let centre = offset(-sum, extent).ok_or(ProjectionError::WindowTooSmall)?;
            Ok(row(axis, ratio(2 << 16, extent), centre))
        };
        let x = form(0, window.left, window.right)?;
        let y = form(1, window.bottom, window.top)?;
        let depth = extent(near, far).ok_or(ProjectionError::NearNotBeforeFar)?;
        let at_eye = offset(-i64::from(near.to_bits()), depth);
        let d = row(2, ratio(-1 << 16, depth), at_eye.ok_or(ProjectionError::NearTooCloseToFar)?);
        let w = Row { offset: 1 << 32, ..Row::ZERO };
        Ok(Self { rows: [x, y, d, w] })
    }
}
