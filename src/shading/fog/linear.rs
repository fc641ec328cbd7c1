//! Where fog begins, and where it is full.

use crate::math::Scalar;

/// What [`FogTable::LEAST_STEPS`](crate::FogTable::LEAST_STEPS) documents.
pub(super) const LEAST_STEPS: u16 = 8;

/// Fog that begins at one distance from the camera, is full at another, and grows linearly in between. Its *factor* is the part of
/// a colour that is still seen: all of it at `start` and nearer, none at `end` and beyond. (OpenGL 2.1 specification, section
/// 3.10, `GL_LINEAR`; Akenine-Möller et al., *Real-Time Rendering*, 4th ed., section 14.4.)
///
/// **Distance** is that along the camera's axis, −n in view coordinates, in world units: fog does not change as the camera turns about its eye's
/// axis, and all points of a plane parallel to the view plane are equally foggy.
///
/// | fog | type | instructions a pixel | draws |
/// |---|---|---|---|
/// | by face or by vertex | [`VertexFog`](crate::VertexFog) | none | whatever takes levels of light, and one colour a face |
/// | by pixel | [`FogTable`](crate::FogTable), [`Fogged`](crate::Fogged) | those of a mix of two colours, and a division wherever the level changes along a row | every shader |
///
/// ```
/// use pinhole::{Fog, FogError, Scalar};
/// let [near, far] = [4, 20].map(Scalar::from_num);
/// let fog = Fog::linear(near, far)?;
/// assert_eq!([fog.start(), fog.end()], [near, far]);
/// let error = Fog::linear(far, near).unwrap_err();
/// assert_eq!(error.to_string(), "fog must begin before it is full: its start, 20, is not less than its end, 4");
/// # Ok::<(), FogError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fog {
    start: Scalar,
    end: Scalar,
}

/// Why fog cannot be set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FogError {
    /// Fog would be full before it begins: `start` must be less than `end`.
    EmptyRange {
        /// The distance at which fog was to begin.
        start: Scalar,
        /// The distance at which it was to be full.
        end: Scalar,
    },
    /// The projection's depth does not depend on the distance alone, as that of some matrices: use a
    /// [`VertexFog`](crate::VertexFog), or a projection from another constructor.
    SlantedDepth,
    /// Depth hardly changes from where the fog begins to where it is full: by fewer steps than a [`FogTable`](crate::FogTable)
    /// needs, which are [`FogTable::LEAST_STEPS`](crate::FogTable::LEAST_STEPS). Move the near plane away from the eye, or the ends of the fog apart.
    TooFewSteps {
        /// The steps of depth in the fog, rounded down.
        steps: u16,
    },
}

impl core::fmt::Display for FogError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::EmptyRange { start, end } => write!(
                f,
                "fog must begin before it is full: its start, {start}, is not less than its end, {end}"
            ),
            Self::SlantedDepth => f.write_str(
                "this projection's depth is not that of a distance alone: use VertexFog, or another projection",
            ),
            Self::TooFewSteps { steps } => write!(
                f,
                "the fog lies within {steps} of 65535 steps of depth, and takes {}: move the near plane away from the eye, or the fog's start and end apart",
                LEAST_STEPS
            ),
        }
    }
}

impl core::error::Error for FogError {}

impl Fog {
    /// Fog between these distances, in world units. They may lie outside of the camera's near and far plane, and `start` may be
    /// negative: points there are behind the camera.
    ///
    /// # Errors
    ///
    /// [`FogError::EmptyRange`] if `start` is not less than `end`.
    pub const fn linear(start: Scalar, end: Scalar) -> Result<Self, FogError> {
        match start.to_bits() < end.to_bits() {
            true => Ok(Self { start, end }),
            false => Err(FogError::EmptyRange { start, end }),
        }
    }

    /// The distance at which fog begins, in world units.
    pub const fn start(&self) -> Scalar {
        self.start
    }

    /// The distance at which fog is full, in world units.
    pub const fn end(&self) -> Scalar {
        self.end
    }

    /// Both distances in 2⁻¹⁶ world units.
    pub(super) const fn range(&self) -> [i32; 2] {
        [self.start.to_bits(), self.end.to_bits()]
    }
}

// `Scalar` has no `Format`.
#[cfg(feature = "defmt")]
impl defmt::Format for Fog {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "fog from {=i32}/2^16 to {=i32}/2^16", self.start.to_bits(), self.end.to_bits());
    }
}

#[cfg(feature = "defmt")]
impl defmt::Format for FogError {
    fn format(&self, f: defmt::Formatter<'_>) {
        match self {
            Self::EmptyRange { start, end } => {
                defmt::write!(f, "EmptyRange {=i32}/2^16 to {=i32}/2^16", start.to_bits(), end.to_bits());
            }
            Self::SlantedDepth => defmt::write!(f, "SlantedDepth"),
            Self::TooFewSteps { steps } => defmt::write!(f, "TooFewSteps {=u16}", steps),
        }
    }
}
