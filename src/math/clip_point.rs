//! Points in homogeneous clip space.

use super::num::{divide, scale, shift_to_fit};
use super::Point3;
use crate::space::Ndc;

/// A homogeneous point (x, y, z, w) in clip space: four 30-bit integers with one exponent, each value `integer · 2^exponent`.
/// [`Projection::apply`](crate::Projection::apply) makes it; there is no public constructor.
///
/// ```
/// use pinhole::{camera::Window, prelude::*, space::View};
/// let one = Scalar::from_int(1);
/// let window = Window { left: -one, right: one, bottom: -one, top: one };
/// let frustum = Projection::frustum(window, one, Scalar::from_int(3))?;
/// let clip = frustum.apply(Point3::<View>::from_ints(0, 0, -3));
/// assert_eq!(clip.ndc(), Some(Point3::from_ints(0, 0, 1)));
/// # Ok::<(), pinhole::camera::CameraError>(())
/// ```
///
/// ```compile_fail,E0451
/// let forged = pinhole::clip::ClipPoint { x: 0, y: 0, z: 0, w: 1, exponent: 0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClipPoint {
    x: i32,
    y: i32,
    z: i32,
    w: i32,
    exponent: i32,
}

impl ClipPoint {
    /// From x, y, z, w in units of 2^exponent.
    pub(crate) fn new(xyzw: [i64; 4], exponent: i32) -> Self {
        let largest = xyzw.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        let shift = shift_to_fit(largest, 30);
        let [x, y, z, w] = xyzw.map(|c| scale(c, -shift) as i32); // 30 bits, or 2³⁰
        Self { x, y, z, w, exponent: shift + exponent }
    }

    /// x, y, z, w in units of 2^[`exponent`](Self::exponent): 30 bits each, the largest of them in use.
    pub const fn xyzw(&self) -> [i32; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// The exponent that the four numbers share.
    pub const fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The perspective divide (x/w, y/w, z/w), rounded to the nearest 2⁻¹⁶ (ties away from zero) and saturated. `None` if w ≤
    /// 0: the point lies in the eye plane or behind it.
    pub fn ndc(&self) -> Option<Point3<Ndc>> {
        if self.w <= 0 {
            return None;
        }
        let w = self.w.unsigned_abs();
        Some(Point3::from_bits([self.x, self.y, self.z].map(|c| {
            // (|c| < 2³¹) · 2¹⁶ + w/2 stays below 2⁴⁸.
            let n = (u64::from(c.unsigned_abs()) << 16) + u64::from(w / 2);
            let (q, _) = divide(n, w);
            let q = if c < 0 { -(q as i64) } else { q as i64 };
            q.clamp(i32::MIN.into(), i32::MAX.into()) as i32
        })))
    }

    /// The planes of the view volume that the point lies outside of.
    pub const fn outcode(&self) -> Outcode {
        let Self { x, y, z, w, .. } = *self;
        // 30 bits: negation and comparison are exact.
        Outcode(
            (x < -w) as u8
                | ((x > w) as u8) << 1
                | ((y < -w) as u8) << 2
                | ((y > w) as u8) << 3
                | ((z < -w) as u8) << 4
                | ((z > w) as u8) << 5,
        )
    }

    /// x, y, z, w in units of 2^`exponent`, rounded to nearest; `exponent` must not be below the point's own.
    pub(crate) fn in_units(&self, exponent: i32) -> [i32; 4] {
        self.xyzw().map(|c| scale(c.into(), self.exponent - exponent) as i32)
    }

    pub(crate) const fn from_units([x, y, z, w]: [i32; 4], exponent: i32) -> Self {
        Self { x, y, z, w, exponent }
    }
}

/// The planes of the view volume that a point lies outside of, one bit each. A line or face
/// is inside if no end has a bit set, and outside if all ends share a set bit.
/// (Cohen and Sutherland; Newman and Sproull, *Principles of Interactive Computer Graphics*, 2nd
/// ed., section 5.1.)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outcode(u8);

impl Outcode {
    /// Inside all planes.
    pub const INSIDE: Self = Self(0);
    /// x < −w.
    pub const LEFT: Self = Self(1);
    /// x > w.
    pub const RIGHT: Self = Self(2);
    /// y < −w.
    pub const BELOW: Self = Self(4);
    /// y > w.
    pub const ABOVE: Self = Self(8);
    /// z < −w.
    pub const NEAR: Self = Self(16);
    /// z > w.
    pub const FAR: Self = Self(32);

    /// One bit for each plane that the point lies outside of: 1 for [`LEFT`](Self::LEFT) to 32 for [`FAR`](Self::FAR).
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The planes that both points lie outside of. If there is one, the line between the points is invisible.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The planes that either point lies outside of. If there is none, all of the line between the points is
    /// visible.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}
