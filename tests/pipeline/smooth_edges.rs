//! Smoothed edges, against 16 × 16 samples of each pixel by an oracle that interpolates in f64.

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use pinhole::{bands::SmoothFrame, draw::SmoothEdge, prelude::*, shading::Gouraud};
use support::bridge;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::solids::{self, Solid};

/// A solid, its grey levels, and how they are interpolated.
struct Scene {
    name: &'static str,
    solid: Solid,
    model: ModelBits,
    is_smooth: bool,
    /// The brightness of each body of twelve faces, in per cent; 100 if it is not listed.
    tints: &'static [u8],
}

fn scenes() -> Vec<Scene> {
    let turn = |y: f64, x: f64| {
        let angle = |degrees: f64| (degrees / 360.0 * 4_294_967_296.0) as u32;
        ModelBits(vec![Step::Y(angle(y)), Step::X(angle(x))])
    };
    let scene = |name, solid, model| Scene { name, solid, model, is_smooth: false, tints: &[] };
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

fn camera(width: u32, height: u32) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, 0, 9 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 29, (width, height), ONE, 30 * ONE),
        viewport: (0, 0, width, height),
    }
}

impl Scene {
    fn mesh<'a>(&'a self, beside: &'a [[u16; 2]]) -> Mesh<'a> {
        Mesh::new(&self.solid.vertices, self.solid.exponent, &self.solid.faces)
            .and_then(|mesh| mesh.with_edges(&self.solid.edges))
            .and_then(|mesh| mesh.with_edge_faces(beside))
            .expect("a mesh")
    }

    /// The level of each face, lit by its normal, and of each vertex.
    fn levels(&self) -> (Vec<u8>, Vec<u16>) {
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

const BACKGROUND: u8 = 170;

fn grey(level: u8) -> Rgb888 {
    Rgb888::new(level, level, level)
}

/// A picture, its pixels that an edge crosses, and the means of their samples.
struct Reference {
    means: Vec<f64>,
    is_edge: Vec<bool>,
}

/// The picture with 16 × 16 samples a pixel. `vertices`: x, y and depth on the screen.
fn reference(scene: &Scene, vertices: &[[f64; 3]], width: usize, height: usize) -> Reference {
    const SIDE: usize = 16;
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

/// The picture without and with smoothed edges.
fn pictures(scene: &Scene, instance: &MeshInstance<'_>, width: u32, height: u32) -> [Vec<Rgb888>; 2] {
    let count = (width * height) as usize;
    let area = bridge::rectangle(0, 0, width, height);
    let (mut cells, mut depths) = (vec![grey(BACKGROUND); count], vec![0; count]);
    let mut depth = DepthBuffer::new(area, &mut depths).expect("room");
    let mut picture = Picture::new(&mut cells, area.size).expect("room");
    let mesh = instance.mesh();
    let (mut cache, mut bins) =
        (vec![ScreenVertex::EMPTY; mesh.cache_len()], vec![0; mesh.smooth_bins_len()]);
    let (faces, corners) = scene.levels();
    let mut target = picture.pixels();
    if scene.is_smooth {
        let shade =
            |face: usize| Gouraud::new(mesh.faces()[face].map(|i| grey(corners[usize::from(i)] as u8)));
        let Ok(_) = instance.faces(shade).draw(&mut target.depth_tested(&mut depth));
    } else {
        let Ok(_) = instance.faces(|face| grey(faces[face])).draw(&mut target.depth_tested(&mut depth));
    }
    let plain = picture.colors().to_vec();
    let transformed = instance.transform_depth(&mut cache);
    let mut edges = transformed.bin_smooth_edges(|_| !scene.is_smooth, &mut bins, &mut []).expect("room");
    picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    [plain, picture.colors().to_vec()]
}

/// Root mean square of the errors over edge pixels; the share of edge pixels more than 20 levels off, in per cent; and the pixels that
/// smoothing made worse by more than 8 levels.
fn errors(reference: &Reference, [plain, smooth]: &[Vec<Rgb888>; 2]) -> ([f64; 2], f64, usize) {
    let edge = |i: &usize| reference.is_edge[*i];
    let off = |picture: &[Rgb888], i: usize| (f64::from(picture[i].r()) - reference.means[i]).abs();
    let edges: Vec<usize> = (0..plain.len()).filter(edge).collect();
    let rms = |picture: &[Rgb888]| {
        (edges.iter().map(|&i| off(picture, i).powi(2)).sum::<f64>() / edges.len() as f64).sqrt()
    };
    let far = edges.iter().filter(|&&i| off(smooth, i) > 20.0).count();
    let worse = (0..plain.len()).filter(|&i| off(smooth, i) > off(plain, i) + 8.0).count();
    ([rms(plain), rms(smooth)], 100.0 * far as f64 / edges.len() as f64, worse)
}

/// The scene in bands, each in a strip of this many rows.
fn in_bands(scene: &Scene, instance: &MeshInstance<'_>, [width, height]: [u32; 2], rows: u32) -> Vec<Rgb888> {
    let (area, mesh) = (bridge::rectangle(0, 0, width, height), instance.mesh());
    let (mut cache, mut bins) = (vec![ScreenVertex::EMPTY; mesh.cache_len()], vec![0; mesh.face_bins_len()]);
    let (mut edge_bins, colors) = (vec![0; mesh.smooth_bins_len()], scene.levels().0);
    let transformed = instance.transform_depth(&mut cache);
    let mut faces = transformed.bin_faces(&mut bins).expect("room");
    let mut list = vec![SmoothEdge::EMPTY; rows as usize % 16];
    let mut edges = transformed.bin_smooth_edges(|_| true, &mut edge_bins, &mut list).expect("room");
    let storage =
        |rows: u32| (vec![0; Frame::<Rgb888>::strip_bytes(width, rows)], vec![0; (width * rows) as usize]);
    let ((mut strip, mut depths), (mut kept, _)) = (storage(rows), storage(1));
    // The second frame begins again with all edges.
    let [first, second] = [0; 2].map(|_| {
        let mut frame = SmoothFrame::new(area, grey(BACKGROUND), &mut kept, &mut depths).expect("room");
        let mut picture = Vec::new();
        while let Some(mut band) = frame.next_band(&mut strip).expect("room") {
            let (mut pixels, mut depth) = band.new_rows();
            let Ok(()) = faces.draw(|face| grey(colors[face]), &mut pixels.depth_tested(&mut depth));
            let band = band.smooth(|pass| edges.draw(pass));
            assert_eq!((band.area().top_left.y as usize) * width as usize, picture.len());
            picture.extend(band.colors());
        }
        picture
    });
    assert!(first == second);
    first
}

#[test]
fn bands_are_smoothed_as_one_piece() {
    for scene in scenes().into_iter().filter(|scene| !scene.is_smooth) {
        let beside = scene.solid.edge_faces();
        let mesh = scene.mesh(&beside);
        for size in [[128, 64], [61, 77]] {
            let (camera, model) = (camera(size[0], size[1]).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let [plain, whole] = pictures(&scene, &instance, size[0], size[1]);
            assert_ne!(plain, whole);
            for rows in [3, 4, 5, 8, 9, 32, 100] {
                assert!(in_bands(&scene, &instance, size, rows) == whole, "{} {size:?} {rows}", scene.name);
            }
        }
    }
}

/// Edges that are drawn in the second pass alone mix no other pixels than neighbours in a column, of which the upper one has an odd row.
#[test]
fn the_second_pass_mixes_its_pairs() {
    let scene = &scenes()[1];
    let (beside, [width, height]) = (scene.solid.edge_faces(), [128, 64]);
    let (mesh, camera, model) = (scene.mesh(&beside), camera(width, height).library(), scene.model.library());
    let instance = camera.place(&mesh, &model);
    let [plain, _] = pictures(scene, &instance, width, height);
    let (mut cache, mut bins) =
        (vec![ScreenVertex::EMPTY; mesh.cache_len()], vec![0; mesh.smooth_bins_len()]);
    let (mut cells, mut depths) = (plain.clone(), vec![0; plain.len()]);
    let mut depth = DepthBuffer::new(bridge::rectangle(0, 0, width, height), &mut depths).expect("room");
    instance.depth_only(&mut cache, &mut depth);
    let transformed = instance.transform_depth(&mut cache);
    let mut picture = Picture::new(&mut cells, Size::new(width, height)).expect("room");
    let mut edges = transformed.bin_smooth_edges(|_| true, &mut bins, &mut []).expect("room");
    let mut passes = 0;
    picture.pixels().depth_tested(&mut depth).smooth(|pass| {
        if passes == 1 {
            edges.draw(pass);
        }
        passes += 1;
    });
    assert!(cells.iter().zip(&plain).filter(|(cell, plain)| cell != plain).count() > 100);
    let width = width as usize;
    for (at, cell) in cells.iter().enumerate() {
        let beyond = if at / width % 2 == 1 { at + width } else { at.wrapping_sub(width) };
        let pair = [plain[at], *plain.get(beyond).unwrap_or(&plain[at])].map(|color| color.r());
        assert!((pair[0].min(pair[1])..=pair[0].max(pair[1])).contains(&cell.r()), "{at} {pair:?} {cell:?}");
    }
}

#[test]
fn smoothed_edges_are_close_to_their_areas() {
    for scene in scenes() {
        let beside = scene.solid.edge_faces();
        let mesh = scene.mesh(&beside);
        for (width, height) in [(240, 240), (128, 64)] {
            let (camera, model) = (camera(width, height).library(), scene.model.library());
            let instance = camera.place(&mesh, &model);
            let exact =
                |i| instance.project_unsnapped(i).expect("in view").map(|v| v as f64 / 4_294_967_296.0);
            let vertices: Vec<[f64; 3]> = (0..scene.solid.vertices.len()).map(exact).collect();
            let reference = reference(&scene, &vertices, width as usize, height as usize);
            let pictures = pictures(&scene, &instance, width, height);
            let (rms, far, worse) = errors(&reference, &pictures);
            println!("{} {width} × {height}: {rms:.1?}, {far:.1} % off by 20, {worse} worse", scene.name);
            // Levels; per cent of the edge pixels; pixels.
            let [most, most_far, most_worse] =
                if height == 240 { [5.0, 1.2, 32.0] } else { [9.2, 4.0, 90.0] };
            assert!(rms[1] < most && 2.0 * rms[1] < rms[0] && far < most_far && worse as f64 <= most_worse);
        }
    }
}
