//! Why a projection cannot be set up.

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
