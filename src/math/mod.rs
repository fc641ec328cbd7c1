//! Numbers, angles, points and affine transforms. Imports nothing else of the crate but the tags
//! of [`space`](crate::space).

mod affine;
mod angle;
mod clip_point;
mod determinant;
pub(crate) mod float;
mod form;
mod normal;
pub(crate) mod num;
mod point;
mod quaternion;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod row;
mod sphere;
pub(crate) mod unit;

pub(crate) use affine::{product, to_scalar};
pub use affine::{Affine, AxisError, InverseError, MatrixError};
pub use angle::Angle;
pub use clip_point::{ClipPoint, Outcode};
pub(crate) use determinant::determinant;
pub use form::Coordinate;
pub(crate) use form::{ClipCoords, Form};
pub(crate) use normal::to_short;
pub use normal::NormalMap;
pub use point::{Point3, Vector3};
pub use quaternion::{Quaternion, QuaternionError};
pub(crate) use row::{homogeneous, Row};
pub use sphere::Sphere;

/// The crate's public scalar: 16 integer and 16 fractional bits, ±32768 in steps of 2⁻¹⁶. It
/// has no `defmt::Format`, as `fixed` has none in this version: log its `to_bits`.
pub type Scalar = fixed::types::I16F16;

/// Why a floating-point number cannot enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NumberError {
    /// NaN or an infinity: look where the number was computed.
    NotFinite,
    /// Beyond the type's range: choose a larger unit, so that numbers get smaller.
    OutOfRange,
}

impl core::fmt::Display for NumberError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite",
            Self::OutOfRange => "the number is out of range: choose a larger unit",
        })
    }
}

impl core::error::Error for NumberError {}
