//! Light in pictures: the scene's lights, or a lamp at the left of the camera and a weaker one at the right, so that both sides
//! show shape.

use crate::json::Field;
use crate::quantised::Quantised;
use crate::scene::Scene;
use pinhole::{Lambert, Vector3};

/// The lights of a scene. Levels are 0 to 256, which is full.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    pub ambient: u32,
    pub lamps: Vec<Lamp>,
}

/// A light from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// The direction to the lamp.
    pub towards: [f64; 3],
    /// Whether this is a direction of the view, so that the lamp moves with the camera, and not of the world.
    pub is_of_camera: bool,
    pub level: u32,
}

/// The lamps that scenes have without lights of their own.
const NAMED: [(&str, Lamp); 2] = [
    ("key", Lamp { towards: [-0.45, 0.6, 0.66], is_of_camera: true, level: 190 }),
    ("fill", Lamp { towards: [0.8, -0.15, 0.3], is_of_camera: true, level: 48 }),
];
const AMBIENT: u32 = 60;

impl Default for Lights {
    fn default() -> Self {
        Self { ambient: AMBIENT, lamps: NAMED.map(|(_, lamp)| lamp).to_vec() }
    }
}

/// The lights of a scene file: lamps by name, or with a direction and a level, and ambient light. The error names the field.
pub(crate) fn read(list: &Field<'_>) -> Result<Lights, String> {
    let mut lights = Lights { ambient: 0, lamps: Vec::new() };
    for entry in list.list()? {
        if entry.text().is_ok() {
            let names = [("ambient", None), (NAMED[0].0, Some(NAMED[0].1)), (NAMED[1].0, Some(NAMED[1].1))];
            match entry.one_of(&names)? {
                None => lights.ambient += AMBIENT,
                Some(lamp) => lights.lamps.push(lamp),
            }
            continue;
        }
        let [ambient, towards, from, level] = entry.fields(["ambient", "towards", "from", "level"])?;
        let whole = |field: Field<'_>| field.integer(0, 256).map(|level| level as u32);
        match (ambient, towards) {
            (Some(ambient), None) => lights.ambient += whole(ambient)?,
            (None, Some(towards)) => lights.lamps.push(Lamp {
                towards: towards.vector()?,
                is_of_camera: from
                    .map_or(Ok(false), |from| from.one_of(&[("world", false), ("camera", true)]))?,
                level: whole(entry.needed(level, "level")?)?,
            }),
            _ => return Err(entry.error(
                "has neither ambient nor towards, or both: give ambient light, or the direction to a lamp",
            )),
        }
    }
    Ok(lights)
}

pub(crate) struct Light {
    ambient: u32,
    /// Each lamp and its level. None where the model matrix flattens the mesh: its normals have no directions then.
    lamps: Option<Vec<(Lambert, u32)>>,
    /// Whether each triangle shows its front.
    fronts: Vec<bool>,
}

impl Light {
    pub(crate) fn new(scene: &Scene, quantised: &Quantised) -> Self {
        let [u, v, n, _] = scene.view;
        let lamp = |lamp: &Lamp| {
            let [x, y, z] = lamp.towards;
            let world = match lamp.is_of_camera {
                true => [0, 1, 2].map(|i| u[i] * x + v[i] * y + n[i] * z),
                false => lamp.towards,
            };
            let [x, y, z] = world.map(|c| c as f32);
            let lambert = Lambert::new(&quantised.model, Vector3::from_f32(x, y, z).ok()?, 0).ok()?;
            Some((lambert, lamp.level))
        };
        // A model matrix that mirrors reverses the order of corners, but not the normals.
        let mirrors = determinant([0, 1, 2].map(|i| [0, 1, 2].map(|k| scene.model[i][k]))) < 0.0;
        Self {
            ambient: scene.lights.ambient,
            lamps: scene.lights.lamps.iter().map(lamp).collect(),
            fronts: scene.facings().iter().map(|&facing| (facing > 0) != mirrors).collect(),
        }
    }

    /// Light levels at the corners of a triangle, on its visible side; 256 is full.
    pub(crate) fn corners(&self, triangle: usize, normals: &[[[i16; 3]; 3]]) -> [u16; 3] {
        let (Some(lamps), Some(normals)) = (&self.lamps, normals.get(triangle)) else { return [256; 3] };
        let front = self.fronts.get(triangle).copied().unwrap_or(true);
        normals.map(|normal| {
            let normal = if front { normal } else { normal.map(|c| -c) };
            let lit: u32 = lamps.iter().map(|(lamp, level)| level * u32::from(lamp.level(normal))).sum();
            (self.ambient + (lit >> 8)).min(256) as u16
        })
    }
}

fn determinant([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> f64 {
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}
