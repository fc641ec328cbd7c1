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

/// The mesh in the middle of the picture, as large as its bounding sphere allows.
pub(crate) fn scene(mesh: Triangles, look: &Look) -> Scene {
    let Triangles { positions: vertices, faces: triangles } = mesh;
    let (low, high) = bounds(&vertices);
    let centre = [0, 1, 2].map(|i| f64::midpoint(low[i], high[i]));
    let radius = (0..3).map(|i| (high[i] - low[i]).powi(2)).sum::<f64>().sqrt() / 2.0;
    // A point, too, can be looked at.
    let radius = if radius > 0.0 { radius } else { 1.0 } * 1.02;
    let aspect = f64::from(look.width) / f64::from(look.height);
    let (distance, projection) = match look.projection {
        Named::Perspective => perspective(radius, aspect, look.field_of_view),
        Named::Orthographic | Named::Isometric => parallel(radius, aspect, 0.0),
        Named::Cavalier => parallel(radius, aspect, 1.0),
        Named::Cabinet => parallel(radius, aspect, 0.5),
    };
    let (sin_yaw, cos_yaw) = look.yaw.to_radians().sin_cos();
    let (sin_pitch, cos_pitch) = look.pitch.to_radians().sin_cos();
    let rows = [
        [cos_yaw, 0.0, -sin_yaw],
        [-sin_pitch * sin_yaw, cos_pitch, -sin_pitch * cos_yaw],
        [cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw],
    ];
    let away = [0.0, 0.0, distance];
    let row = |i: usize| {
        let [x, y, z]: [f64; 3] = rows[i];
        [x, y, z, -(x * centre[0] + y * centre[1] + z * centre[2]) - away[i]]
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

/// The distance from which the narrower angle holds the sphere, and a frustum round it.
fn perspective(radius: f64, aspect: f64, field_of_view: f64) -> (f64, Matrix) {
    let upright = (field_of_view / 2.0).to_radians().tan();
    let narrower = (upright * aspect.min(1.0)).atan();
    let distance = radius / narrower.sin();
    let (near, far) = ((distance - radius).max(distance / 256.0), distance + radius);
    let matrix = [
        [1.0 / (upright * aspect), 0.0, 0.0, 0.0],
        [0.0, 1.0 / upright, 0.0, 0.0],
        [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)],
        [0.0, 0.0, -1.0, 0.0],
    ];
    (distance, matrix)
}

/// A box round the sphere, its depth drawn up to the right at 45°, shortened by `receding`.
fn parallel(radius: f64, aspect: f64, receding: f64) -> (f64, Matrix) {
    let distance = 2.0 * radius;
    // What is nearer than the centre leans to the lower left, what is farther to the upper right.
    let lean = receding * std::f64::consts::FRAC_1_SQRT_2;
    let half = radius * (1.0 + lean) / aspect.min(1.0);
    let (x, y) = (1.0 / (half * aspect), 1.0 / half);
    let (near, far) = (distance - radius, distance + radius);
    let matrix = [
        [x, 0.0, -lean * x, -lean * x * distance],
        [0.0, y, -lean * y, -lean * y * distance],
        [0.0, 0.0, -2.0 / (far - near), -(far + near) / (far - near)],
        IDENTITY[3],
    ];
    (distance, matrix)
}
