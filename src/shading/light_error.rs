//! Why a light or fog cannot be set up.

use crate::math::Scalar;

/// The fewest steps of depth between the distances where fog begins and where it is full.
pub(super) const LEAST_FOG_STEPS: u16 = 8;

/// Why a light or fog cannot be set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LightError {
    /// The direction towards the light has length zero: give a vector of any other length.
    ZeroDirection,
    /// The model transform of a [`RigidLambert`](crate::light::RigidLambert) stretches or shears: use a [`Lambert`](crate::light::Lambert).
    NotRigid,
    /// Fog would be full before it begins: `start` must be less than `end`.
    EmptyFog {
        /// The distance at which fog was to begin.
        start: Scalar,
        /// The distance at which it was to be full.
        end: Scalar,
    },
    /// The projection's depth does not depend on the distance alone, which matrices can cause: use a
    /// [`VertexFog`](crate::fog::VertexFog), or a projection from another constructor.
    SlantedDepth,
    /// Too few steps of depth lie between the distances where the fog begins and where it is full: a
    /// [`FogTable`](crate::fog::FogTable) needs 8. Move the near plane away from
    /// the eye, or the fog's start and end apart.
    TooFewFogSteps {
        /// The steps of depth in the fog, rounded down.
        steps: u16,
    },
}

impl core::fmt::Display for LightError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::ZeroDirection => f.write_str(
                "the direction towards the light has length zero: give a vector that points to the light",
            ),
            Self::NotRigid => f.write_str(
                "the model transform stretches or shears, which RigidLambert does not support: use Lambert",
            ),
            Self::EmptyFog { start, end } => write!(
                f,
                "fog must begin before it is full: its start, {start}, is not less than its end, {end}"
            ),
            Self::SlantedDepth => f.write_str(
                "this projection's depth does not depend on the distance alone: use VertexFog, or another projection",
            ),
            Self::TooFewFogSteps { steps } => write!(
                f,
                "the fog spans {steps} of 65535 steps of depth, but needs {LEAST_FOG_STEPS}: move the near plane away from the eye, or the fog's start and end apart",
            ),
        }
    }
}

impl core::error::Error for LightError {}
