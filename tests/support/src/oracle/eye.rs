//! The face that a camera sees in a pixel, by the ray through its center, in f64, without clipping:
//! the ray meets the triangle where the three barycentric weights are positive, and that point counts
//! if it lies between near and far. Culling by the sign of the homogeneous determinant.

use super::chain::{cross, dot, Affine, Camera, V3, V4};

/// A face in homogeneous screen coordinates, with the clip depth of its corners.
#[derive(Clone, Copy)]
pub struct Face {
    screen: [V3; 3],
    z: [f64; 3],
}

impl Face {
    pub fn new(camera: &Camera, corners: [V4; 3]) -> Self {
        Face { screen: corners.map(|c| camera.homogeneous_screen(c)), z: corners.map(|c| c[2]) }
    }

    /// Front: counter-clockwise seen with y up, hence negative in screen coordinates.
    pub fn is_front(&self) -> bool {
        let [a, b, c] = self.screen;
        dot(a, cross(b, c)) < 0.0
    }

    /// How the triangle lies to the ray through (x, y), or to any other within `tolerance` px of it.
    fn meet(&self, x: f64, y: f64, far: bool, tolerance: f64) -> Meeting {
        let [a, b, c] = self.screen;
        let det = dot(a, cross(b, c));
        if det == 0.0 {
            return Meeting::Never;
        }
        // Σ weight·(x w, y w, w) = (x, y, 1): the weights are linear in x and y, and z/w is Σ weight·z.
        let rows = [cross(b, c), cross(c, a), cross(a, b)].map(|r| r.map(|v| v / det));
        let depth: V3 = core::array::from_fn(|k| (0..3).map(|i| rows[i][k] * self.z[i]).sum());
        let at = |r: V3| (dot(r, [x, y, 1.0]), tolerance * (r[0].abs() + r[1].abs()));
        let (z, z_slack) = at(depth);
        // What must not be negative, and how much it may change nearby.
        let mut limits = rows.map(at).to_vec();
        limits.push((z + 1.0, z_slack));
        if far {
            limits.push((1.0 - z, z_slack));
        }
        if limits.iter().any(|(v, slack)| v + slack < 0.0) {
            Meeting::Never
        } else if limits.iter().all(|(v, slack)| v - slack > 0.0) {
            Meeting::Surely(z, z_slack)
        } else {
            Meeting::Perhaps
        }
    }
}

enum Meeting {
    Never,
    Perhaps,
    /// With z/w, and how much it may differ nearby.
    Surely(f64, f64),
}

/// All faces of a mesh instance.
pub fn faces(camera: &Camera, model: &Affine, vertices: &[V3], faces: &[[u16; 3]]) -> Vec<Face> {
    faces.iter().map(|f| Face::new(camera, f.map(|i| camera.clip(model, vertices[usize::from(i)])))).collect()
}

/// The nearest front face seen at the centre of pixel (i, j): `Err` if that is not certain for every
/// ray within `tolerance` px of it, so that a snapped vertex may decide otherwise. Near is always
/// there, far on demand.
pub fn pixel(faces: &[Face], (i, j): (i64, i64), far: bool, tolerance: f64) -> Result<Option<usize>, ()> {
    let (x, y) = (i as f64 + 0.5, j as f64 + 0.5);
    let mut nearest: Option<(usize, f64, f64)> = None;
    for (index, face) in faces.iter().enumerate() {
        match face.meet(x, y, far, tolerance) {
            Meeting::Never => {}
            Meeting::Perhaps => return Err(()),
            Meeting::Surely(..) if !face.is_front() => {}
            Meeting::Surely(z, slack) => match nearest {
                None => nearest = Some((index, z, slack)),
                Some((_, best, best_slack)) if (z - best).abs() <= slack + best_slack => return Err(()),
                Some((_, best, _)) if z < best => nearest = Some((index, z, slack)),
                Some(_) => {}
            },
        }
    }
    Ok(nearest.map(|(index, ..)| index))
}
