//! A camera for a mesh: one that shows all of it.

use crate::json::Names;
use crate::light::Lights;
use crate::projections::{Kind, Named, Stance};
use crate::scene::{bounds, Colors, Matrix, Scene, IDENTITY};
use pinhole_import::{Axis, Triangles};

/// The view of a mesh. Angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    pub projection: Named,
    /// Angle of the eye about the upright axis; with y up, from +z towards +x.
    pub yaw: f64,
    /// Angle of the eye above the horizon.
    pub pitch: f64,
    /// Field of view of a perspective, across the narrower side of the picture.
    pub field_of_view: f64,
    pub width: u32,
    pub height: u32,
    /// The file's axis that points upwards.
    pub up: Axis,
    pub fit: Fit,
}

/// The shape that fills the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fit {
    /// The mesh's outline from this direction, for a single picture.
    Outline,
    /// The volume that the mesh sweeps while it turns about its upright axis, which stays in the middle.
    Turn,
    /// The mesh's bounding sphere, magnified by a factor: it has one size from all sides, and its centre is the picture's. A
    /// perspective is that of [`pinhole::Camera::framing`], as the templates for firmware have it.
    Sphere { zoom: f64 },
}

impl Names for Fit {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        [("sphere", Self::Sphere { zoom: 1.0 }), ("outline", Self::Outline)].into_iter()
    }
}

/// The part of the picture's half width and height that the mesh's outline may fill.
const FILL: f64 = 0.92;
/// The part of the narrower half side that the bounding sphere fills, as in [`pinhole::Camera::framing`].
const SPHERE_FILL: f64 = 31.0 / 32.0;

/// The centre and the window of the picture, in the axes of the view plane, sheared so that projectors are perpendicular to
/// it.
struct Seen {
    middle: [f64; 3],
    /// Extent of the mesh from the centre, towards the eye and away from it.
    radius: f64,
    /// The distance between near and far plane and the mesh, as a part of the radius.
    slack: f64,
    distance: f64,
    /// Half the height of the picture; of a perspective, at distance 1.
    height: f64,
    /// Offset of the window's centre from the point that the eye looks at, in the units of `height`: in a perspective near
    /// parts are larger, so the centre of the mesh is not the centre of its picture.
    window: [f64; 2],
}

/// A scene with the mesh in the middle of the picture, as large as fits; `colors` are those of its triangles, or none. The
/// error names the option.
pub fn scene(mesh: Triangles, colors: Colors, look: &Look) -> Result<Scene, String> {
    let mesh_points = mesh.seen();
    let Triangles { positions: vertices, faces: triangles } = mesh;
    let kind = look.projection.kind;
    let Stance { yaw, pitch, lean } = kind.stance(look.yaw, look.pitch).ok_or_else(|| {
        format!("--pitch: {} is not from -70 to 70, which {} needs", look.pitch, look.projection.name)
    })?;
    let axes = axes(yaw, pitch);
    let model = upright_matrix(look.up);
    let framed = match mesh_points {
        points if points.is_empty() => vertices.clone(),
        points => points,
    };
    let turned = |p: &[f64; 3]| turned(upright(p, &model), &axes, lean);
    let seen = match look.fit {
        Fit::Outline => outline(framed.iter().map(turned).collect(), None, look),
        Fit::Turn => {
            let (centre, rings) = rings(&framed, &model);
            // A mesh that turns has one size from all sides.
            let axes = self::axes(0.0, pitch);
            let points = rings.map(|p| self::turned(p, &axes, lean)).collect();
            let (seen, centre) = (outline(points, Some([0.0; 3]), look), turned(&centre));
            Seen { middle: [0, 1, 2].map(|i| seen.middle[i] + centre[i]), ..seen }
        }
        Fit::Sphere { zoom } => sphere(&framed, turned, lean, look, zoom),
    };
    let Seen { middle, radius, slack, distance, height, window } = seen;
    let deep = radius + slack * radius;
    let (near, far) = ((distance - deep).max((distance - radius) / 2.0), distance + deep);
    let [across, up] = lean;
    let [x, y] = [aspect(look) * height, height].map(|h| 1.0 / h);
    // The centre maps to (0, 0, -distance) before the shear; with oblique projectors the eye is shifted by their slope.
    let mut away = [middle[0] + across * middle[2], middle[1] + up * middle[2], middle[2] + distance];
    let parallel = [0.0, 0.0, -2.0 / (far - near), -(far + near) / (far - near)];
    let projection = if kind.meets_in_the_eye() {
        away[0] += across * distance;
        away[1] += up * distance;
        let depth = [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)];
        [
            [x, 0.0, (window[0] - across) * x, 0.0],
            [0.0, y, (window[1] - up) * y, 0.0],
            depth,
            [0.0, 0.0, -1.0, 0.0],
        ]
    } else if kind == Kind::Reverse {
        // w = 1 + u/2 and z = −u − 1/2, where u runs over the mesh from −1 (far) to 1 (near).
        let u = |factor: f64, more: f64| [0.0, 0.0, factor / deep, factor * distance / deep + more];
        [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], u(-1.0, -0.5), u(0.5, 1.0)]
    } else {
        // Points beyond the centre shift to the upper right.
        let leaning = |lean: f64, scale: f64| (-lean * scale, -lean * scale * distance);
        let ((a, b), (c, d)) = (leaning(across, x), leaning(up, y));
        [[x, 0.0, a, b], [0.0, y, c, d], parallel, IDENTITY[3]]
    };
    let row = |i: usize| {
        let [x, y, z]: [f64; 3] = axes[i];
        [x, y, z, -away[i]]
    };
    Ok(Scene {
        vertices,
        triangles,
        colors,
        model,
        view: [row(0), row(1), row(2), IDENTITY[3]],
        projection,
        width: look.width,
        height: look.height,
        viewport: [0, 0, look.width as i32, look.height as i32], // at most 4096
        cull: true, // as firmware does unless it says otherwise; `--two-sided` adds backs
        texture: None,
        lights: Lights::default(),
        fog: None,
        sprites: Vec::new(),
        mesh_files: Vec::new(),
    })
}

/// The axes of the view plane: right, up, and towards the eye.
fn axes(yaw: f64, pitch: f64) -> [[f64; 3]; 3] {
    let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) = (yaw.sin_cos(), pitch.sin_cos());
    [
        [cos_yaw, 0.0, -sin_yaw],
        [-sin_pitch * sin_yaw, cos_pitch, -sin_pitch * cos_yaw],
        [cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw],
    ]
}

fn aspect(look: &Look) -> f64 {
    f64::from(look.width) / f64::from(look.height)
}

/// Half the height of the picture of a perspective, at distance 1. The field of view is that across the narrower side.
pub(crate) fn half_height(field_of_view: f64, aspect: f64) -> f64 {
    (field_of_view / 2.0).to_radians().tan() / aspect.min(1.0)
}

/// The matrix that turns the file's axis upwards.
fn upright_matrix(up: Axis) -> Matrix {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| up.to_y(axis));
    let row = |i: usize| [columns[0][i] + 0.0, columns[1][i] + 0.0, columns[2][i] + 0.0, 0.0]; // no -0
    [row(0), row(1), row(2), IDENTITY[3]]
}

/// A point of the file, turned so that y is up.
fn upright(p: &[f64; 3], model: &Matrix) -> [f64; 3] {
    [0, 1, 2].map(|i| (0..3).map(|k| model[i][k] * p[k]).sum())
}

/// A point in the axes of the view plane, sheared.
fn turned(p: [f64; 3], axes: &[[f64; 3]; 3], lean: [f64; 2]) -> [f64; 3] {
    let [x, y, z] = axes.map(|axis| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]);
    [x - lean[0] * z, y - lean[1] * z, z]
}

fn middle_of(vertices: &[[f64; 3]]) -> [f64; 3] {
    let (low, high) = bounds(vertices);
    [0, 1, 2].map(|i| f64::midpoint(low[i], high[i]))
}

/// The centre of the mesh and, relative to it, points on the circles of its vertices about the upright axis.
fn rings<'a>(vertices: &'a [[f64; 3]], model: &'a Matrix) -> ([f64; 3], impl Iterator<Item = [f64; 3]> + 'a) {
    const STEPS: u32 = 48; // between two of them a ring reaches 0.2 % farther
    let centre = middle_of(vertices);
    let ring = move |p: &[f64; 3]| {
        let [x, y, z] = upright(&[0, 1, 2].map(|i| p[i] - centre[i]), model);
        let radius = x.hypot(z);
        (0..STEPS).map(move |step| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
            [radius * cos, y, radius * sin]
        })
    };
    (centre, vertices.iter().flat_map(ring))
}

/// The frame that shows all points, centred on `axis` from left to right if there is one.
fn outline(points: Vec<[f64; 3]>, axis: Option<[f64; 3]>, look: &Look) -> Seen {
    let (low, high) = bounds(&points);
    let middle = axis.unwrap_or([0, 1, 2].map(|i| f64::midpoint(low[i], high[i])));
    // A mesh that is one point has a picture too.
    let extent = (0..3).map(|i| (high[i] - middle[i]).max(middle[i] - low[i])).fold(0.0, f64::max);
    let radius = if extent > 0.0 { extent } else { 1.0 };
    let from_middle = || points.iter().map(|p| [0, 1, 2].map(|i| p[i] - middle[i]));
    let farthest = |f: &dyn Fn([f64; 3]) -> f64| from_middle().map(f).fold(f64::MIN, f64::max);
    let aspect = aspect(look);
    if look.projection.kind.meets_in_the_eye() {
        let height = half_height(look.field_of_view, aspect);
        let half = [aspect * height, height];
        // From a distance: the centre of the outline along an axis, and the share of the window that it fills.
        let seen = |distance: f64, i: usize| {
            let high = farthest(&|p| p[i] / (distance - p[2]));
            let low = -farthest(&|p| -p[i] / (distance - p[2]));
            let middle = if i == 0 && axis.is_some() { 0.0 } else { f64::midpoint(low, high) };
            (middle, (high - middle).max(middle - low) / half[i])
        };
        let fits = |distance: f64| (0..2).all(|i| seen(distance, i).1 <= FILL);
        let mut near = 1.1 * radius;
        let mut far = near;
        while !fits(far) {
            (near, far) = (far, 2.0 * far);
        }
        for _ in 0..32 {
            let between = f64::midpoint(near, far);
            *(if fits(between) { &mut far } else { &mut near }) = between;
        }
        let window = [0, 1].map(|i| seen(far, i).0);
        return Seen { middle, radius, slack: 0.05, distance: far, height, window };
    }
    let weight = |z: f64| match look.projection.kind {
        Kind::Reverse => 1.0 + z / (2.1 * radius),
        _ => 1.0,
    };
    let largest = farthest(&|p| (p[0].abs() / aspect).max(p[1].abs()) / weight(p[2]));
    let height = if largest > 0.0 { largest / FILL } else { radius };
    Seen { middle, radius, slack: 0.05, distance: 2.0 * radius, height, window: [0.0; 2] }
}

/// The frame that shows the bounding sphere of the mesh, which no turn changes.
fn sphere(
    vertices: &[[f64; 3]],
    turned: impl Fn(&[f64; 3]) -> [f64; 3],
    lean: [f64; 2],
    look: &Look,
    zoom: f64,
) -> Seen {
    let middle = middle_of(vertices);
    let away = |p: &[f64; 3]| (0..3).map(|i| (p[i] - middle[i]).powi(2)).sum::<f64>().sqrt();
    let radius = vertices.iter().map(away).fold(0.0, f64::max);
    let radius = if radius > 0.0 { radius } else { 1.0 };
    let middle = turned(&middle);
    let aspect = aspect(look);
    let fitting = |along: [f64; 2]| along[0].max(along[1]) * radius;
    if look.projection.kind.meets_in_the_eye() {
        let height = half_height(look.field_of_view, aspect);
        // The maximum of z + (x - lean z)/h over the sphere, for either sign of x.
        let half = [aspect * height, height].map(|half| half * SPHERE_FILL);
        let least = [0, 1].map(|i| (1.0 + lean[i].abs() / half[i]).hypot(1.0 / half[i]));
        let (distance, height) = (fitting(least), height / zoom);
        return Seen { middle, radius, slack: 1.0 / 64.0, distance, height, window: [0.0; 2] };
    }
    // The maximum of x - lean z; of a reverse perspective, the maximum of x/(1 + u/2) where x² + u² = 1.
    let grown = if look.projection.kind == Kind::Reverse { (4.0f64 / 3.0).sqrt() } else { 1.0 };
    let extents = [0, 1].map(|i| grown * lean[i].hypot(1.0) / [aspect, 1.0][i]);
    let height = fitting(extents) / SPHERE_FILL / zoom;
    Seen { middle, radius, slack: 0.05, distance: 2.0 * radius, height, window: [0.0; 2] }
}
