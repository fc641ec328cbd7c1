//! The map from view to clip space.

use crate::math::{homogeneous, ClipPoint, Point3, Row};
use crate::space::View;

/// A projection: a projective map from view to clip space, four linear forms x, y, z, w.
///
/// Constructors: [`perspective`](Self::perspective), [`frustum`](Self::frustum),
/// [`orthographic`](Self::orthographic), [`oblique`](Self::oblique) (cavalier, cabinet),
/// [`from_reference`](Self::from_reference) (PRP and window), [`from_planar`](Self::from_planar),
/// [`from_matrix`](Self::from_matrix). The names of technical drawing depend on the view as well:
///
/// | name | view | projection |
/// |---|---|---|
/// | multiview (front, top, …) | [`ViewTransform::multiview`](crate::ViewTransform::multiview) | orthographic |
/// | isometric, dimetric, trimetric | [`ViewTransform::isometric`](crate::ViewTransform::isometric) and the two others | orthographic |
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
    /// The clip coordinates of a view-space point. Given the stored matrix, each of x, y, z, w is within 2⁻³⁰ of the largest of
    /// them plus 2⁻²⁹ units; if products exceed 2²⁹ and cancel, 2⁻⁵⁹ of them is added.
    pub fn apply(&self, p: Point3<View>) -> ClipPoint {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let ([x, y, d, w], shift) = homogeneous(&self.rows, &p);
        ClipPoint::new([x, y, 2 * d - w, w], shift - 32) // each below 2⁶¹, so that z = 2d − w is below 2⁶³
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
