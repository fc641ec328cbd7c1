//! View to clip: the shape of the view volume.

mod matrix;
mod oblique;
mod parts;
mod planar;
mod reference;
mod volume;

pub(super) use parts::ratio as quotient;

pub use planar::PlanarProjection;
pub use reference::ReferenceVolume;

use crate::math::{homogeneous, ClipPoint, Point3, Row, Scalar};
use crate::space::View;

/// A rectangle of the near plane (perspective) or of any plane z = const (orthographic), in view
/// units: x from `left` to `right`, y from `bottom` to `top`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Smallest x.
    pub left: Scalar,
    /// Largest x.
    pub right: Scalar,
    /// Smallest y.
    pub bottom: Scalar,
    /// Largest y.
    pub top: Scalar,
}

#[cfg(feature = "defmt")]
impl defmt::Format for Window {
    fn format(&self, f: defmt::Formatter<'_>) {
        let [l, r, b, t] = [self.left, self.right, self.bottom, self.top].map(Scalar::to_bits);
        defmt::write!(f, "[{=i32}, {=i32}] x [{=i32}, {=i32}]/65536", l, r, b, t);
    }
}

/// A projective map from view to clip space: four linear forms x, y, z, w.
///
/// Constructors: [`perspective`](Self::perspective), [`frustum`](Self::frustum),
/// [`orthographic`](Self::orthographic), [`oblique`](Self::oblique) (cavalier, cabinet),
/// [`from_reference`](Self::from_reference) (PRP and window), [`from_planar`](Self::from_planar),
/// [`from_matrix`](Self::from_matrix). Their names in technical drawing depend on the view as well:
///
/// | name | view | projection |
/// |---|---|---|
/// | multiview (front, top, …) | [`ViewTransform::multiview`](crate::ViewTransform::multiview) | orthographic |
/// | isometric, dimetric, trimetric | [`ViewTransform::isometric`](crate::ViewTransform::isometric) and kin | orthographic |
/// | cavalier, cabinet | VPN along an axis | [`oblique`](Self::oblique), factor 1 and ½ |
/// | one-, two-, three-point | VPN with one, two, three components | any perspective |
///
/// Visible points have −w ≤ x, y, z ≤ w; the near plane is z = −w, the far plane z = +w. Instead
/// of z the rows hold `d = (z + w)/2`, which is 0 on the near plane and w on the far one: the
/// near test is a sign, and d/w is the depth. Coefficients have 30 bits; each constructor states
/// their error, or keeps vertices within the budget of ARCHITECTURE.md, "Numbers".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projection {
    /// x, y, d, w over view coordinates.
    rows: [Row; 4],
}

/// Why there is no such projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ProjectionError {
    /// The field of view is closer than 1/4096 turn to 0° or to 180°.
    FieldOfView,
    /// An aspect of zero width or height: pass the viewport's size, or a ratio such as 4 × 3.
    EmptyAspect,
    /// A perspective needs near > 0, or front before the centre of projection.
    NearNotPositive,
    /// Far must lie beyond near, back behind front.
    NearNotBeforeFar,
    /// near·far/(far − near) must stay below 2³⁰ for a perspective, near/(far − near) for a parallel projection
    /// and a [`ReferenceVolume`], for depth to mean anything: move them apart.
    NearTooCloseToFar,
    /// The window needs left < right and bottom < top.
    EmptyWindow,
    /// The window is 2³⁰ times smaller than its distance from the axis: enlarge or centre it.
    WindowTooSmall,
    /// The projectors run along the view plane, or the distance to it is zero.
    NoViewPlane,
    /// The projection reference point must lie in front of the view plane, at n > 0.
    ReferenceBehindPlane,
    /// A matrix with a number that is NaN or infinite, or with zeros only.
    Matrix,
    /// A constant of the projection leaves ±2³⁰: choose a larger unit, or a plane nearer to the origin.
    OutOfRange,
}

impl core::fmt::Display for ProjectionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::FieldOfView => "the field of view must lie between 1/4096 and 2047/4096 turn",
            Self::EmptyAspect => "the aspect needs a width and a height",
            Self::NearNotPositive => "a perspective needs a near plane in front of the eye",
            Self::NearNotBeforeFar => "the far plane must lie beyond the near plane",
            Self::NearTooCloseToFar => "near and far are too close together for depth",
            Self::EmptyWindow => "the window needs left < right and bottom < top",
            Self::WindowTooSmall => "the window is too small for its distance from the axis",
            Self::NoViewPlane => "the projectors never meet the view plane",
            Self::ReferenceBehindPlane => "the reference point must lie in front of the view plane",
            Self::Matrix => "the matrix is zero or has a number that is not finite",
            Self::OutOfRange => "the projection's numbers are out of range: choose a larger unit",
        })
    }
}

impl core::error::Error for ProjectionError {}

impl Projection {
    /// A view point in clip space, each of x, y, z, w within 2⁻³⁰ of the largest of them, and 2⁻²⁹ (in units of
    /// the matrix), of the matrix as it is. Where products pass 2²⁹ and cancel each other, 2⁻⁵⁹ of them comes on top.
    pub fn apply(&self, p: Point3<View>) -> ClipPoint {
        let p = p.bits().map(|c| i64::from(c) << 16);
        let ([x, y, d, w], shift) = homogeneous(&self.rows, &p);
        ClipPoint::new([x, y, 2 * d - w, w], shift - 32) // each below 2⁶¹, so that z = 2d − w is below 2⁶³
    }

    pub(super) const fn rows(&self) -> &[Row; 4] {
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
