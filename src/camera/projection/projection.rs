//! The map from view to clip space.

use crate::math::num::{divide, scale, shift_to_fit};
use crate::math::{homogeneous, Point3, Row};
use crate::space::{Ndc, View};

/// A projection: a projective map from view to clip space, four linear forms x, y, z, w.
///
/// Constructors: [`perspective`](Self::perspective), [`frustum`](Self::frustum),
/// [`orthographic`](Self::orthographic), [`oblique`](Self::oblique) (cavalier, cabinet),
/// [`perspective_from_reference`](Self::perspective_from_reference) (PRP and window), [`planar`](Self::planar),
/// [`from_matrix`](Self::from_matrix). The names of technical drawing depend on the view as well:
///
/// | name | view | projection |
/// |---|---|---|
/// | multiview (front, top, …), isometric, dimetric, trimetric | [`ViewTransform::from_reference`](crate::ViewTransform::from_reference) | orthographic |
/// | cavalier, cabinet | VPN along an axis | [`oblique`](Self::oblique), factor 1 and ½ |
/// | one-, two-, three-point | VPN with one, two, three components | any perspective |
///
/// Visible points have −w ≤ x, y, z ≤ w; the near plane is z = −w, the far plane z = +w. The matrix stores `d = (z + w)/2` in
/// place of z: d is 0 on the near plane and w on the far plane, so the near test is the sign of d, and d/w is the depth.
/// Coefficients have 30 bits; each constructor states their error or keeps vertices within the error budget of ARCHITECTURE.md,
/// "Numbers".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projection {
    /// x, y, d, w as linear forms of view coordinates.
    pub(super) rows: [Row; 4],
}

impl Projection {
    /// A view-space point in NDC: its clip coordinates x, y, z divided by w, each rounded to the nearest 2⁻¹⁶ (ties away from zero) and
    /// saturated. `None` if w ≤ 0: the point lies in the eye plane or behind it.
    ///
    /// Given the stored matrix, each of x, y, z, w is within 2⁻³⁰ of the largest of them plus 2⁻²⁹ units; if products exceed 2²⁹ and
    /// cancel, 2⁻⁵⁹ of them is added.
    ///
    /// ```
    /// use pinhole::{camera::Window, prelude::*};
    /// let one = Scalar::from_int(1);
    /// let window = Window { left: -one, right: one, bottom: -one, top: one };
    /// let frustum = Projection::frustum(window, one, Scalar::from_int(3))?;
    /// assert_eq!(frustum.apply(Point3::from_ints(0, 0, -3)), Some(Point3::from_ints(0, 0, 1)));
    /// assert_eq!(frustum.apply(Point3::from_ints(0, 0, 0)), None); // the eye
    /// # Ok::<(), pinhole::camera::CameraError>(())
    /// ```
    pub fn apply(&self, p: Point3<View>) -> Option<Point3<Ndc>> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let ([x, y, d, w], _) = homogeneous(&self.rows, &p);
        let xyzw = [x, y, 2 * d - w, w]; // each below 2⁶¹, so that z = 2d − w is below 2⁶³
        let largest = xyzw.iter().fold(0, |most, c| most.max(c.unsigned_abs()));
        let [x, y, z, w] = xyzw.map(|c| scale(c, -shift_to_fit(largest, 30)) as i32); // 30 bits, or 2³⁰
        if w <= 0 {
            return None;
        }
        let w = w.unsigned_abs();
        Some(Point3::from_bits([x, y, z].map(|c| {
            // (|c| < 2³¹) · 2¹⁶ + w/2 stays below 2⁴⁸.
            let n = (u64::from(c.unsigned_abs()) << 16) + u64::from(w / 2);
            let (q, _) = divide(n, w);
            let q = if c < 0 { -(q as i64) } else { q as i64 };
            q.clamp(i32::MIN.into(), i32::MAX.into()) as i32
        })))
    }

    pub(in crate::camera) const fn rows(&self) -> &[Row; 4] {
        &self.rows
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for Projection {
    fn format(&self, f: defmt::Formatter<'_>) {
        for row in &self.rows {
            let (linear, exponent, offset) = (row.linear, row.exponent, row.offset);
            defmt::write!(f, "[{} * 2^({=i32} - 30), {=i64}/2^32]", linear, exponent, offset);
        }
    }
}
