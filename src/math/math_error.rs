//! Why a number, a rotation or a transform cannot be made.

/// Why a number, a rotation or a transform cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MathError {
    /// A number is NaN or infinite: check the computation that produced it.
    NotFinite,
    /// A number is outside of the type's range: choose a larger unit, so that numbers get smaller.
    OutOfRange,
    /// The text is not a decimal number, such as `-2.5`.
    Syntax,
    /// The axis of a rotation has length zero: give a direction.
    ZeroAxis,
    /// All four components of a quaternion are zero: the identity is (1, 0, 0, 0).
    ZeroQuaternion,
    /// The last row of a matrix is not (0, 0, 0, 1): use [`Projection::from_matrix`](crate::Projection::from_matrix) for a
    /// projection.
    NotAffine,
    /// The translation of a matrix is beyond ±2³⁰ world units: choose a larger unit.
    TranslationOutOfRange,
    /// A transform that is to be inverted is singular: use no scale of zero, and no axis in the plane of the two others.
    Singular,
    /// A transform that is to be inverted as a rigid one scales or shears: use [`Affine::inverse`](crate::Affine::inverse).
    NotRigid,
}

impl core::fmt::Display for MathError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite: check how it was computed",
            Self::OutOfRange => {
                "the number is out of range: choose a larger unit of length, or reduce the angle"
            }
            Self::Syntax => "the text is not a decimal number, such as -2.5",
            Self::ZeroAxis => "the axis of rotation has length zero: give a direction",
            Self::ZeroQuaternion => "the quaternion has length zero: the identity is (1, 0, 0, 0)",
            Self::NotAffine => {
                "the last row of the matrix is not 0 0 0 1: an affine transform holds no projection"
            }
            Self::TranslationOutOfRange => "the translation is beyond 2^30 world units: choose a larger unit",
            Self::Singular => "the transform is singular: a scale is zero, or its axes lie in a plane",
            Self::NotRigid => "the transform is not rigid: use `inverse`, which also inverts scale and shear",
        })
    }
}

impl core::error::Error for MathError {}
