//! Light for models: a lamp at the left of the camera and a weaker one at the right, so that both sides show shape.

use crate::quantised::Quantised;
use crate::scene::Scene;
use pinhole::{Lambert, Vector3};

/// Directions to the lamps in view coordinates.
const KEY: [f64; 3] = [-0.45, 0.6, 0.66];
const FILL: [f64; 3] = [0.8, -0.15, 0.3];
/// Intensities of the lamps and of ambient light; 256 is full.
const KEY_LEVEL: u32 = 190;
const FILL_LEVEL: u32 = 48;
const AMBIENT: u32 = 60;

pub(crate) struct Light {
    /// No lamps where the model matrix flattens the mesh: its normals have no directions then.
    lamps: Option<[Lambert; 2]>,
    /// Whether each triangle shows its front.
    fronts: Vec<bool>,
}

impl Light {
    pub(crate) fn new(scene: &Scene, quantised: &Quantised) -> Self {
        let [u, v, n, _] = scene.view;
        let lamp = |towards: [f64; 3]| {
            let world = [0, 1, 2].map(|i| u[i] * towards[0] + v[i] * towards[1] + n[i] * towards[2]);
            let [x, y, z] = world.map(|c| c as f32);
            Lambert::new(&quantised.model, Vector3::from_f32(x, y, z).ok()?, 0).ok()
        };
        let lamps = lamp(KEY).zip(lamp(FILL)).map(|(key, fill)| [key, fill]);
        let points: Vec<_> = scene.vertices.iter().map(|&v| scene.clip(v)).collect();
        // Determinant of the rows (x, y, w): positive where the corners run counter-clockwise on the screen, for any sign of w.
        let front = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|corner| points[corner]).map(|[x, y, _, w]| [x, y, w]);
            determinant([a, b, c]) > 0.0
        };
        // A model matrix that mirrors reverses the order of corners, but not the normals.
        let mirrors = determinant([0, 1, 2].map(|i| [0, 1, 2].map(|k| scene.model[i][k]))) < 0.0;
        let front = |t: &[usize; 3]| front(t) != mirrors;
        Self { lamps, fronts: scene.triangles.iter().map(front).collect() }
    }

    /// Light levels at the corners of a triangle, on its visible side; 256 is full.
    pub(crate) fn corners(&self, triangle: usize, normals: &[[[i16; 3]; 3]]) -> [u16; 3] {
        let (Some(lamps), Some(normals)) = (&self.lamps, normals.get(triangle)) else { return [256; 3] };
        let front = self.fronts.get(triangle).copied().unwrap_or(true);
        normals.map(|normal| {
            let normal = if front { normal } else { normal.map(|c| -c) };
            let [key, fill] = [&lamps[0], &lamps[1]].map(|lamp| u32::from(lamp.level(normal)));
            (AMBIENT + ((KEY_LEVEL * key + FILL_LEVEL * fill) >> 8)).min(256) as u16
        })
    }
}

fn determinant([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> f64 {
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}
