//! Scenes whose edges are smoothed, and their pictures by 16 × 16 samples a pixel.

use crate::bridge;
use crate::bridge::pair::{CameraBits, ModelBits, Step, ViewBits, ONE};
use crate::solids::{self, Solid};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{prelude::*, shading::Gouraud};

/// A solid, its grey levels, and how they are interpolated.
pub struct Scene {
    pub name: &'static str,
    pub solid: Solid,
    /// The faces beside its edges.
    beside: Vec<[u16; 2]>,
    pub model: ModelBits,
    pub is_smooth: bool,
    /// The brightness of each body of twelve faces, in per cent; 100 if it is not listed.
    tints: &'static [u8],
}

pub fn scenes() -> Vec<Scene> {
    let turn = |y: f64, x: f64| {
        let angle = |degrees: f64| (degrees / 360.0 * 4_294_967_296.0) as u32;
        ModelBits(vec![Step::Y(angle(y)), Step::X(angle(x))])
    };
    let scene = |name, solid: Solid, model| {
        let beside = solid.edge_faces();
        Scene { name, solid, beside, model, is_smooth: false, tints: &[] }
    };
    vec![
        scene("cube", solids::cube(), turn(33.0, 27.0)),
        scene("torus", solids::torus(25, 20), turn(20.0, 50.0)),
        Scene { is_smooth: true, ..scene("smooth torus", solids::torus(25, 20), turn(20.0, 50.0)) },
        scene("gear", solids::gear(), turn(25.0, 48.0)),
        // Meadow, wall, chimney, door, windows, rail, mast, trunk and tree; then posts and the roof.
        Scene {
            tints: &[50, 85, 40, 30, 45, 45, 95, 25, 45, 40],
            ..scene("house", solids::house(), turn(-40.4, 13.1))
        },
    ]
}

pub fn camera(width: u32, height: u32) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, 0, 9 * ONE], [0; 3], [0, ONE, 0]),
        ..CameraBits::perspective(1 << 29, (width, height), ONE, 30 * ONE)
    }
}

impl Scene {
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh::new(&self.solid.vertices, self.solid.exponent, &self.solid.faces)
            .and_then(|mesh| mesh.with_edges(&self.solid.edges))
            .and_then(|mesh| mesh.with_edge_faces(&self.beside))
            .expect("a mesh")
    }

    /// The level of each face, lit by its normal, and of each vertex.
    pub fn levels(&self) -> (Vec<u8>, Vec<u16>) {
        let light = |normal: [f64; 3]| {
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt().max(1.0);
            let along: f64 = normal.iter().zip([0.4, 0.6, 0.69]).map(|(n, l)| n * l).sum();
            48.0 + 207.0 * (along / length).max(0.0)
        };
        let normals: Vec<[f64; 3]> =
            self.solid.normals().iter().map(|normal| normal.map(f64::from)).collect();
        let mut sums = vec![[0.0; 3]; self.solid.vertices.len()];
        for (face, normal) in self.solid.faces.iter().zip(&normals) {
            for &corner in face {
                (0..3).for_each(|i| sums[usize::from(corner)][i] += normal[i]);
            }
        }
        let tint = |face: usize| f64::from(self.tints.get(face / 12).copied().unwrap_or(100)) / 100.0;
        let faces = (0..).zip(&normals).map(|(face, &normal)| (tint(face) * light(normal)) as u8).collect();
        (faces, sums.into_iter().map(|normal| light(normal) as u16).collect())
    }
}

pub const BACKGROUND: u8 = 170;

/// A contrast that no two levels have: no crease is smoothed.
pub const NO_CREASES: u8 = 255;

pub fn grey(level: u8) -> Rgb888 {
    Rgb888::new(level, level, level)
}

impl Scene {
    /// The least difference of the levels beside a crease that is smoothed; none differs by as much in a scene that is shaded smoothly.
    pub fn contrast(&self) -> u8 {
        if self.is_smooth {
            NO_CREASES
        } else {
            8 // as in `Reference`
        }
    }

    /// The picture by the library; with smoothed silhouettes, and creases between levels that differ by at least `contrast`, if it is given.
    pub fn picture(
        &self,
        instance: &MeshInstance<'_>,
        [width, height]: [u32; 2],
        contrast: Option<u8>,
    ) -> Vec<Rgb888> {
        let count = (width * height) as usize;
        let area = bridge::rectangle(0, 0, width, height);
        let (mut cells, mut depths) = (vec![grey(BACKGROUND); count], vec![0; count]);
        let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
        let mut picture = Picture::new(&mut cells, area.size).expect("room");
        let mesh = instance.mesh();
        let (faces, corners) = self.levels();
        let mut target = picture.pixels();
        if self.is_smooth {
            let shade =
                |face: usize| Gouraud::new(mesh.faces()[face].map(|i| grey(corners[usize::from(i)] as u8)));
            let Ok(_) = instance.faces(shade).draw(&mut target.depth_tested(&mut depth));
        } else {
            let Ok(_) = instance.faces(|face| grey(faces[face])).draw(&mut target.depth_tested(&mut depth));
        }
        if let Some(contrast) = contrast {
            let (mut cache, mut bins) =
                (vec![ScreenVertex::EMPTY; mesh.vertices().len()], vec![0; mesh.smooth_bins_len()]);
            let transformed = instance.transform_depth(&mut cache);
            let level = |face: u16| faces.get(usize::from(face)).copied().unwrap_or(NO_CREASES);
            let beside = &self.beside;
            let is_crease = |edge: usize| level(beside[edge][0]).abs_diff(level(beside[edge][1])) >= contrast;
            let mut edges = transformed.bin_smooth_edges(is_crease, &mut bins).expect("room");
            picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
        }
        picture.colors().to_vec()
    }
}

/// The means of the samples of a picture's pixels, and which pixels have samples of different levels.
pub struct Reference {
    pub means: Vec<f64>,
    pub is_edge: Vec<bool>,
}

/// The picture with 16 × 16 samples a pixel.
pub fn reference(scene: &Scene, instance: &MeshInstance<'_>, [width, height]: [u32; 2]) -> Reference {
    const SIDE: usize = 16;
    // x, y and depth on the screen.
    let exact = |i| instance.project_unsnapped(i).expect("in view").map(|v| v as f64 / 4_294_967_296.0);
    let vertices: Vec<[f64; 3]> = (0..scene.solid.vertices.len()).map(exact).collect();
    let (width, height) = (width as usize, height as usize);
    let (faces, corners) = scene.levels();
    let columns = width * SIDE;
    let (mut means, mut is_edge) = (Vec::new(), Vec::new());
    for y in 0..height {
        let mut samples = vec![(f64::INFINITY, f64::from(BACKGROUND)); columns * SIDE];
        for (number, face) in scene.solid.faces.iter().enumerate() {
            let [a, b, c] = face.map(|i| vertices[usize::from(i)]);
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let (top, bottom) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
            if area >= 0.0 || top > y as f64 + 1.0 || bottom < y as f64 {
                continue; // back faces have a positive area, as y grows downwards
            }
            let levels = match scene.is_smooth {
                true => face.map(|i| f64::from(corners[usize::from(i)])),
                false => [f64::from(faces[number]); 3],
            };
            let at = |x: f64| ((x * SIDE as f64).max(0.0) as usize).min(columns);
            let (left, right) = (at(a[0].min(b[0]).min(c[0])), at(a[0].max(b[0]).max(c[0]) + 0.1));
            for row in 0..SIDE {
                let py = y as f64 + (row as f64 + 0.5) / SIDE as f64;
                for column in left..right {
                    let px = (column as f64 + 0.5) / SIDE as f64;
                    let weight =
                        |p: [f64; 3], q: [f64; 3]| (q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0]);
                    let weights = [weight(b, c), weight(c, a), weight(a, b)].map(|w| w / area);
                    if weights.iter().any(|&w| w < 0.0) {
                        continue;
                    }
                    let mean = |of: [f64; 3]| of.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
                    let depth = mean([a[2], b[2], c[2]]);
                    let sample = &mut samples[row * columns + column];
                    if depth < sample.0 {
                        *sample = (depth, mean(levels));
                    }
                }
            }
        }
        for x in 0..width {
            let of_pixel =
                || (0..SIDE).flat_map(|row| &samples[row * columns + x * SIDE..][..SIDE]).map(|s| s.1);
            means.push(of_pixel().sum::<f64>() / (SIDE * SIDE) as f64);
            let (low, high) =
                of_pixel().fold((255.0_f64, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
            is_edge.push(high - low >= 8.0);
        }
    }
    Reference { means, is_edge }
}

impl Reference {
    /// Root mean square of the errors of a picture over edge pixels; the share of edge pixels more than 20 levels off, in per cent; and the
    /// pixels that are worse than in another picture by more than 8 levels.
    pub fn errors(&self, picture: &[Rgb888], plain: &[Rgb888]) -> (f64, f64, usize) {
        let off = |picture: &[Rgb888], i: usize| (f64::from(picture[i].r()) - self.means[i]).abs();
        let edges = || (0..picture.len()).filter(|&i| self.is_edge[i]);
        let far = edges().filter(|&i| off(picture, i) > 20.0).count();
        let worse = (0..picture.len()).filter(|&i| off(picture, i) > off(plain, i) + 8.0).count();
        let (count, rms) = (edges().count() as f64, self.rms(|i| off(picture, i)));
        (rms, 100.0 * far as f64 / count, worse)
    }

    /// Root mean square of errors over edge pixels.
    pub fn rms(&self, off: impl Fn(usize) -> f64) -> f64 {
        let squares: Vec<f64> =
            (0..self.means.len()).filter(|&i| self.is_edge[i]).map(|i| off(i).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }
}
