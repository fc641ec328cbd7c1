//! The camera of a scene file by an eye and what it looks at, or by the scene that shall fill the picture.

use crate::json::Field;
use crate::model::{self, Fit, Look};
use crate::projections::Named;
use crate::scene::{product, Colors, Matrix, IDENTITY};
use pinhole_import::{Axis, Triangles};

/// The farthest distance that is seen, in nearest ones, where the eye is among the vertices.
const DEEPEST: f64 = 1024.0;

/// The viewing and the projection matrix. `world` is the mesh in world coordinates, `points` what the picture shows beside it.
pub(crate) fn read(
    camera: &Field<'_>,
    size: [u32; 2],
    world: Triangles,
    points: impl Iterator<Item = [f64; 3]>,
) -> Result<[Matrix; 2], String> {
    match camera.has("eye") {
        true => by_eye(camera, size, world.positions.into_iter().chain(points)),
        false => framing(camera, size, world),
    }
}

fn by_eye(
    camera: &Field<'_>,
    [width, height]: [u32; 2],
    points: impl Iterator<Item = [f64; 3]>,
) -> Result<[Matrix; 2], String> {
    let known = ["eye", "target", "up", "fov", "near", "far"];
    let [eye, target, up, fov, near, far] = camera.fields(known)?;
    let target = camera.needed(target, "target")?;
    let (eye, to) = (camera.needed(eye, "eye")?.vector()?, target.vector()?);
    let towards_eye =
        unit([0, 1, 2].map(|i| eye[i] - to[i]), 0.0).ok_or_else(|| target.error("is where the eye is"))?;
    let upwards = up.as_ref().map_or(Ok([0.0, 1.0, 0.0]), Field::vector)?;
    let right = unit(upwards, 0.0).and_then(|up| unit(cross(up, towards_eye), 1e-6)).ok_or_else(|| {
        let message = "points to the target or away from it: give another direction";
        up.map_or_else(|| camera.error(format_args!("up: {message}")), |up| up.error(message))
    })?;
    let axes = [right, cross(towards_eye, right), towards_eye];
    let along = |axis: [f64; 3], p: [f64; 3]| (0..3).map(|i| axis[i] * p[i]).sum::<f64>();
    let row = |i: usize| [axes[i][0], axes[i][1], axes[i][2], -along(axes[i], eye)];
    let view = [row(0), row(1), row(2), IDENTITY[3]];

    let distances = points.map(|p| along(towards_eye, eye) - along(towards_eye, p));
    let ends = distances.fold([f64::INFINITY, 0.0], |[low, high], d| [d.min(low), d.max(high)]);
    let positive = |field: Option<Field<'_>>, usual: f64| match field {
        None => Ok(usual),
        Some(field) => field.number_within(f64::MIN_POSITIVE, f64::MAX),
    };
    // A little more than the scene, so that no rounding clips it.
    let deepest = if ends[1] > 0.0 { ends[1] * 1.02 } else { 1.0 };
    let far = positive(far, deepest)?;
    let nearest = (ends[0] * 0.98).max(far / DEEPEST);
    let near = positive(near, if nearest < far { nearest } else { far / 2.0 })?;
    if near >= far {
        return Err(camera.error(format_args!("near is {near} and far is {far}: near must be nearer")));
    }
    let fov = fov.map_or(Ok(Named::ALL[0].field_of_view()), |fov| fov.number_within(1.0, 170.0))?;
    let aspect = f64::from(width) / f64::from(height);
    let y = 1.0 / model::half_height(fov, aspect);
    let depth = [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)];
    Ok([view, [[y / aspect, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], depth, [0.0, 0.0, -1.0, 0.0]]])
}

fn framing(camera: &Field<'_>, [width, height]: [u32; 2], world: Triangles) -> Result<[Matrix; 2], String> {
    let known = ["projection", "yaw", "pitch", "fov", "up", "frame"];
    let [projection, yaw, pitch, fov, up, frame] = camera.fields(known)?;
    let names = Named::ALL.map(|named| (named.name, named));
    let projection = projection.map_or(Ok(Named::ALL[0]), |name| name.one_of(&names))?;
    let number = |field: Option<Field<'_>>, usual: f64, low, high| {
        field.map_or(Ok(usual), |field| field.number_within(low, high))
    };
    let steepest = projection.kind.steepest();
    let fits = [("sphere", Fit::Sphere { zoom: 1.0 }), ("outline", Fit::Outline)];
    let look = Look {
        projection,
        yaw: number(yaw, projection.yaw, -360.0, 360.0)?,
        pitch: number(pitch, projection.pitch, -steepest, steepest)?,
        field_of_view: number(fov, projection.field_of_view(), 1.0, 170.0)?,
        width,
        height,
        up: up.map_or(Ok(Axis::Y), |up| up.one_of(&Axis::ALL))?,
        fit: frame.map_or(Ok(fits[0].1), |frame| frame.one_of(&fits))?,
    };
    let framed = model::scene(world, Colors::default(), &look)?;
    // What turns the mesh upright turns the whole world.
    Ok([product(&framed.view, &framed.model), framed.projection])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

/// A vector of length 1 in the direction of another that is longer than `least`.
fn unit(v: [f64; 3], least: f64) -> Option<[f64; 3]> {
    let length = v[0].hypot(v[1]).hypot(v[2]);
    (length > least).then(|| v.map(|c| c / length))
}
