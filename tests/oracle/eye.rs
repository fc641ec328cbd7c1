//! What a camera sees in a pixel, by one ray through it, in f64. There is no clipping in here: the
//! ray meets the triangle's plane where the three barycentric weights are positive, and that point
//! counts if it lies between near and far. Culling by the sign of the homogeneous determinant.

use super::chain::{cross, dot, Affine, Camera, V3, V4};

/// A face in homogeneous screen coordinates, with the clip depth of its corners.
#[derive(Clone, Copy)]
pub(crate) struct Face {
    screen: [V3; 3],
    z: [f64; 3],
}

impl Face {
    pub(crate) fn new(camera: &Camera, corners: [V4; 3]) -> Self {
        Face { screen: corners.map(|c| camera.homogeneous_screen(c)), z: corners.map(|c| c[2]) }
    }

    /// Front: counter-clockwise seen with y up, hence negative in screen coordinates.
    pub(crate) fn is_front(&self) -> bool {
        let [a, b, c] = self.screen;
        dot(a, cross(b, c)) < 0.0
    }

    /// z/w of the point seen through (x, y), or none if the ray misses the triangle.
    pub(crate) fn meet(&self, x: f64, y: f64) -> Option<f64> {
        let [a, b, c] = self.screen;
        let p = [x, y, 1.0];
        let det = dot(a, cross(b, c));
        let weights = [dot(p, cross(b, c)) / det, dot(p, cross(c, a)) / det, dot(p, cross(a, b)) / det];
        // Σ weight·(x w, y w, w) = (x, y, 1): the scale is one, so Σ weight·z is z/w.
        (det != 0.0 && weights.iter().all(|&w| w >= 0.0)).then(|| dot(weights, self.z))
    }
}

/// All faces of a placed mesh.
pub(crate) fn faces(camera: &Camera, model: &Affine, vertices: &[V3], faces: &[[u16; 3]]) -> Vec<Face> {
    faces.iter().map(|f| Face::new(camera, f.map(|i| camera.clip(model, vertices[usize::from(i)])))).collect()
}

/// The index of the nearest front face seen through (x, y). Near is always there, far on demand.
pub(crate) fn seen(faces: &[Face], x: f64, y: f64, far: bool) -> Option<usize> {
    let mut nearest: Option<(usize, f64)> = None;
    for (i, face) in faces.iter().enumerate() {
        if !face.is_front() {
            continue;
        }
        if let Some(z) = face.meet(x, y) {
            if z >= -1.0 && (!far || z <= 1.0) && nearest.is_none_or(|(_, best)| z < best) {
                nearest = Some((i, z));
            }
        }
    }
    nearest.map(|(i, _)| i)
}

/// What is seen at the centre of pixel (i, j): `Err` if it is not the same all around the centre
/// within `tolerance` px, so that a snapped vertex may decide otherwise.
pub(crate) fn pixel(
    faces: &[Face],
    (i, j): (i64, i64),
    far: bool,
    tolerance: f64,
) -> Result<Option<usize>, ()> {
    let (x, y) = (i as f64 + 0.5, j as f64 + 0.5);
    let here = seen(faces, x, y, far);
    let t = tolerance;
    let around = [(t, 0.0), (-t, 0.0), (0.0, t), (0.0, -t), (t, t), (t, -t), (-t, t), (-t, -t)];
    if around.iter().all(|&(dx, dy)| seen(faces, x + dx, y + dy, far) == here) {
        Ok(here)
    } else {
        Err(())
    }
}
