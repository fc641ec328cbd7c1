//! Hidden-line removal, with one bit per pixel, against an oracle that tests every face.

#[allow(dead_code, unreachable_pub)]
use support::teapot;

use embedded_graphics_core::pixelcolor::BinaryColor;
use pinhole::{DepthBuffer, Frame, Mesh, MeshInstance, ScreenVertex};
use std::collections::{BTreeMap, BTreeSet};
use support::bridge;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle;
use support::oracle::hidden::{self, Vertex};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

/// A solid whose edges are drawn.
struct Solid {
    vertices: Vec<[i16; 3]>,
    exponent: i8,
    faces: Vec<[u16; 3]>,
    edges: Vec<[u16; 2]>,
}

impl Solid {
    fn new(vertices: Vec<[i16; 3]>, exponent: i8, faces: Vec<[u16; 3]>) -> Self {
        let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edges: BTreeSet<[u16; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        Self { vertices, exponent, faces, edges: edges.into_iter().collect() }
    }

    /// The faces adjacent to each edge, by a map instead of the library's search.
    fn edge_faces(&self) -> Vec<[u16; 2]> {
        let mut beside = BTreeMap::<[u16; 2], Vec<u16>>::new();
        for (number, &[a, b, c]) in self.faces.iter().enumerate() {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                beside.entry([a.min(b), a.max(b)]).or_default().push(number as u16);
            }
        }
        // An edge that is listed again gets the next two faces.
        let mut listed = BTreeMap::<[u16; 2], usize>::new();
        let pair = |edge: &[u16; 2]| {
            let times = listed.entry(*edge).or_default();
            *times += 2;
            [*times - 2, *times - 1].map(|i| beside[edge].get(i).copied().unwrap_or(Mesh::<i16>::NO_FACE))
        };
        self.edges.iter().map(pair).collect()
    }
}

fn torus(around: u16, across: u16) -> Solid {
    let turn = |i: u16, n: u16| (f64::from(i) / f64::from(n) * core::f64::consts::TAU).sin_cos();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for i in 0..around {
        let (s, c) = turn(i, around);
        for j in 0..across {
            let (t, d) = turn(j, across);
            let r = 16_000.0 + 7_000.0 * d;
            vertices.push([r * c, 7_000.0 * t, -r * s].map(|v| v as i16));
            let at = |i: u16, j: u16| (i % around) * across + j % across;
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    Solid::new(vertices, -13, faces)
}

fn cube() -> Solid {
    let vertices = bridge::draw::CUBE.map(|v| v.map(|c| c * 16_384)).to_vec();
    let mut solid = Solid::new(vertices, -13, bridge::draw::CUBE_FACES.to_vec());
    solid.edges = bridge::draw::CUBE_EDGES.to_vec(); // no diagonals
    solid
}

fn pot() -> Solid {
    Solid::new(teapot::VERTICES.to_vec(), teapot::EXPONENT - 2, teapot::FACES.to_vec())
}

/// Slender tetrahedra through each other.
fn splinters(rng: &mut Rng) -> Solid {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for _ in 0..25 {
        let first = vertices.len() as u16;
        let at = [0; 3].map(|_| rng.real(-12_000.0, 12_000.0));
        let mut corners = [0; 4].map(|_| [0, 1, 2].map(|i| (at[i] + rng.real(-9_000.0, 9_000.0)) as i16));
        let way = |i: usize, k: usize| f64::from(corners[i][k]) - f64::from(corners[0][k]);
        let [p, q, r] = [1, 2, 3].map(|i| [0, 1, 2].map(|k| way(i, k)));
        if oracle::chain::dot(oracle::chain::cross(p, q), r) < 0.0 {
            corners.swap(1, 2);
        }
        vertices.extend(corners);
        // Outwards where the fourth lies on the positive side of the first three.
        faces.extend([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|f| f.map(|i| first + i)));
    }
    Solid::new(vertices, -13, faces)
}

#[derive(Debug, Default)]
struct Score {
    seen: u32,
    missed: u32,
    drawn: u32,
    /// Pixels that are drawn although the point of the edge is hidden.
    behind: u32,
    /// Pixels that are drawn although a face that is not adjacent to the edge lies before it at the pixel's centre.
    behind_centre: u32,
}

const WIDTH: u32 = 240;
const HEIGHT: u32 = 240;

/// The hidden lines of a mesh: one bit a pixel, 16 rows at a time.
fn in_bands(instance: &MeshInstance<'_>) -> Vec<BinaryColor> {
    let (mesh, mut picture) = (instance.mesh(), Vec::new());
    let mut corners = vec![ScreenVertex::EMPTY; mesh.cache_len()];
    let projected = instance.transform_depth(&mut corners);
    let (mut bin_storage, mut more) = (vec![0; mesh.face_bins_len()], vec![0; mesh.edge_bins_len()]);
    let mut faces = projected.bin_faces(&mut bin_storage).expect("room");
    let mut edges = projected.bin_edges(&mut more).expect("room");
    let mut frame = Frame::new(bridge::rectangle(0, 0, WIDTH, HEIGHT), BinaryColor::Off);
    let mut strip = vec![0; Frame::<BinaryColor>::strip_bytes(WIDTH, 16)];
    let mut storage = vec![0; WIDTH as usize * 16];
    while let Some(mut band) = frame.next_band(&mut strip).expect("a row") {
        let mut depth = DepthBuffer::new(band.area(), &mut storage).expect("storage");
        faces.depth_only(&mut depth);
        let Ok(()) = edges.hidden_line(BinaryColor::On, &mut depth, &mut band);
        picture.extend(band.colors());
    }
    assert_eq!(faces.statistics().clipped + faces.statistics().outside, 0);
    picture
}

fn score(solid: &Solid, camera: &CameraBits, model: &ModelBits) -> Score {
    let beside = solid.edge_faces();
    let mesh = Mesh::new(&solid.vertices, solid.exponent, &solid.faces)
        .and_then(|m| m.with_edges(&solid.edges))
        .and_then(|m| m.with_edge_faces(&beside))
        .expect("a mesh");
    let (library, model) = (camera.library(), model.library());
    let instance = library.place(&mesh, &model);
    let picture = in_bands(&instance);
    // The library finds the faces beside an edge itself, in all of its faces; each edge once.
    let mut once = solid.edges.clone();
    once.dedup();
    let unlisted = Mesh::new(&solid.vertices, solid.exponent, &solid.faces).and_then(|m| m.with_edges(&once));
    assert_eq!(in_bands(&library.place(&unlisted.expect("a mesh"), &model)), picture);
    // Seen: from the snapped vertices, depth as the chain has it before rounding.
    let vertices: Vec<Vertex> = (0..solid.vertices.len())
        .map(|i| {
            let (pinhole::Projected { point, .. }, exact) =
                (instance.project(i).expect("in view"), instance.project_unsnapped(i).expect("in view"));
            [f64::from(point.x()) / 256.0, f64::from(point.y()) / 256.0, exact[2] as f64 / 4_294_967_296.0]
        })
        .collect();
    let turned = |face: &[u16; 3]| {
        let [a, b, c] = face.map(|i| vertices[usize::from(i)]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0.0 // y down
    };
    let front: Vec<[u16; 3]> = solid.faces.iter().copied().filter(turned).collect();
    let (mut seen, mut least) = (BTreeSet::new(), BTreeMap::new());
    for &edge in &solid.edges {
        for sample in hidden::samples(edge, &vertices, &front, WIDTH.into(), HEIGHT.into()) {
            if sample.behind <= 0.0 {
                seen.insert(sample.pixel);
            }
            // Several edges may pass through a pixel: one visible edge is enough.
            let (behind, centre) = least.entry(sample.pixel).or_insert((f64::INFINITY, f64::INFINITY));
            *behind = sample.behind.min(*behind);
            *centre = sample.behind_centre.min(*centre);
        }
    }
    let is_drawn = |&(x, y): &(i64, i64)| picture[y as usize * WIDTH as usize + x as usize].is_on();
    let drawn: Vec<_> = least.iter().filter(|(p, _)| is_drawn(p)).collect();
    assert_eq!(drawn.len(), picture.iter().filter(|c| c.is_on()).count(), "only pixels of edges");
    Score {
        seen: seen.len() as u32,
        missed: seen.iter().filter(|p| !is_drawn(p)).count() as u32,
        drawn: drawn.len() as u32,
        behind: drawn.iter().filter(|(_, (behind, _))| *behind > 2.0).count() as u32,
        behind_centre: drawn.iter().filter(|(_, (_, centre))| *centre > 2.0).count() as u32,
    }
}

fn camera() -> CameraBits {
    CameraBits {
        view: ViewBits::LookAt([0, 0, 11 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 29, (WIDTH, HEIGHT), ONE, 30 * ONE),
        viewport: (0, 0, WIDTH, HEIGHT),
    }
}

#[test]
fn hidden_lines_draw_visible_pixels_and_none_behind_a_face() {
    let mut rng = Rng::new(5);
    let mut all = Score::default();
    let solids = [cube(), torus(25, 20), torus(9, 5), pot(), splinters(&mut rng), splinters(&mut rng)];
    for turn in 0..6 {
        for (number, solid) in solids.iter().enumerate() {
            let model = ModelBits(vec![Step::Y(rng.next() as u32), Step::X(rng.next() as u32)]);
            let score = score(solid, &camera(), &model);
            println!("{number} {turn}: {score:?}");
            all.seen += score.seen;
            all.missed += score.missed;
            all.drawn += score.drawn;
            all.behind += score.behind;
            all.behind_centre += score.behind_centre;
        }
    }
    println!("{all:?}");
    // The documented bounds: 99.8 % of the visible pixels are drawn, at most 0.3 % of the drawn pixels are half hidden by
    // another face, and none is more than two steps behind at its centre.
    assert!(
        all.missed * 500 <= all.seen && all.behind * 333 <= all.drawn && all.behind_centre == 0,
        "{all:?}"
    );
}

/// Seven blades about one axis, which is listed once for every two of their faces.
#[test]
fn an_edge_of_many_faces_is_drawn_if_any_of_them_shows_it() {
    let mut vertices = vec![[0, -9_000, 0], [0, 9_000, 0]];
    let mut faces = Vec::new();
    for i in 0..7 {
        let (s, c) = (f64::from(i) * core::f64::consts::TAU / 7.0 + 0.2).sin_cos();
        vertices.push([(12_000.0 * c) as i16, 500 * i as i16, (12_000.0 * s) as i16]);
        // Each blade has two faces: back faces are culled.
        faces.extend([[0, 1, i as u16 + 2], [1, 0, i as u16 + 2]]);
    }
    let mut blades = Solid::new(vertices, -13, faces);
    let axis = [0, 1];
    blades.edges.extend([axis; 6]); // fourteen faces
    blades.edges.sort_unstable();
    let mut all = Score::default();
    let mut rng = Rng::new(9);
    for _ in 0..8 {
        let model = ModelBits(vec![Step::Y(rng.next() as u32), Step::X(rng.next() as u32 >> 4)]);
        let score = score(&blades, &camera(), &model);
        println!("{score:?}");
        all.seen += score.seen;
        all.missed += score.missed;
        all.behind_centre += score.behind_centre;
    }
    assert!(all.seen > 2000 && all.missed * 100 <= all.seen && all.behind_centre == 0, "{all:?}");
}

/// The index that means "no face" is no face in a mesh that has a face of this number either: the wall hides the edge
/// behind it.
#[test]
fn an_edge_without_faces_stays_so_in_large_meshes() {
    let vertices = [[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0], [-2, 0, -2], [2, 1, -2]];
    let (edges, beside) = ([[4, 5]], [[Mesh::<i16>::NO_FACE; 2]]);
    let camera = CameraBits {
        view: ViewBits::LookAt([0, 0, 8 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (1, 1), ONE, 20 * ONE),
        viewport: (0, 0, 64, 64),
    }
    .library();
    let model = ModelBits::default().library();
    for count in [2, 65_535, 65_536, 65_537] {
        // Face 65535 is one of the wall's, if there is one.
        let mut faces = vec![[0, 0, 0]; count];
        let last = (count - 1).min(65_535);
        (faces[last - 1], faces[last]) = ([0, 1, 2], [0, 2, 3]);
        let mesh = Mesh::new(&vertices, 0, &faces)
            .and_then(|m| m.with_edges(&edges))
            .and_then(|m| m.with_edge_faces(&beside))
            .expect("a mesh");
        let instance = camera.place(&mesh, &model);
        let mut storage = vec![0; 64 * 64];
        let mut depth = DepthBuffer::new(bridge::rectangle(0, 0, 64, 64), &mut storage).expect("storage");
        instance.depth_only(&mut [], &mut depth);
        let mut target = Recorder::<BinaryColor>::sized(64, 64);
        let statistics = instance.hidden_line(BinaryColor::On, &mut [], &mut depth, &mut target);
        assert_eq!(statistics.expect("no error").drawn, 1);
        assert!(target.pixels.is_empty(), "{count} faces: {} pixels", target.pixels.len());
    }
}

/// Faces that the near plane cuts to several triangles: an edge is drawn where it is as near as the stored depth, and where
/// the visible face is adjacent to it, whichever of its triangles that is. Edges and faces drawn one by one give both;
/// unlike the fill rule, this test counts the border of a face as part of it.
#[test]
fn hidden_lines_draw_the_edges_of_clipped_faces() {
    const SIDE: u32 = 64;
    let area = bridge::rectangle(0, 0, SIDE, SIDE);
    let mut rng = Rng::new(0x4c);
    let (mut cut, mut by_face, mut borders, mut drawn) = (0, 0u32, 0u32, 0u32);
    for round in 0..200 {
        let solid = if round % 2 == 0 { splinters(&mut rng) } else { cube() };
        let solid = Solid::new(solid.vertices, solid.exponent, solid.faces);
        let whole = Mesh::new(&solid.vertices, solid.exponent, &solid.faces).expect("a mesh");
        let eye = rng.direction().map(|c| (c * rng.real(1.5, 3.0) * f64::from(ONE)) as i32);
        let to = [0; 3].map(|_| rng.int(-i64::from(ONE), i64::from(ONE)) as i32);
        let camera = CameraBits {
            view: ViewBits::LookAt(eye, to, [0, ONE, ONE / 7]),
            projection: ProjectionBits::Perspective(1 << 30, (1, 1), ONE, 20 * ONE),
            viewport: (0, 0, SIDE, SIDE),
        }
        .library();
        let model = ModelBits(vec![Step::X(rng.bits()), Step::Y(rng.bits())]).library();
        let alone: Vec<Vec<u16>> = (solid.faces.iter())
            .map(|&face| {
                let mut storage = vec![0; (SIDE * SIDE) as usize];
                let faces = [face];
                let mesh = Mesh::new(&solid.vertices, solid.exponent, &faces).expect("a face");
                let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
                cut += camera.place(&mesh, &model).depth_only(&mut [], &mut depth).clipped;
                storage
            })
            .collect();
        let mut storage = vec![0; (SIDE * SIDE) as usize];
        let mut depth = DepthBuffer::new(area, &mut storage).expect("storage");
        camera.place(&whole, &model).depth_only(&mut [], &mut depth);
        let held = depth.values().to_vec();
        for (edge, pair) in solid.edges.iter().zip(&solid.edge_faces()) {
            let (edges, beside) = ([*edge], [*pair]);
            let mesh = whole.with_edges(&edges).and_then(|m| m.with_edge_faces(&beside)).expect("an edge");
            let instance = camera.place(&mesh, &model);
            let mut storage = vec![0; (SIDE * SIDE) as usize];
            let mut own = DepthBuffer::new(area, &mut storage).expect("storage");
            let mut line = Recorder::<BinaryColor>::sized(SIDE, SIDE);
            instance.wireframe_depth_tested(BinaryColor::On, &mut [], &mut own, &mut line).expect("no error");
            let mut target = Recorder::<BinaryColor>::sized(SIDE, SIDE);
            instance.hidden_line(BinaryColor::On, &mut [], &mut depth, &mut target).expect("no error");
            let unlisted = whole.with_edges(&edges).expect("an edge");
            let mut same = Recorder::<BinaryColor>::sized(SIDE, SIDE);
            camera
                .place(&unlisted, &model)
                .hidden_line(BinaryColor::On, &mut [], &mut depth, &mut same)
                .expect("no error");
            assert_eq!(
                same.pixels, target.pixels,
                "faces that are found, not listed: round {round}, {edge:?}"
            );
            assert_eq!(depth.values(), held, "depth is looked at only");
            for &(x, y) in line.pixels.keys() {
                let at = (y * SIDE as i32 + x) as usize;
                let is_drawn = target.pixels.contains_key(&(x, y));
                let nearer = own.values()[at] <= held[at];
                let is_face =
                    |&face: &u16| alone.get(usize::from(face)).is_some_and(|face| face[at] == held[at]);
                let face = held[at] != DepthBuffer::NOTHING && pair.iter().any(is_face);
                assert!(is_drawn || !(nearer || face), "round {round}, {edge:?}: ({x}, {y}) is missing");
                drawn += u32::from(is_drawn);
                by_face += u32::from(!nearer && face);
                borders += u32::from(is_drawn && !nearer && !face);
            }
            assert!(target.pixels.keys().all(|at| line.pixels.contains_key(at)), "beside the line");
        }
    }
    println!("{cut} faces cut; of {drawn} pixels {by_face} by a face, {borders} on its border");
    assert!(cut > 1000 && by_face > 1000 && borders * 100 < drawn, "{cut} {by_face} {borders} {drawn}");
}
