//! Why a projection cannot be set up.

/// Why a projection cannot be set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ProjectionError {
    /// The field of view is not 1/4096 to 2047/4096 turn, about 0.09° to 179.9°.
    FieldOfView,
    /// The aspect ratio has a width or height of zero: pass the viewport's size, or a ratio such as 4 × 3.
    EmptyAspect,
    /// The near plane of a perspective is not in front of the centre of projection. `near` must be > 0; the front plane of a
    /// reference volume must lie on the view plane's side of the projection reference point.
    NearNotPositive,
    /// The far plane is not beyond the near plane, or the back plane not behind the front plane.
    NearNotBeforeFar,
    /// Near and far are too close for depth: near·far/(far − near) must be below 2³⁰ for a perspective, near/(far − near) for a
    /// parallel projection and a [`ReferenceVolume`](crate::ReferenceVolume). Move the planes apart.
    NearTooCloseToFar,
    /// The window is empty: it needs left < right and bottom < top.
    EmptyWindow,
    /// The window's distance from the axis is 2³⁰ times its extent: enlarge or centre it.
    WindowTooSmall,
    /// The projectors are parallel to the view plane, or the centre of projection lies in it.
    NoViewPlane,
    /// The projection reference point is not in front of the view plane, at n > 0.
    ReferenceBehindPlane,
    /// A row of the matrix has a number that is NaN, infinite or more than 2³² times the largest of the other rows, or is the last
    /// one and has only zeros.
    Matrix {
        /// The row's name: x, y, z or w.
        row: char,
    },
    /// A constant of the matrix is beyond ±2³⁰: choose a larger unit, or a view plane nearer to the origin.
    OutOfRange,
}

impl core::fmt::Display for ProjectionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Matrix { row } => {
                return write!(
                    f,
                    "row {row} of the matrix: its numbers must be finite and at most 2^32 times those of the other rows, and those of row w not all 0"
                );
            }
            Self::FieldOfView => "field of view must be 0.09° to 179.9°",
            Self::EmptyAspect => "the aspect ratio has a width or height of zero: pass the viewport's size",
            Self::NearNotPositive => "the near plane of a perspective must be in front of the eye, at a distance greater than 0",
            Self::NearNotBeforeFar => "the far plane must lie beyond the near plane",
            Self::NearTooCloseToFar => "near and far planes are too close together for depth: move them apart",
            Self::EmptyWindow => "the window is empty: it needs left < right and bottom < top",
            Self::WindowTooSmall => "the window is too small for its distance from the axis: enlarge or centre it",
            Self::NoViewPlane => "the projectors are parallel to the view plane, or start in it: change the direction or the distance",
            Self::ReferenceBehindPlane => "the projection reference point must be in front of the view plane, at n > 0",
            Self::OutOfRange => "a constant of the projection is beyond 2^30: choose a larger unit, or a plane nearer to the origin",
        })
    }
}

impl core::error::Error for ProjectionError {}
