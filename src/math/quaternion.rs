//! Unit quaternions, as orientation filters deliver them.

use super::num::{scale, shift_to_fit, sqrt};
use super::unit::unit_component;
use super::Scalar;
use crate::math::MathError;

/// A rotation as a unit quaternion `w + x·i + y·j + z·k`, whose components are stored in 2⁻³⁰.
///
/// ```
/// use pinhole::{math::{MathError, Quaternion}, prelude::*, Angle};
/// let one = Scalar::from_int(1);
/// let quarter = Quaternion::new(one, Scalar::ZERO, Scalar::ZERO, one)?; // 90° about z, any length
/// let turn = Affine::<Model, World>::from_quaternion(quarter);
/// let p = pinhole::Point3::from_ints(1, 0, 0);
/// assert_eq!(turn.apply(p), Affine::<Model, World>::rotation_z(Angle::QUARTER_TURN).apply(p));
/// # Ok::<(), MathError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Quaternion([i32; 4]);

impl Quaternion {
    /// From four components of any length but zero. They are normalised; each is within 2.5·2⁻³⁰.
    ///
    /// # Errors
    ///
    /// [`MathError::ZeroQuaternion`] if all components are zero.
    pub fn new(w: Scalar, x: Scalar, y: Scalar, z: Scalar) -> Result<Self, MathError> {
        Self::normalised([w, x, y, z].map(|c| i64::from(c.to_bits())))
    }

    fn normalised(parts: [i64; 4]) -> Result<Self, MathError> {
        let largest = parts.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        if largest == 0 {
            return Err(MathError::ZeroQuaternion);
        }
        // To 30 bits, so that four squares stay below 2⁶³.
        let parts = parts.map(|c| scale(c, -shift_to_fit(largest, 30)));
        let square = parts.iter().map(|c| c.unsigned_abs().pow(2)).sum();
        let length = sqrt(square); // 2²⁹ … 2³¹
        Ok(Self(parts.map(|c| unit_component(c as i32, length)))) // 30 bits, or 2³⁰
    }

    /// w, x, y, z in 2⁻³⁰.
    pub(crate) const fn components(self) -> [i32; 4] {
        self.0
    }
}

/// From a quaternion of `micromath`. Components are truncated to 2⁻³²; at lengths from 2⁻⁸ to 2¹⁵ the largest one keeps all its
/// 24 bits.
///
/// # Errors
///
/// [`MathError::ZeroQuaternion`] if all components are below 2⁻³², [`NotFinite`](MathError::NotFinite) or
/// [`OutOfRange`](MathError::OutOfRange) if one is NaN, infinite or beyond
/// ±32768.
impl TryFrom<micromath::Quaternion> for Quaternion {
    type Error = MathError;

    fn try_from(q: micromath::Quaternion) -> Result<Self, MathError> {
        let [w, x, y, z] = [q.w(), q.x(), q.y(), q.z()].map(|c| {
            if !c.is_finite() {
                Err(MathError::NotFinite)
            } else if !(-32_768.0..=32_768.0).contains(&c) {
                Err(MathError::OutOfRange)
            } else {
                // Exact: a float times a power of two; truncated below 2⁻³².
                Ok((f64::from(c) * 4_294_967_296.0) as i64)
            }
        });
        Self::normalised([w?, x?, y?, z?])
    }
}
