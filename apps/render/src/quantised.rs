//! Converts a scene to the crate's number formats, and back to numbers of a file.
//!
//! World units are free to choose, so powers of two scale the scene to the range where the formats have most bits: the mesh
//! to ±32768 of its own units, and eye and mesh to within 2¹³ to 2¹⁴ world units. Such scales change exponents alone.

use crate::range;
use crate::scene::Scene;
use crate::sprites::SceneSprites;
use crate::texture::{QuantisedTexture, SceneTexture};
use embedded_graphics::geometry::{Point, Size};
use pinhole::prelude::*;
use pinhole::space::{Model, World};

pub struct Quantised {
    pub vertices: Vec<[Scalar; 3]>,
    pub model: Affine<Model, World>,
    pub viewing: ViewTransform,
    pub texture: Option<QuantisedTexture>,
    projection: Projection,
    viewport: Viewport,
    units: Units,
}

/// Conversion between numbers of the file and of the crate: powers of two, and the point that replaces the origin of a mesh
/// far from its own.
struct Units {
    /// Model coordinates: crate = (file − centre) · 2^mesh.
    mesh: i32,
    centre: [f64; 3],
    /// World and view coordinates: crate = file · 2^world.
    world: i32,
}

impl Quantised {
    /// The scene in the crate's formats, and the numbers of a file that converts to exactly this scene.
    pub fn settle(scene: &Scene) -> Result<(Self, Scene), String> {
        // Rounding may carry a number over a power of two, which changes a unit: then convert again.
        let mut current = scene.clone();
        for _ in 0..8 {
            let quantised = Self::new(&current)?;
            let used = quantised.scene(&current);
            if used == current {
                range::check(scene, &used)?;
                return Ok((quantised, used));
            }
            current = used;
        }
        Err("its numbers round differently each time: use fewer digits".into())
    }

    fn new(scene: &Scene) -> Result<Self, String> {
        let units = Units::of(scene)?;
        let (mesh, world) = (two_to(units.mesh), two_to(units.world));
        let bits = |c: f64, centre: f64| Scalar::from_bits(((c - centre) * mesh * 65_536.0).round() as i32); // by Units
        let [x, y, z] = units.centre;
        let vertices = scene.vertices.iter().map(|v| [bits(v[0], x), bits(v[1], y), bits(v[2], z)]).collect();
        let mut model = scene.model;
        for row in model.iter_mut().take(3) {
            row[3] += row[0] * x + row[1] * y + row[2] * z;
            *row = scaled(row, world / mesh, world);
        }
        let mut view = scene.view;
        for row in view.iter_mut().take(3) {
            row[3] *= world;
        }
        let projection = scene.projection.map(|row| scaled(&row, 1.0 / world, 1.0));
        let [left, top, width, height] = scene.viewport;
        let size = |v: i32| u32::try_from(v).map_err(|_| format!("viewport: {v} is not a width or height"));
        Ok(Self {
            vertices,
            model: Affine::from_matrix(&model).map_err(|e| format!("model: {e}"))?,
            viewing: ViewTransform::from_matrix(&view).map_err(|e| format!("view: {e}"))?,
            projection: Projection::from_matrix(&projection).map_err(|e| format!("projection: {e}"))?,
            viewport: Viewport::new(Point::new(left, top), Size::new(size(width)?, size(height)?))
                .map_err(|e| format!("viewport: {e}"))?,
            texture: scene.texture.as_ref().map(SceneTexture::quantised).transpose()?,
            units,
        })
    }

    /// The scene in numbers of a file. Fields that are not rounded come from `like`.
    fn scene(&self, like: &Scene) -> Scene {
        let Units { mesh, centre, world } = &self.units;
        let (mesh, world) = (two_to(-mesh), two_to(-world));
        let number = |c: Scalar, centre: f64| f64::from(c.to_bits()) / 65_536.0 * mesh + centre;
        let [x, y, z] = *centre;
        let vertices =
            self.vertices.iter().map(|v| [number(v[0], x), number(v[1], y), number(v[2], z)]).collect();
        let mut model = self.model.to_matrix();
        for row in model.iter_mut().take(3) {
            *row = scaled(row, world / mesh, world);
            row[3] -= row[0] * x + row[1] * y + row[2] * z;
        }
        let mut view = self.viewing.to_matrix();
        for row in view.iter_mut().take(3) {
            row[3] *= world;
        }
        let projection = self.projection.to_matrix().map(|row| scaled(&row, 1.0 / world, 1.0));
        // Clip coordinates have any scale; this factor gives the last row of a perspective -1.
        let largest = projection[3].iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let factor = if largest > 0.0 { two_to(-largest.log2().ceil() as i32) } else { 1.0 };
        let projection = projection.map(|row| row.map(|c| c * factor));
        let texture = like.texture.as_ref().zip(self.texture.as_ref()).map(|(like, uv)| like.with(uv));
        let rounded = |c: f64| f64::from(self.distance(c).to_bits()) / 65_536.0 * world;
        let sprites = like.sprites.iter().map(|entry| entry.map_numbers(rounded)).collect();
        Scene { vertices, model, view, projection, texture, sprites, ..like.clone() }
    }

    /// A distance in the scene's units in the crate's; the largest or smallest number for one beyond.
    pub(crate) fn distance(&self, distance: f64) -> Scalar {
        let distance = distance * two_to(self.units.world);
        Scalar::try_from(distance).unwrap_or(if distance < 0.0 { Scalar::MIN } else { Scalar::MAX })
    }

    /// A point of the world in the crate's numbers.
    pub(crate) fn point(&self, point: [f64; 3]) -> Point3<World> {
        let [x, y, z] = point.map(|c| self.distance(c));
        Point3::new(x, y, z)
    }

    pub fn camera(&self) -> Camera {
        Camera::new(&self.viewing, &self.projection, &self.viewport)
    }
}

impl Units {
    fn of(scene: &Scene) -> Result<Self, String> {
        let (low, high) = scene.bounds();
        let half = (0..3).map(|i| high[i] / 2.0 - low[i] / 2.0).fold(0.0, f64::max);
        let farthest = low.iter().chain(&high).fold(0.0f64, |a, b| a.max(b.abs()));
        // Where the mesh's bounding box and the eye are in the world.
        let mut reach = 0f64;
        for row in &scene.model[..3] {
            let (mut middle, mut around) = (row[3], 0.0);
            for i in 0..3 {
                middle += row[i] * f64::midpoint(low[i], high[i]);
                around += (row[i] * (high[i] - low[i]) / 2.0).abs();
            }
            reach = reach.max(middle.abs() + around);
        }
        let [u, v, n, _] = &scene.view;
        for ((x, y), z) in u.iter().zip(v).zip(n).take(3) {
            reach = reach.max((x * u[3] + y * v[3] + z * n[3]).abs());
        }
        let sprites = scene.sprites.iter().flat_map(SceneSprites::world_numbers);
        let farthest_sprite = sprites.fold(0.0f64, |a, b| a.max(b.abs()));
        let reaches = [
            (half, "vertices"),
            (farthest, "vertices"),
            (reach, "model or view"),
            (farthest_sprite, "sprites"),
        ];
        let reach = reach.max(farthest_sprite);
        for (value, field) in reaches {
            if value != 0.0 && !(1e-100..1e100).contains(&value) {
                return Err(format!("{field}: {value:e} is out of range"));
            }
        }
        // A mesh far from its own origin would lose bits to the distance.
        let centre = if farthest > 256.0 * half && half > 0.0 {
            // The centre lies on a grid so coarse that rounding the mesh does not move it.
            let grid = two_to(exponent(half) + 2);
            [0, 1, 2].map(|i| (f64::midpoint(low[i], high[i]) / grid).round() * grid)
        } else {
            [0.0; 3]
        };
        let from_centre = |i: usize| (high[i] - centre[i]).abs().max((low[i] - centre[i]).abs());
        let largest = (0..3).map(from_centre).fold(0.0, f64::max);
        let mut mesh = 14 - exponent(largest);
        if (largest * two_to(mesh) * 65_536.0).round() > f64::from(i32::MAX) {
            mesh -= 1;
        }
        // Fog may end beyond the scene, at a distance that fits the format.
        let fog = scene.fog.and_then(|fog| fog.range).unwrap_or_default();
        let farthest_fog = fog[0].abs().max(fog[1].abs());
        let world = match farthest_fog > 0.0 {
            true => (13 - exponent(reach)).min(14 - exponent(farthest_fog)),
            false => 13 - exponent(reach),
        };
        Ok(Self { mesh, centre, world })
    }
}

/// Scales the first three coefficients by `linear`, the last by `constant`, both powers of two.
fn scaled(row: &[f64; 4], linear: f64, constant: f64) -> [f64; 4] {
    [row[0] * linear, row[1] * linear, row[2] * linear, row[3] * constant]
}

/// `⌊log₂ v⌋`; 0 for 0.
fn exponent(v: f64) -> i32 {
    if v == 0.0 {
        return 0;
    }
    let mut exponent = v.log2().floor() as i32;
    // log2 may round up to the next integer.
    while two_to(exponent) > v {
        exponent -= 1;
    }
    while two_to(exponent + 1) <= v {
        exponent += 1;
    }
    exponent
}

fn two_to(exponent: i32) -> f64 {
    2f64.powi(exponent)
}

/// The largest distance by which rounding to the crate's formats moves a vertex: as a fraction of the mesh's extent, and in
/// pixels.
pub fn moved(scene: &Scene, used: &Scene) -> (f64, f64) {
    let (mut largest, mut pixels) = (0f64, 0f64);
    for (&a, &b) in scene.vertices.iter().zip(&used.vertices) {
        largest = (0..3).map(|i| (a[i] - b[i]).abs()).fold(largest, f64::max);
        let (a, b) = (scene.clip(a), used.clip(b));
        let seen = |p: &[f64; 4]| p[3] > 0.0 && p[2].abs() <= p[3];
        if seen(&a) && seen(&b) {
            let (a, b) = (scene.screen(a), used.screen(b));
            if a.iter().chain(&b).all(|c| c.abs() <= 8192.0) {
                pixels = pixels.max((a[0] - b[0]).hypot(a[1] - b[1]));
            }
        }
    }
    let extent = scene.extent();
    (if extent > 0.0 { largest / extent } else { 0.0 }, pixels)
}
