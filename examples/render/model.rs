//! A mesh with nothing said of a camera: one that shows all of it.

use crate::scene::{bounds, Matrix, Scene};
use pinhole_import::Triangles;

/// How to look at it. Angles in degrees.
pub(crate) struct Look {
    pub(crate) projection: Named,
    /// Of the camera about the y axis, from +z towards +x.
    pub(crate) yaw: f64,
    /// Of the camera above the horizon.
    pub(crate) pitch: f64,
    /// Of a perspective, upright.
    pub(crate) field_of_view: f64,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Named {
    Perspective,
    Orthographic,
    Isometric,
    Cavalier,
    Cabinet,
}

impl Named {
    pub(crate) const ALL: [(&'static str, Self); 5] = [
        ("perspective", Self::Perspective),
        ("orthographic", Self::Orthographic),
        ("isometric", Self::Isometric),
        ("cavalier", Self::Cavalier),
        ("cabinet", Self::Cabinet),
    ];

    /// How long a receding unit is drawn, at 45°; 0 where the picture is not oblique.
    fn receding(self) -> f64 {
        match self {
            Self::Cavalier => 1.0,
            Self::Cabinet => 0.5,
            _ => 0.0,
        }
    }

    /// Yaw and pitch, where nothing is asked for.
    pub(crate) fn usual(self) -> (f64, f64) {
        match self {
            Self::Perspective | Self::Orthographic => (30.0, 20.0),
            // The view plane normal is (1, 1, 1).
            Self::Isometric => (45.0, (1.0f64 / 3.0).sqrt().asin().to_degrees()),
            Self::Cavalier | Self::Cabinet => (0.0, 0.0),
        }
    }
}

const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// Of the picture's half width and height, what the mesh may fill.
const FILL: f64 = 0.92;

/// The mesh in the middle of the picture, as large as fits.
pub(crate) fn scene(mesh: Triangles, look: &Look) -> Scene {
    let Triangles { positions: vertices, faces: triangles } = mesh;
    let (sin_yaw, cos_yaw) = look.yaw.to_radians().sin_cos();
    let (sin_pitch, cos_pitch) = look.pitch.to_radians().sin_cos();
    let axes = [
        [cos_yaw, 0.0, -sin_yaw],
        [-sin_pitch * sin_yaw, cos_pitch, -sin_pitch * cos_yaw],
        [cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw],
    ];
    // In the camera's axes; what leans is sheared, so that the middle is the picture's.
    let lean = look.projection.receding() * std::f64::consts::FRAC_1_SQRT_2;
    let turned: Vec<[f64; 3]> = vertices
        .iter()
        .map(|p| {
            let [x, y, z] = axes.map(|axis| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]);
            [x - lean * z, y - lean * z, z]
        })
        .collect();
    let (low, high) = bounds(&turned);
    let middle = [0, 1, 2].map(|i| f64::midpoint(low[i], high[i]));
    let aspect = f64::from(look.width) / f64::from(look.height);
    // A point, too, can be looked at.
    let radius = (0..3).map(|i| (high[i] - low[i]) / 2.0).fold(0.0, f64::max);
    let radius = if radius > 0.0 { radius } else { 1.0 };
    let from_middle = turned.iter().map(|p| [p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]]);
    // Half the picture's height and width, for each unit of distance where it is a perspective.
    let half = |height: f64| [height * aspect, height];
    let (distance, height) = if look.projection == Named::Perspective {
        let height = (look.field_of_view / 2.0).to_radians().tan();
        let [x, y] = half(height * FILL);
        let nearest = from_middle.map(|p| p[2] + (p[0].abs() / x).max(p[1].abs() / y)).fold(0.0, f64::max);
        (nearest.max(1.1 * radius), height)
    } else {
        let largest = from_middle.map(|p| (p[0].abs() / aspect).max(p[1].abs())).fold(0.0, f64::max);
        (2.0 * radius, if largest > 0.0 { largest / FILL } else { radius })
    };
    let deep = 1.05 * radius;
    let (near, far) = ((distance - deep).max(distance / 64.0), distance + deep);
    let [x, y] = half(height).map(|h| 1.0 / h);
    let projection = if look.projection == Named::Perspective {
        let depth = [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)];
        [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], depth, [0.0, 0.0, -1.0, 0.0]]
    } else {
        // What is farther than the middle leans to the upper right.
        let (across, up) = (-lean * x, -lean * y);
        let depth = [0.0, 0.0, -2.0 / (far - near), -(far + near) / (far - near)];
        [[x, 0.0, across, across * distance], [0.0, y, up, up * distance], depth, IDENTITY[3]]
    };
    // The middle, not sheared, goes to (0, 0, -distance).
    let away = [middle[0] + lean * middle[2], middle[1] + lean * middle[2], middle[2] + distance];
    let row = |i: usize| {
        let [x, y, z]: [f64; 3] = axes[i];
        [x, y, z, -away[i]]
    };
    Scene {
        vertices,
        triangles,
        model: IDENTITY,
        view: [row(0), row(1), row(2), IDENTITY[3]],
        projection,
        width: look.width,
        height: look.height,
        viewport: [0, 0, look.width as i32, look.height as i32], // at most 4096
        cull: false,
    }
}
