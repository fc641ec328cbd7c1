//! The error of textures: the coordinates that pixels show, against rays in f64, beside methods of other libraries.

mod costs;
mod methods;
mod scenes;
#[path = "../../../../bench/src/cells/stepped.rs"]
mod stepped;

use super::errors::{decimal, rounded, Errors};
use crate::oracle::chain;
use crate::oracle::texture::{off_repeated, Ray};
use methods::{Shown, METHODS, TEXELS};
use pinhole::space::{Model, World};
use pinhole::{Affine, Mesh};
use scenes::{Scene, CAMERA};
use serde_json::{json, Value};

/// The error that [`pinhole::Texture`] documents in addition to the accuracy, for faces without a corner close to the eye.
const PLANES: f64 = 0.02;

/// The errors of a scene by each method.
pub(super) struct Measured {
    scene: Scene,
    /// In texels, beyond a shift of 1/64 pixel.
    errors: [Errors; METHODS.len()],
    /// Percent of the pixels that show another texel than the ray's.
    others: [f64; METHODS.len()],
    /// Instructions of a frame on an M3, if the benchmark has the scene.
    costs: Option<[f64; METHODS.len()]>,
}

pub(super) fn measure() -> Result<Vec<Measured>, String> {
    let one = |scene: Scene| {
        let costs = scene.cell.map(costs::of_scene).transpose()?;
        Measured::new(scene, costs).map_err(|error| error.to_string())
    };
    scenes::all().into_iter().map(one).collect()
}

impl Measured {
    fn new(scene: Scene, costs: Option<[f64; METHODS.len()]>) -> Result<Self, pinhole::MeshError> {
        let (camera, exact) = (CAMERA.library(), CAMERA.exact());
        let mut measured = Self { scene, errors: Default::default(), others: [0.0; METHODS.len()], costs };
        for (corners, uv) in &measured.scene.faces {
            let mesh = Mesh::new(corners, measured.scene.exponent, &[[0, 1, 2]])?;
            let instance =
                camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(measured.scene.cull);
            let at = corners.map(|corner| chain::vertex(corner, measured.scene.exponent));
            let texels = uv.map(|uv| uv.map(|c| f64::from(c) / 16.0));
            let ray = Ray::new(&exact, &chain::IDENTITY, at, texels);
            for (i, (.., draw)) in METHODS.into_iter().enumerate() {
                for (point, Shown(shown)) in draw(&instance, *uv) {
                    let (x, y) = (i64::from(point.x), i64::from(point.y));
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
        for (others, errors) in measured.others.iter_mut().zip(&mut measured.errors) {
            *others *= 100.0 / errors.count().max(1) as f64;
            errors.sort();
        }
        Ok(measured)
    }

    /// Instructions for each of the pixels that a method, by its place in [`METHODS`], draws.
    fn per_pixel(&self, method: usize) -> Option<f64> {
        Some(self.costs?.get(method)? / self.errors.get(method)?.count() as f64)
    }

    /// A row of data for each method.
    pub(super) fn rows(&self) -> impl Iterator<Item = Value> + '_ {
        METHODS.into_iter().enumerate().map(|(i, (method, ..))| {
            json!({"error": "texture, texels", "scene": self.scene.name, "about": self.scene.about, "method": method,
                "beyond_1/64_px": self.errors[i].figures(), "other_texel_percent": rounded(self.others[i]),
                "instructions_per_pixel": self.per_pixel(i).map(rounded)})
        })
    }

    /// A line of the page.
    pub(super) fn line(&self) -> String {
        let cells = self.errors.iter().enumerate().map(|(i, errors)| {
            let cost = self.per_pixel(i).map_or(String::new(), |cost| format!("; {cost:.0}"));
            format!(" {}{cost} |", decimal(errors.largest()))
        });
        format!("| {}: {} |{}\n", self.scene.name, self.scene.about, cells.collect::<String>())
    }

    /// A bound that does not hold.
    pub(super) fn broken(&self) -> Option<String> {
        METHODS.iter().zip(&self.errors).find_map(|((name, accuracy, _), errors)| {
            let (largest, bound) = (errors.largest(), (*accuracy)? + PLANES);
            let scene = self.scene.name;
            (largest > bound).then(|| format!("{scene}, {name}: {largest} texels off, the bound is {bound}"))
        })
    }
}
