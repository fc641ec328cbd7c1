//! Light in pictures: the scene's lights, or a lamp at the left of the camera and a weaker one at the right, so that both sides
//! show shape; and the normals that it falls on, smooth over round shapes, but not over sharp edges.

use crate::camera::cross;
use crate::json::{self, Whole};
use crate::quantised::Quantised;
use crate::scene::Scene;
use pinhole::{
    light::{Lambert, Light as _},
    Vector3,
};
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashMap;

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

/// An entry of a scene's `"lights"` that is no name.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    ambient: Option<Whole<0, 256>>,
    towards: Option<[f64; 3]>,
    from: Option<Axes>,
    level: Option<Whole<0, 256>>,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Axes {
    World,
    Camera,
}

/// The lights of a scene file: lamps by name, or with a direction and a level, and ambient light. The error names the field.
pub(crate) fn read(entries: Vec<Value>) -> Result<Lights, String> {
    let mut lights = Lights { ambient: 0, lamps: Vec::new() };
    for (index, entry) in entries.into_iter().enumerate() {
        let place = format!("lights[{index}]");
        if let Some(name) = entry.as_str() {
            match NAMED.iter().find(|(known, _)| *known == name) {
                Some((_, lamp)) => lights.lamps.push(*lamp),
                None if name == "ambient" => lights.ambient += AMBIENT,
                None => return Err(format!("{place}: {name} is not one of ambient, key, fill")),
            }
            continue;
        }
        match json::field(entry, &place)? {
            Entry { ambient: Some(ambient), towards: None, .. } => lights.ambient += ambient.0 as u32,
            Entry { ambient: None, towards: Some(towards), from, level: Some(level) } => lights
                .lamps
                .push(Lamp { towards, is_of_camera: from == Some(Axes::Camera), level: level.0 as u32 }),
            _ => {
                return Err(format!(
                "{place}: is neither {{\"ambient\": LEVEL}} nor {{\"towards\": [x, y, z], \"level\": LEVEL}}"
            ))
            }
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

/// A unit normal in 2⁻¹⁵ for each corner of each triangle: the mean of the normals of the faces around the vertex that differ
/// from this face's by at most `crease` degrees, weighted by their angles at the vertex. 0 makes every face flat, 180 makes
/// all edges smooth. The normal is zero for triangles without area.
///
/// Weights: Thürmer and Wüthrich, *Computing vertex normals from polygonal facets*, 1998.
pub(crate) fn normals(vertices: &[[f64; 3]], triangles: &[[usize; 3]], crease: f64) -> Vec<[[i16; 3]; 3]> {
    let faces: Vec<[f64; 3]> = triangles.iter().map(|t| normal(t.map(|i| vertices[i]))).collect();
    let place = |index: usize| vertices[index].map(|c| (c + 0.0).to_bits());
    let mut around = HashMap::<_, Vec<(usize, f64)>>::new();
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        for [at, to, from] in [[a, b, c], [b, c, a], [c, a, b]] {
            let angle = angle(vertices[at], vertices[to], vertices[from]);
            around.entry(place(at)).or_default().push((number, angle));
        }
    }
    // A face turns by nothing from itself, roughly. Beyond 154 degrees, whatever the crease, it is the back of a face in a
    // two-sided surface, and the normal of one side must not cancel that of the other.
    let least = crease.to_radians().cos().max(-0.9) - 1e-9;
    let smooth = |number: usize, index: usize| {
        let mut sum = [0.0; 3];
        for &(other, angle) in &around[&place(index)] {
            if dot(faces[number], faces[other]) >= least {
                sum = [0, 1, 2].map(|i| sum[i] + angle * faces[other][i]);
            }
        }
        let sum = unit(sum);
        short(if sum == [0.0; 3] { faces[number] } else { sum })
    };
    triangles.iter().enumerate().map(|(number, t)| t.map(|index| smooth(number, index))).collect()
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    unit(cross(minus(b, a), minus(c, a)))
}

/// The angle at a corner, between the directions to the other two.
fn angle(at: [f64; 3], to: [f64; 3], from: [f64; 3]) -> f64 {
    dot(unit(minus(to, at)), unit(minus(from, at))).clamp(-1.0, 1.0).acos()
}

pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Scales a vector to length 1; zero stays zero.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| if length > 0.0 { c / length } else { 0.0 })
}

fn short(v: [f64; 3]) -> [i16; 3] {
    v.map(|c| (c * 32_767.0).round() as i16)
}
