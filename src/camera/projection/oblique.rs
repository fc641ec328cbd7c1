//! Oblique parallel projections: faces parallel to the view plane keep their shape, the z axis recedes at an angle.

use super::parts::{extent, ratio, row, ONE};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::{Angle, Row, Scalar};

impl Projection {
    /// An oblique projection onto the plane z = 0: a unit along −z appears as `factor` units in the direction `angle`, measured
    /// from the x axis towards y:
    ///
    /// ```text
    ///     x_p = x − factor·cos(angle)·z,   y_p = y − factor·sin(angle)·z
    /// ```
    ///
    /// A factor of 1 is the **cavalier** projection, ½ the **cabinet** projection, 0 the orthographic one. Usual angles are 30°
    /// and 45°. The coefficients of the rows x and y have an error of at most 2⁻²⁹·(1 + |factor|) times the row's largest
    /// coefficient. The window lies in the plane z = 0; near and far are distances along −z and may be negative. (Foley et al.,
    /// *Computer Graphics*, 2nd ed., section 6.1.2.)
    ///
    /// ```
    /// use pinhole::{camera::Window, Angle, Projection, Scalar};
    /// let two = Scalar::from_int(2);
    /// let window = Window { left: -two, right: two, bottom: -two, top: two };
    /// let half = Scalar::from_ratio(1, 2);
    /// let cabinet = Projection::oblique(window, -two, two, Angle::degrees(45), half)?;
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::EmptyWindow`] and [`NearNotBeforeFar`](CameraError::NearNotBeforeFar).
    pub fn oblique(
        window: Window,
        near: Scalar,
        far: Scalar,
        angle: Angle,
        factor: Scalar,
    ) -> Result<Self, CameraError> {
        let straight = Self::orthographic(window, near, far)?;
        let (sine, cosine) = angle.sin_cos();
        let [x, y, d, w] = straight.rows;
        let slanted = |straight: Row, part: i32, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(CameraError::EmptyWindow)?;
            // The slope −2·factor·part/extent: factor (32 bits) and extent (33 bits) in 2⁻¹⁶, part (31 bits) in 2⁻³⁰.
            let (m, e) = ratio(-i64::from(factor.to_bits()) * i64::from(part), extent);
            let slope = row(2, (m, e - 29), 0);
            Ok(straight.linear_combination(ONE, &slope, ONE))
        };
        let x = slanted(x, cosine, window.left, window.right)?;
        let y = slanted(y, sine, window.bottom, window.top)?;
        Ok(Self { rows: [x, y, d, w] })
    }
}
