//! The named projections of the gallery, fitted to any mesh.
#![allow(missing_docs)] // names that say what they are

/// A projection and its default direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Named {
    pub name: &'static str,
    pub kind: Kind,
    /// Angle of the eye about the upright axis, in degrees.
    pub yaw: f64,
    /// Angle of the eye above the horizon, in degrees.
    pub pitch: f64,
}

/// How the projectors run, and how the view plane lies relative to the direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Projectors meet in the eye; the plane is perpendicular to the direction of view.
    Perspective,
    /// Projectors meet in the eye; the plane is upright, so that verticals stay vertical, as with a shift lens.
    Upright,
    /// Projectors meet in the eye; the plane is upright and perpendicular to the nearest axis: a side keeps its shape.
    Frontal,
    /// Projectors are parallel, and perpendicular to the plane.
    Parallel,
    /// Projectors are parallel and oblique: receding lines are drawn at `angle` degrees, `factor` times as long.
    Oblique { angle: f64, factor: f64 },
    /// Projectors meet behind the mesh: distant parts are larger.
    Reverse,
}

impl Named {
    const fn new(name: &'static str, kind: Kind, yaw: f64, pitch: f64) -> Self {
        Self { name, kind, yaw, pitch }
    }

    pub const ALL: [Self; 21] = [
        Self::new("perspective", Kind::Perspective, 30.0, 20.0),
        Self::new("one-point", Kind::Frontal, 25.0, 20.0),
        Self::new("two-point", Kind::Upright, 40.0, 25.0),
        Self::new("three-point", Kind::Perspective, 40.0, 40.0),
        Self::new("orthographic", Kind::Parallel, 30.0, 20.0),
        // The view plane normals of these are (1, 1, 1), (2, 1, 2) and (1, 2, 3).
        Self::new("isometric", Kind::Parallel, 45.0, 35.264_389_682_754_654),
        Self::new("dimetric", Kind::Parallel, 45.0, 19.471_220_634_490_69),
        Self::new("trimetric", Kind::Parallel, 18.434_948_822_922_01, 32.311_533_237_423_865),
        Self::new("cavalier", Kind::Oblique { angle: 45.0, factor: 1.0 }, 0.0, 0.0),
        Self::new("cabinet", Kind::Oblique { angle: 45.0, factor: 0.5 }, 0.0, 0.0),
        Self::new("oblique", Kind::Oblique { angle: 60.0, factor: 0.75 }, 0.0, 0.0),
        // From above: the plan keeps its shape, and verticals their length.
        Self::new("military", Kind::Oblique { angle: 90.0, factor: -1.0 }, 30.0, 90.0),
        Self::new("front", Kind::Parallel, 0.0, 0.0),
        Self::new("back", Kind::Parallel, 180.0, 0.0),
        Self::new("left", Kind::Parallel, -90.0, 0.0),
        Self::new("right", Kind::Parallel, 90.0, 0.0),
        Self::new("top", Kind::Parallel, 0.0, 90.0),
        Self::new("bottom", Kind::Parallel, 0.0, -90.0),
        Self::new("off-axis", Kind::Upright, 26.565_051_177_077_99, 45.0),
        Self::new("wide-angle", Kind::Perspective, 30.0, 20.0),
        Self::new("reverse", Kind::Reverse, 10.0, 10.0),
    ];

    /// Default field of view of perspectives, in degrees.
    pub fn field_of_view(&self) -> f64 {
        match self.name {
            "one-point" | "two-point" | "off-axis" => 50.0,
            "three-point" => 70.0,
            "wide-angle" => 100.0,
            _ => 40.0,
        }
    }
}

/// Orientation of the view plane and the projectors.
pub struct Stance {
    /// Angle of the view plane normal, in radians.
    pub yaw: f64,
    pub pitch: f64,
    /// Slope of the projectors to the right and up, per unit towards the eye.
    pub lean: [f64; 2],
}

impl Kind {
    pub const fn meets_in_the_eye(self) -> bool {
        matches!(self, Self::Perspective | Self::Upright | Self::Frontal)
    }

    /// The largest pitch of the eye, up or down, in degrees.
    pub const fn steepest(self) -> f64 {
        match self {
            Self::Upright | Self::Frontal => 70.0,
            _ => 90.0,
        }
    }

    /// The orientation for an eye at these angles, in degrees. `None` where the pitch is too large for an upright plane.
    pub fn stance(self, yaw: f64, pitch: f64) -> Option<Stance> {
        let radians = f64::to_radians;
        match self {
            Self::Perspective | Self::Parallel | Self::Reverse => {
                Some(Stance { yaw: radians(yaw), pitch: radians(pitch), lean: [0.0; 2] })
            }
            Self::Upright | Self::Frontal if pitch.abs() > self.steepest() => None,
            Self::Upright => {
                Some(Stance { yaw: radians(yaw), pitch: 0.0, lean: [0.0, radians(pitch).tan()] })
            }
            Self::Frontal => {
                let axis = (yaw / 90.0).round() * 90.0;
                let beside = radians(yaw - axis);
                let lean = [beside.tan(), radians(pitch).tan() / beside.cos()];
                Some(Stance { yaw: radians(axis), pitch: 0.0, lean })
            }
            Self::Oblique { angle, factor } => {
                let (up, across) = radians(angle).sin_cos();
                let lean = [across, up].map(|part| factor * part);
                Some(Stance { yaw: radians(yaw), pitch: radians(pitch), lean })
            }
        }
    }
}
