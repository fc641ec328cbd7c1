//! Errors of cameras.

/// Why a view, a projection or a viewport cannot be set up, or a point has no position on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum CameraError {
    /// The field of view is not 1/4096 to 2047/4096 turn, about 0.09° to 179.9°.
    FieldOfView,
    /// The near plane of a perspective is not in front of the centre of projection. `near` must be > 0; the front plane of a
    /// reference volume must lie on the view plane's side of the projection reference point.
    NearNotPositive,
    /// The far plane is not beyond the near plane, or the back plane not behind the front plane, or they are too close for depth:
    /// near·far/(far − near) must be below 2³⁰ for a perspective, near/(far − near) for a parallel projection and one by a reference
    /// point. Move the planes apart.
    NearNotBeforeFar,
    /// The window is empty, or its distance from the axis is 2³⁰ times its extent: it needs left < right and bottom < top. Enlarge or
    /// centre it.
    EmptyWindow,
    /// The projectors are parallel to the view plane, or the centre of projection lies in it, or a projection reference point is not in
    /// front of it: it needs n > 0.
    NoViewPlane,
    /// A row of a projection matrix has a number that is NaN, infinite or more than 2³² times the largest of the other rows, or is
    /// the last one and has only zeros.
    Matrix {
        /// The row's name: x, y, z or w.
        row: char,
    },
    /// A constant of a projection is beyond ±2³⁰, an eye outside of ±32768 world units, or the far side of the sphere to be framed more
    /// than 32768 world units from the eye: choose a larger unit, a view plane nearer to the origin, or a wider field of view.
    OutOfRange,
    /// The sphere to be framed has a radius of zero or less: the mesh has no vertices, or only one.
    NoRadius,
    /// The near side of the sphere to be framed would lie less than 2⁻¹⁰ world units from the eye, where near and far planes have no
    /// room between: choose a smaller unit or a narrower field of view.
    TooNear,
    /// The viewing matrix is not a rotation followed by a translation.
    NotRigid,
    /// A row of the viewing matrix has a number that is NaN or infinite: check the computation that produced it.
    NotFinite {
        /// The row's name: x, y, z or w (the last row).
        row: char,
    },
    /// The view plane normal (VPN) or the gaze has length zero: give a direction, or a target that differs from the eye. Or the view up
    /// vector (VUP) has length zero, or is parallel to the gaze to within 2⁻¹² rad, so the roll is undefined: give another, such as
    /// (0, 1, 0).
    Direction,
    /// The width or height of a viewport or of an aspect ratio is zero, or a viewport extends beyond ±8192 pixels from the target's origin.
    Viewport,
    /// The point lies between the near plane and the eye, or behind the eye.
    BeforeNear,
    /// The point lies beyond the far plane, and the camera [clips there](crate::Camera::with_far_clip).
    BeyondFar,
    /// The point lies more than 8192 pixels from the target's origin.
    OutsideGuardBand,
    /// The mesh has no vertex with this index.
    NoVertex,
}

impl core::fmt::Display for CameraError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Matrix { row } => {
                return write!(
                    f,
                    "row {row} of the matrix: its numbers must be finite and at most 2^32 times those of the other rows, and those of row w not all 0"
                );
            }
            Self::NotFinite { row } => {
                return write!(
                    f,
                    "row {row} of the viewing matrix: {}", crate::math::MathError::NotFinite
                );
            }
            Self::FieldOfView => "field of view must be 0.09° to 179.9°",
            Self::NearNotPositive => "the near plane of a perspective must be in front of the eye, at a distance greater than 0",
            Self::NearNotBeforeFar => "the far plane must lie beyond the near plane, and not too close to it for depth: move them apart",
            Self::EmptyWindow => "the window is empty, or too small for its distance from the axis: it needs left < right and bottom < top; enlarge or centre it",
            Self::NoViewPlane => "the projectors are parallel to the view plane, or start in it: change the direction or the distance; a projection reference point must be in front of it, at n > 0",
            Self::OutOfRange => "the eye or the object lies beyond 32768 world units, or a constant beyond 2^30: choose a larger unit, a wider field of view, or a plane nearer to the origin",
            Self::NoRadius => "the sphere has no radius: the mesh needs at least two different vertices",
            Self::TooNear => {
                "the object would touch the eye: choose a smaller unit, or a narrower field of view"
            }
            Self::NotRigid => "the viewing matrix is not rigid: it needs three orthonormal, right-handed rows and the last row 0 0 0 1",
            Self::Direction => "the viewing direction or the up vector has length zero, or they are parallel: give another vector, or a target that differs from the eye",
            Self::Viewport => "a viewport or an aspect ratio needs a width and a height of at least 1, and a viewport must lie within ±8192 pixels of the target's origin: enlarge, move or shrink it",
            Self::BeforeNear => {
                "the point lies before the near plane, or behind the eye: move it or the near plane"
            }
            Self::BeyondFar => "the point lies beyond the far plane: move the plane, or do not clip there",
            Self::OutsideGuardBand => {
                "the point lies outside of the guard band of 8192 pixels around the target's origin: move it or the camera"
            }
            Self::NoVertex => "the mesh has no vertex with this index: indices begin at 0",
        })
    }
}

impl core::error::Error for CameraError {}
