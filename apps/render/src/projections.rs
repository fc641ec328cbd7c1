//! Projections by name: those of the gallery, fitted to any mesh.

/// A projection, and where it is usually seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Named {
    pub name: &'static str,
    pub kind: Kind,
    /// Of the eye about the upright axis, in degrees.
    pub yaw: f64,
    /// Of the eye above the horizon.
    pub pitch: f64,
}

/// What the projectors do, and how the view plane stands to the way from the mesh to the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// They meet in the eye; the plane is square to its way.
    Perspective,
    /// The plane is upright, so that uprights stay so: a shift lens.
    Upright,
    /// The plane is upright and square to the nearest axis as well: a side keeps its shape.
    Frontal,
    /// They are parallel, and the plane square to them.
    Parallel,
    /// They are parallel and lean: what recedes is drawn at `angle` degrees, `factor` times as long.
    Oblique { angle: f64, factor: f64 },
    /// They meet behind the mesh: what is farther is larger.
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
        // From above, so that what is nearer is higher: the plan keeps its shape and uprights their length.
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

    /// Of perspectives, in degrees, where nothing is asked for.
    pub fn field_of_view(&self) -> f64 {
        match self.name {
            "one-point" | "two-point" | "off-axis" => 50.0,
            "three-point" => 70.0,
            "wide-angle" => 100.0,
            _ => 40.0,
        }
    }
}

/// Turned by so much, the plane and the projectors.
pub struct Stance {
    /// Of the view plane normal, in radians.
    pub yaw: f64,
    pub pitch: f64,
    /// How far the projectors lean to the right and up, for each unit towards the eye.
    pub lean: [f64; 2],
}

impl Kind {
    pub const fn meets_in_the_eye(self) -> bool {
        matches!(self, Self::Perspective | Self::Upright | Self::Frontal)
    }

    /// From how far above or below it can be seen, in degrees.
    pub const fn steepest(self) -> f64 {
        match self {
            Self::Upright | Self::Frontal => 70.0,
            _ => 90.0,
        }
    }

    /// Seen from there, in degrees. `None` where an upright plane would be seen from too far above or below.
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
