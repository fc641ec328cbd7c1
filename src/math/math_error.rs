//! Errors of numbers and transforms.

/// Why a number, a rotation or a transform cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MathError {
    /// A number is NaN or infinite: check the computation that produced it.
    NotFinite,
    /// A number is outside of the type's range, or a translation beyond ±2³⁰ world units: choose a larger unit, so that numbers get smaller.
    OutOfRange,
    /// The axis of a rotation has length zero, or all components of a quaternion are zero: give a direction, or (1, 0, 0, 0) for no
    /// rotation.
    ZeroLength,
    /// The last row of a matrix is not (0, 0, 0, 1): use [`Projection::from_matrix`](crate::Projection::from_matrix) for a
    /// projection.
    NotAffine,
    /// A transform that is to be inverted is singular: use no scale of zero, and no axis in the plane of the two others.
    Singular,
}

impl core::fmt::Display for MathError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite: check how it was computed",
            Self::OutOfRange => {
                "the number is out of range: choose a larger unit of length, or reduce the angle"
            }
            Self::ZeroLength => {
                "the axis or quaternion has length zero: give a direction, or (1, 0, 0, 0) for no rotation"
            }
            Self::NotAffine => {
                "the last row of the matrix is not 0 0 0 1: an affine transform holds no projection"
            }
            Self::Singular => {
                "the transform is singular: give no scale of zero, and axes that do not lie in a plane"
            }
        })
    }
}

impl core::error::Error for MathError {}
