//! Planar geometric projections: onto any plane z = const, from any centre or along any direction.

use super::parts::{extent, ratio, row, ONE};
use super::{Projection, Window};
use crate::camera::CameraError;
use crate::math::num::{scale, shift_to_fit, sqrt, SATURATED};
use crate::math::{Row, Scalar, Vector3};
use crate::space::View;

const X: Row = Row { linear: [1 << 30, 0, 0], ..Row::ZERO };
const Y: Row = Row { linear: [0, 1 << 30, 0], ..Row::ZERO };
/// w = 1.
const UNIT: Row = Row { offset: 1 << 32, ..Row::ZERO };

impl Projection {
    /// The projection onto the plane z = z_p from a centre at `distance` from (0, 0, z_p) in `direction` (of any length; (dx, dy, dz) is
    /// its unit vector, Q the distance), seen through a `window` of the plane:
    ///
    /// ```text
    ///     | 1  0  −dx/dz         z_p·dx/dz           |
    ///     | 0  1  −dy/dz         z_p·dy/dz           |
    ///     | 0  0  −1/(Q·dz)      1 + z_p/(Q·dz)      |   w
    /// ```
    ///
    /// A negative `distance` puts the centre on the other side of the plane. `None` is an infinite distance: a parallel projection along
    /// `direction`, orthographic or oblique. The plane contains the origin for z_p = 0. The centre is the origin for `(d, Some(d), −z)`.
    ///
    /// Rounded coefficients move the image of a point by at most 2⁻²⁸/(w·dz) of the largest coordinate of point, plane and image.
    ///
    /// Depth is linear on the screen, between the planes z = −near and z = −far (distances along −z in world units, near < far):
    /// `d = (w at far)/(far − near) · (−z − near)`. The camera looks along −z. If the centre of projection lies at smaller z than the
    /// volume, the far plane is the one closer to it and the picture is mirrored, as the matrix says. (Carlbom and Paciorek, *Planar
    /// geometric projections and viewing transformations*, 1978; Foley et al., *Computer Graphics*, 2nd ed., section 6.4, equation 6.17.)
    ///
    /// ```
    /// use pinhole::{camera::Window, prelude::*};
    /// let [one, two] = [1, 2].map(Scalar::from_int);
    /// let window = Window { left: -two, right: two, bottom: -two, top: two };
    /// // Parallel, along (0, -1, 1): shapes parallel to the plane z = 0 are preserved.
    /// let lens = Projection::planar(Scalar::ZERO, None, Vector3::from_ints(0, -1, 1), window, -one, two)?;
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CameraError::NoViewPlane`] if the direction is parallel to the plane or the distance is zero,
    /// [`EmptyWindow`](CameraError::EmptyWindow), [`NearNotBeforeFar`](CameraError::NearNotBeforeFar),
    /// [`NearNotPositive`](CameraError::NearNotPositive) where near or far lies behind the centre of projection, and
    /// [`OutOfRange`](CameraError::OutOfRange) where a constant of the matrix or w at the far plane passes 2³⁰.
    pub fn planar(
        z_p: Scalar,
        distance: Option<Scalar>,
        direction: Vector3<View>,
        window: Window,
        near: Scalar,
        far: Scalar,
    ) -> Result<Self, CameraError> {
        let [dx, dy, dz] = direction.bits().map(i64::from);
        if dz == 0 || distance == Some(Scalar::ZERO) {
            return Err(CameraError::NoViewPlane);
        }
        // In 2⁻³².
        let z_p = i64::from(z_p.to_bits()) << 16;
        // plus + slope·(z − z_p).
        let slanted =
            |plus: Row, slope: (i64, i32)| plus.linear_combination(ONE, &row(2, (1, 0), -z_p), slope);
        let over_dz =
            |n: i64| if dz < 0 { ratio(n, dz.unsigned_abs()) } else { ratio(-n, dz.unsigned_abs()) };
        let x = slanted(X, over_dz(dx));
        let y = slanted(Y, over_dz(dy));
        let w = match distance {
            None => UNIT,
            Some(distance) => {
                // 1/(Q·dz) = |direction|/(Q·its z), which keeps its bits where the direction lies near
                // the plane: all parts brought to 31 bits at least.
                let largest = dx.unsigned_abs().max(dy.unsigned_abs()).max(dz.unsigned_abs());
                let up = (-shift_to_fit(largest, 31)).max(0); // 2³¹ itself stays, and with it the others' last bit
                let square = [dx, dy, dz].map(|c| scale(c, up).unsigned_abs().pow(2)).iter().sum(); // ≤ 3·2⁶²
                let length = i64::from(sqrt(square)); // 2³⁰ … 2³¹·⁸
                let product = i64::from(distance.to_bits()) * scale(dz, up); // 2³¹ · 2³¹
                if product == 0 {
                    return Err(CameraError::NoViewPlane);
                }
                let (m, e) = ratio(length << 16, product.unsigned_abs());
                let slope = (if product < 0 { m } else { -m }, e);
                // w = −(z − z_c)/(Q·dz), from the z of the centre, z_p + Q·dz: 1 and z_p/(Q·dz) would cancel for a centre at the
                // origin. Along z, Q·dz is the distance itself, of one bit more than a ratio has.
                let rise = if (dx, dy) == (0, 0) {
                    (i64::from(distance.to_bits()) << 16) * dz.signum()
                } else {
                    let (m, e) = ratio(product, length as u64);
                    scale(m, e + 16)
                };
                row(2, (1, 0), -(z_p + rise)).times(slope) // both within 2⁴⁷
            }
        };
        if [x, y, w].iter().any(|row| row.offset.abs() >= SATURATED) {
            return Err(CameraError::OutOfRange);
        }
        let form = |image: &Row, low: Scalar, high: Scalar| {
            let extent = extent(low, high).ok_or(CameraError::EmptyWindow)?;
            let sum = i64::from(low.to_bits()) + i64::from(high.to_bits());
            let (a, b) = (ratio(2 << 16, extent), ratio(-sum, extent));
            let row = image.linear_combination(a, &w, b);
            // Each term is tested, not only the sum: a saturated term may cancel with the other one.
            if [row, image.times(a), w.times(b)].iter().any(|row| row.offset.abs() >= SATURATED) {
                return Err(CameraError::EmptyWindow);
            }
            Ok(row)
        };
        let x = form(&x, window.left, window.right)?;
        let y = form(&y, window.bottom, window.top)?;
        let depth = extent(near, far).ok_or(CameraError::NearNotBeforeFar)?;
        let w_at = |distance: Scalar| w.apply(&[0, 0, -(i64::from(distance.to_bits()) << 16)]);
        if w_at(near) <= 0 || w_at(far) <= 0 {
            return Err(CameraError::NearNotPositive);
        }
        if w_at(far) >= SATURATED {
            return Err(CameraError::OutOfRange);
        }
        // κ = w(far)/(far − near): 2⁻³² over 2⁻¹⁶.
        let (m, e) = ratio(w_at(far), depth);
        let near = Row { offset: -(i64::from(near.to_bits()) << 16), ..row(2, (-1, 0), 0) };
        let d = near.times((m, e - 16));
        if d.offset.abs() >= SATURATED {
            return Err(CameraError::NearNotBeforeFar);
        }
        Ok(Self { rows: [x, y, d, w] })
    }
}
