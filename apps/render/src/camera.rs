//! The camera of a scene file by an eye and what it looks at, or by the scene that shall fill the picture.

use crate::json::{self, positive, within, Names};
use crate::model::{self, Fit, Look};
use crate::projections::Named;
use crate::scene::{product, Colors, Matrix, IDENTITY};
use pinhole_import::{Axis, Triangles};
use serde::Deserialize;
use serde_json::Value;

/// The farthest distance that is seen, in nearest ones, where the eye is among the vertices.
const DEEPEST: f64 = 1024.0;

impl Names for Axis {
    fn names() -> impl Iterator<Item = (&'static str, Self)> {
        Self::ALL.into_iter()
    }
}

/// A camera with an eye.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Eye {
    eye: [f64; 3],
    target: [f64; 3],
    up: Option<[f64; 3]>,
    fov: Option<f64>,
    near: Option<f64>,
    far: Option<f64>,
}

/// A camera that frames the scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Framing {
    #[serde(default, deserialize_with = "json::name")]
    projection: Option<Named>,
    yaw: Option<f64>,
    pitch: Option<f64>,
    fov: Option<f64>,
    #[serde(default, deserialize_with = "json::name")]
    up: Option<Axis>,
    #[serde(default, deserialize_with = "json::name")]
    frame: Option<Fit>,
}

/// The viewing and the projection matrix. `world` is the mesh in world coordinates, `points` what the picture shows beside it.
pub(crate) fn read(
    camera: Value,
    size: [u32; 2],
    world: Triangles,
    points: impl Iterator<Item = [f64; 3]>,
) -> Result<[Matrix; 2], String> {
    match camera.get("eye") {
        Some(_) => by_eye(&json::field(camera, "camera")?, size, world.positions.into_iter().chain(points)),
        None => framing(&json::field(camera, "camera")?, size, world),
    }
}

fn by_eye(
    camera: &Eye,
    [width, height]: [u32; 2],
    points: impl Iterator<Item = [f64; 3]>,
) -> Result<[Matrix; 2], String> {
    let Eye { eye, target, .. } = *camera;
    let towards_eye =
        unit([0, 1, 2].map(|i| eye[i] - target[i]), 0.0).ok_or("camera.target: is where the eye is")?;
    let upwards = camera.up.unwrap_or([0.0, 1.0, 0.0]);
    let right = unit(upwards, 0.0).and_then(|up| unit(cross(up, towards_eye), 1e-6));
    let right = right.ok_or("camera.up: points to the target or away from it: give another direction")?;
    let axes = [right, cross(towards_eye, right), towards_eye];
    let along = |axis: [f64; 3], p: [f64; 3]| (0..3).map(|i| axis[i] * p[i]).sum::<f64>();
    let row = |i: usize| [axes[i][0], axes[i][1], axes[i][2], -along(axes[i], eye)];
    let view = [row(0), row(1), row(2), IDENTITY[3]];

    let distances = points.map(|p| along(towards_eye, eye) - along(towards_eye, p));
    let ends = distances.fold([f64::INFINITY, 0.0], |[low, high], d| [d.min(low), d.max(high)]);
    // A little more than the scene, so that no rounding clips it.
    let deepest = if ends[1] > 0.0 { ends[1] * 1.02 } else { 1.0 };
    let far = positive(camera.far.unwrap_or(deepest), "camera.far")?;
    let nearest = (ends[0] * 0.98).max(far / DEEPEST);
    let near = camera.near.unwrap_or(if nearest < far { nearest } else { far / 2.0 });
    let near = positive(near, "camera.near")?;
    if near >= far {
        return Err(format!("camera: near is {near} and far is {far}: near must be nearer"));
    }
    let fov = camera.fov.unwrap_or(Named::ALL[0].field_of_view());
    let fov = within(fov, 1.0, 170.0, "camera.fov")?;
    let aspect = f64::from(width) / f64::from(height);
    let y = 1.0 / model::half_height(fov, aspect);
    let depth = [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)];
    Ok([view, [[y / aspect, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], depth, [0.0, 0.0, -1.0, 0.0]]])
}

fn framing(camera: &Framing, [width, height]: [u32; 2], world: Triangles) -> Result<[Matrix; 2], String> {
    let projection = camera.projection.unwrap_or(Named::ALL[0]);
    let steepest = projection.kind.steepest();
    let look = Look {
        projection,
        yaw: within(camera.yaw.unwrap_or(projection.yaw), -360.0, 360.0, "camera.yaw")?,
        pitch: within(camera.pitch.unwrap_or(projection.pitch), -steepest, steepest, "camera.pitch")?,
        field_of_view: within(camera.fov.unwrap_or(projection.field_of_view()), 1.0, 170.0, "camera.fov")?,
        width,
        height,
        up: camera.up.unwrap_or(Axis::Y),
        fit: camera.frame.unwrap_or(Fit::Sphere { zoom: 1.0 }),
    };
    let framed = model::scene(world, Colors::default(), &look)?;
    // What turns the mesh upright turns the whole world.
    Ok([product(&framed.view, &framed.model), framed.projection])
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

/// A vector of length 1 in the direction of another that is longer than `least`.
fn unit(v: [f64; 3], least: f64) -> Option<[f64; 3]> {
    let length = v[0].hypot(v[1]).hypot(v[2]);
    (length > least).then(|| v.map(|c| c / length))
}
