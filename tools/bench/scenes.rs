//! Reads `scenes.json`, for the build scripts of this directory and of `rivals`.

use serde_json::Value;

pub(crate) type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The unit normal of the torus: away from the circle of radius 1 about z, the centre line of the tube.
pub(crate) fn torus_normal([x, y, z]: [f64; 3]) -> Result<[f64; 3]> {
    let from_axis = x.hypot(y);
    let away = [x - x / from_axis, y - y / from_axis, z];
    let length = away.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 0.42).abs() > 1e-6 {
        return Err("the torus's tube has a radius of 0.42".into());
    }
    Ok(away.map(|c| c / length))
}

/// The unit normal of a counter-clockwise face.
pub(crate) fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    n.map(|c| c / length)
}

/// All edges of the faces, each once.
pub(crate) fn edges_of(faces: &[[u16; 3]]) -> Vec<[u16; 2]> {
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: std::collections::BTreeSet<_> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().collect()
}

pub(crate) fn list<T>(value: &Value, item: fn(&Value) -> Result<T>) -> Result<Vec<T>> {
    value.as_array().ok_or("a list")?.iter().map(item).collect()
}

pub(crate) fn number(value: &Value) -> Result<f64> {
    Ok(value.as_f64().ok_or("a number")?)
}

pub(crate) fn triple(value: &Value) -> Result<[f64; 3]> {
    <[f64; 3]>::try_from(list(value, number)?).map_err(|_| "three numbers".into())
}

pub(crate) fn integers<const N: usize>(value: &Value) -> Result<[i64; N]> {
    let integer = |value: &Value| Ok(value.as_i64().ok_or("an integer")?);
    <[i64; N]>::try_from(list(value, integer)?).map_err(|_| "another number of integers".into())
}

pub(crate) fn indices<const N: usize>(value: &Value) -> Result<[u16; N]> {
    let index = |value: &Value| Ok(u16::try_from(value.as_u64().ok_or("an index")?)?);
    <[u16; N]>::try_from(list(value, index)?).map_err(|_| "another number of corners".into())
}
