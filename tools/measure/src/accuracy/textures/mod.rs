//! The error of textures: the coordinates that pixels show, against rays in f64.

mod scenes;

use super::{rounded, Errors};
use crate::bridge::texels::{Numbered, Shown};
use crate::oracle::chain;
use crate::oracle::target::Screen;
use crate::oracle::texture::{off_repeated, Ray};
use pinhole::space::{Model, World};
use pinhole::{prelude::*, texture::Accuracy};
use scenes::{Scene, CAMERA, SIDE};
use serde_json::{json, Value};

/// The benchmark's variant of each accuracy, and what it allows.
const ACCURACIES: [(&str, Accuracy, f64); 3] = [
    ("plain", Accuracy::Quarter, 0.25),
    ("eighth", Accuracy::Eighth, 0.125),
    ("sixteenth", Accuracy::Sixteenth, 0.0625),
];
/// The side of the texture, in texels.
const TEXELS: f64 = 64.0;
/// The error that [`pinhole::texture::Texture`] documents in addition to the accuracy, for faces without a corner close to the eye.
const PLANES: f64 = 0.02;

/// The errors of a scene by each accuracy.
pub(super) struct Measured {
    scene: Scene,
    /// In texels, beyond a shift of 1/64 pixel.
    errors: [Errors; ACCURACIES.len()],
    /// Percent of the pixels that show another texel than the ray's.
    others: [f64; ACCURACIES.len()],
}

pub(super) fn measure() -> Result<Vec<Measured>, String> {
    scenes::all().into_iter().map(|scene| Measured::new(scene).map_err(|error| error.to_string())).collect()
}

impl Measured {
    fn new(scene: Scene) -> Result<Self, pinhole::mesh::MeshError> {
        let (camera, exact) = (CAMERA.library(), CAMERA.exact());
        let mut measured = Self { scene, errors: Default::default(), others: [0.0; ACCURACIES.len()] };
        for (corners, uv) in &measured.scene.faces {
            let mesh = Mesh::new(corners, measured.scene.exponent, &[[0, 1, 2]])?;
            let instance =
                camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(measured.scene.cull);
            let at = corners.map(|corner| chain::vertex(corner, measured.scene.exponent));
            let texels = uv.map(|uv| uv.map(|c| f64::from(c) / 16.0));
            let ray = Ray::new(&exact, &chain::IDENTITY, at, texels);
            for (i, (_, accuracy, _)) in ACCURACIES.into_iter().enumerate() {
                let texture = Texture::new(Numbered([6, 6])).with_accuracy(accuracy).at(*uv);
                let mut screen = Screen::sized(SIDE, SIDE);
                let Ok(_) = instance.faces(|_| texture).draw(&mut screen);
                for (at, Shown(shown)) in screen.drawn() {
                    let (x, y) = (at.x.into(), at.y.into());
                    let near = ray.around(x, y).zip(ray.at(x as f64 + 0.5, y as f64 + 0.5));
                    let Some((near, centre)) = near else { continue };
                    let shown = shown.map(|c| f64::from(c) / 2f64.powi(32) * TEXELS);
                    let off = [0, 1].map(|axis| off_repeated(shown[axis], near[axis], TEXELS));
                    measured.errors[i].add(off[0].max(off[1]).max(0.0));
                    let is_other =
                        (0..2).any(|axis| shown[axis].floor() != centre[axis].rem_euclid(TEXELS).floor());
                    measured.others[i] += f64::from(u8::from(is_other));
                }
            }
        }
        for (others, errors) in measured.others.iter_mut().zip(&measured.errors) {
            *others *= 100.0 / errors.count().max(1) as f64;
        }
        Ok(measured)
    }

    /// A row of data for each accuracy.
    pub(super) fn rows(&self) -> impl Iterator<Item = Value> + '_ {
        let Scene { name, about, cell, .. } = self.scene;
        ACCURACIES.into_iter().enumerate().map(move |(i, (variant, ..))| {
            json!({"error": "texture, texels", "scene": name, "about": about, "variant": variant, "cell": cell,
                "pixels": self.errors[i].count(), "beyond_1/64_px": self.errors[i].figures(),
                "other_texel_percent": rounded(self.others[i])})
        })
    }

    /// A bound that does not hold.
    pub(super) fn broken(&self) -> Option<String> {
        ACCURACIES.iter().zip(&self.errors).find_map(|((name, _, accuracy), errors)| {
            let (largest, bound) = (errors.largest(), accuracy + PLANES);
            let scene = self.scene.name;
            (largest > bound).then(|| format!("{scene}, {name}: {largest} texels off, the bound is {bound}"))
        })
    }
}
