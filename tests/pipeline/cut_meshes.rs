//! Meshes that the near plane and the guard band cut, drawn in every way: solid, with depth, culled by planes, in bands, in
//! painter's order, as wireframes and with hidden lines; into memory and into a plain DrawTarget; with vertex caches of full
//! length, short and empty. All ways agree pixel by pixel, and faces that are culled before they are cut are those that are
//! drawn only without culling.

use embedded_graphics_core::pixelcolor::{IntoStorage, Rgb565};
use embedded_graphics_core::prelude::{RawData, Size};
use pinhole::space::{Model, World};
use pinhole::{
    edge_faces, Affine, Angle, Camera, Coordinate, Cull, DepthBuffer, Mesh, MeshInstance, Painter, Picture,
    Point3, Projection, Scalar, ScreenVertex, Statistics, Vector3, ViewTransform, Viewport, WithPlanes,
};
use std::collections::{BTreeMap, BTreeSet};
use support::bridge::draw::Shader;
use support::bridge::rectangle;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 36;
const AROUND: u16 = 12;
const ACROSS: u16 = 8;
const VERTICES: usize = (AROUND * ACROSS) as usize;
const FACES: usize = 2 * VERTICES;
const EDGES: usize = 3 * VERTICES;

struct Torus {
    vertices: Vec<[i16; 3]>,
    faces: Vec<[u16; 3]>,
    normals: Vec<[i16; 3]>,
    edges: [[u16; 2]; EDGES],
    beside: [[u16; 2]; EDGES],
}

fn torus() -> Torus {
    let turn = |i: u16, n: u16| (f64::from(i) / f64::from(n) * std::f64::consts::TAU).sin_cos();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for i in 0..AROUND {
        for j in 0..ACROSS {
            let ((s, c), (t, d)) = (turn(i, AROUND), turn(j, ACROSS));
            let r = 16_000.0 + 7_000.0 * d;
            vertices.push([r * c, r * s, 7_000.0 * t].map(|v| v as i16));
            let at = |i: u16, j: u16| (i % AROUND) * ACROSS + j % ACROSS;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    let normal = |&[a, b, c]: &[u16; 3]| {
        let [a, b, c] = [a, b, c].map(|i| vertices[usize::from(i)].map(f64::from));
        let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.map(|c| (c / length * 32_767.0).round() as i16)
    };
    let normals = faces.iter().map(normal).collect();
    let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: BTreeSet<[u16; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let edges: [[u16; 2]; EDGES] =
        edges.into_iter().collect::<Vec<_>>().try_into().expect("three for each vertex");
    Torus { beside: edge_faces(&edges, &faces), vertices, faces, normals, edges }
}

type Pixels = BTreeMap<(i32, i32), (Shader, u32)>;

/// Draws bands of these heights, one after the other, and returns all their pixels.
fn bands(rng: &mut Rng, mut draw: impl FnMut(&mut Recorder<Shader>, &mut DepthBuffer<'_>)) -> Pixels {
    let (mut pixels, mut top) = (Pixels::new(), 0);
    while top < HEIGHT as i32 {
        let rows = (rng.int(1, 12) as i32).min(HEIGHT as i32 - top);
        let area = rectangle(0, top, WIDTH, rows as u32);
        let (mut target, mut depth) = (Recorder::new(area), vec![u16::MAX; (WIDTH * rows as u32) as usize]);
        draw(&mut target, &mut DepthBuffer::new(area, &mut depth).expect("as many numbers"));
        pixels.append(&mut target.pixels);
        top += rows;
    }
    pixels
}

/// Draws into a target that takes spans.
fn whole(draw: impl FnOnce(&mut Recorder<Shader>, &mut DepthBuffer<'_>)) -> Pixels {
    let (mut target, mut depth) = (Recorder::sized(WIDTH, HEIGHT), vec![u16::MAX; (WIDTH * HEIGHT) as usize]);
    let area = rectangle(0, 0, WIDTH, HEIGHT);
    draw(&mut target, &mut DepthBuffer::new(area, &mut depth).expect("as many numbers"));
    target.pixels
}

fn shader(face: usize) -> Shader {
    Shader(face as u16 + 1)
}

fn color(face: usize) -> Rgb565 {
    Rgb565::from(embedded_graphics_core::pixelcolor::raw::RawU16::from_u32(face as u32 + 1))
}

/// Draws into memory, and compares with what a target got that takes spans.
fn in_memory(expected: &Pixels, draw: impl FnOnce(&mut Picture<'_, Rgb565>, &mut DepthBuffer<'_>)) {
    let count = (WIDTH * HEIGHT) as usize;
    let (mut cells, mut depth) = (vec![Rgb565::new(0, 0, 0); count], vec![u16::MAX; count]);
    let mut picture = Picture::new(&mut cells, Size::new(WIDTH, HEIGHT)).expect("as many pixels");
    let area = rectangle(0, 0, WIDTH, HEIGHT);
    draw(&mut picture, &mut DepthBuffer::new(area, &mut depth).expect("as many numbers"));
    for (index, cell) in cells.iter().enumerate() {
        let at = ((index % WIDTH as usize) as i32, (index / WIDTH as usize) as i32);
        let stored = expected.get(&at).map_or(0, |(shader, _)| shader.0);
        assert_eq!(cell.into_storage(), stored, "{at:?}");
    }
}

/// Draws in every way, compares, and returns the statistics of faces, and the pixels of solid faces, of faces with depth, of edges
/// and of hidden lines.
fn every_way<V: Coordinate>(
    rng: &mut Rng,
    by_planes: &MeshInstance<'_, V, WithPlanes>,
    turned: &MeshInstance<'_, V>,
) -> (Statistics, [Pixels; 4]) {
    let instance = by_planes.without_planes();
    let caches = [VERTICES, 0, rng.int(1, VERTICES as i64 - 1) as usize];
    let [mut full, mut empty, mut short] = caches.map(|length| vec![ScreenVertex::EMPTY; length]);
    let mut statistics = Vec::new();
    // Solid.
    let solid = whole(|target, _| statistics.push(instance.solid(shader, &mut full, target)));
    for cache in [&mut empty, &mut short] {
        assert!(solid == whole(|target, _| statistics.push(instance.solid(shader, cache, target))));
    }
    in_memory(&solid, |picture, _| {
        let Ok(_) = instance.solid(color, &mut full, &mut picture.pixels());
    });
    for cache in [&mut full, &mut empty, &mut short] {
        assert!(
            solid == whole(|target, _| by_planes.solid(shader, cache, target).map(|_| ()).expect("drawn"))
        );
    }
    let mut storage = [0; FACES + FACES.div_ceil(16)];
    let transformed = instance.transform(&mut short);
    let mut faces = transformed.bin_faces(&mut storage).expect("room");
    statistics.push(Ok(faces.statistics()));
    assert!(solid == bands(rng, |band, _| faces.solid(shader, band).expect("drawn")));
    let mut faces = by_planes.bin_faces(&mut full, &mut storage).expect("room");
    assert!(solid == bands(rng, |band, _| faces.solid(shader, band).expect("drawn")));
    let transformed = by_planes.transform(&mut short);
    let mut faces = transformed.bin_faces(&mut storage).expect("room");
    assert!(solid == bands(rng, |band, _| faces.solid(shader, band).expect("drawn")));
    // Culling leaves out the faces that the turned mesh draws: without culling, no side is known before a face is cut.
    let behind = whole(|target, _| turned.solid(shader, &mut full, target).map(|_| ()).expect("drawn"));
    let both_sides = instance.with_cull(Cull::None);
    let both = whole(|target, _| both_sides.solid(shader, &mut full, target).map(|_| ()).expect("drawn"));
    let count = |pixels: &Pixels, at| pixels.get(at).map_or(0, |(_, count)| *count);
    for at in both.keys() {
        assert_eq!(count(&both, at), count(&solid, at) + count(&behind, at), "{at:?}");
    }
    // With depth.
    let deep =
        whole(|target, depth| statistics.push(instance.depth_tested(shader, &mut full, depth, target)));
    assert!(
        deep == whole(|target, depth| {
            statistics.push(instance.depth_tested(shader, &mut empty, depth, target));
        })
    );
    in_memory(&deep, |picture, depth| {
        let Ok(_) = instance.depth_tested(color, &mut short, depth, &mut picture.pixels());
    });
    for cache in [&mut full, &mut short] {
        assert!(
            deep == whole(|target, depth| {
                by_planes.depth_tested(shader, cache, depth, target).map(|_| ()).expect("drawn");
            })
        );
    }
    let transformed = instance.transform_depth(&mut full);
    let mut faces = transformed.bin_faces(&mut storage).expect("room");
    assert!(deep == bands(rng, |band, depth| faces.depth_tested(shader, depth, band).expect("drawn")));
    let mut faces = by_planes.bin_faces_with_depth(&mut short, &mut storage).expect("room");
    assert!(deep == bands(rng, |band, depth| faces.depth_tested(shader, depth, band).expect("drawn")));
    let transformed = by_planes.transform_depth(&mut full);
    let mut faces = transformed.bin_faces(&mut storage).expect("room");
    assert!(deep == bands(rng, |band, depth| faces.depth_tested(shader, depth, band).expect("drawn")));
    // The face that is picked in a pixel is the face that is drawn there.
    for _ in 0..4 {
        let at = (rng.below(WIDTH as usize) as i32, rng.below(HEIGHT as usize) as i32);
        let (pixel, drawn) = (at.into(), deep.get(&at).map(|(shader, _)| shader.0));
        let picked = [
            instance.pick(pixel, shader, &mut full),
            by_planes.pick(pixel, shader, &mut short),
            by_planes.transform_depth(&mut empty).pick(pixel, shader),
        ];
        for picked in picked {
            assert_eq!(picked.map(|picked| picked.face as u16 + 1), drawn, "{at:?}");
        }
    }
    // Painter's order.
    let mut painter = Box::new(Painter::<Shader, 1500, 800>::new());
    painter.add(&instance, shader).expect("room");
    let painted = whole(|target, _| statistics.push(painter.draw(target)));
    painter.add(by_planes, shader).expect("room");
    assert!(painted == whole(|target, _| painter.draw(target).map(|_| ()).expect("drawn")));
    // Lines.
    let wire =
        whole(|target, _| instance.wireframe(Shader(7), &mut full, target).map(|_| ()).expect("drawn"));
    let again =
        whole(|target, _| instance.wireframe(Shader(7), &mut short, target).map(|_| ()).expect("drawn"));
    assert!(wire == again);
    in_memory(&wire, |picture, _| {
        let Ok(_) = instance.wireframe(color(6), &mut empty, &mut picture.pixels());
    });
    let mut storage = [0; EDGES + EDGES.div_ceil(16)];
    let transformed = instance.transform(&mut full);
    let mut edges = transformed.bin_edges(&mut storage).expect("room");
    assert!(wire == bands(rng, |band, _| edges.draw(Shader(7), band).expect("drawn")));
    let hidden = whole(|target, depth| {
        instance.depth_only(&mut full, depth);
        instance.hidden_line(Shader(7), &mut short, depth, target).map(|_| ()).expect("drawn");
    });
    let planes_first = whole(|target, depth| {
        by_planes.depth_only(&mut short, depth);
        instance.hidden_line(Shader(7), &mut empty, depth, target).map(|_| ()).expect("drawn");
    });
    assert!(hidden == planes_first);
    let first = statistics[0].expect("drawn");
    assert!(statistics.iter().all(|&counted| counted == Ok(first)), "{statistics:?}");
    (first, [solid, deep, wire, hidden])
}

#[test]
fn meshes_that_are_cut_are_equal_in_every_way_of_drawing() {
    let torus = torus();
    let number = |v| Scalar::from_f64(v).expect("in range");
    let mut rng = Rng::new(26);
    let viewport =
        Viewport::new(embedded_graphics_core::prelude::Point::zero(), Size::new(WIDTH, HEIGHT)).unwrap();
    let turned: Vec<[u16; 3]> = torus.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let turned = Mesh::new(&torus.vertices, -14, &turned).unwrap();
    let mesh = Mesh::new(&torus.vertices, -14, &torus.faces).unwrap().with_normals(&torus.normals).unwrap();
    let planes: [i16; FACES] = mesh.face_planes();
    let mesh = mesh.with_planes(&planes).unwrap().with_edges(&torus.edges).unwrap();
    let mesh = mesh.with_edge_faces(&torus.beside).unwrap();
    let (mut clipped, mut outside, mut in_view) = (0, 0, 0);
    for round in 0..150 {
        // Also so near that the guard band cuts, and that positions lie beyond the range of a `ScreenVertex`.
        let (near, angle) = ([0.5, 0.1, 0.004][round % 3], [60, 90, 8][round / 3 % 3]);
        let lens =
            Projection::perspective(Angle::degrees(angle), viewport.size(), number(near), number(20.0));
        let mut coordinate = |reach: i64| number(rng.int(-reach, reach) as f64 / 1000.0);
        let eye = Point3::new(coordinate(1200), coordinate(1200), coordinate(900));
        let gaze = Point3::new(coordinate(1000), coordinate(1000), coordinate(300));
        let Ok(view) = ViewTransform::look_at(eye, gaze, Vector3::from_ints(1, 2, 3)) else { continue };
        let camera = Camera::new(&view, &lens.unwrap(), &viewport).with_far_clip(true);
        let model = Affine::<Model, World>::rotation_y(Angle::degrees(rng.int(0, 359) as i32));
        let (instance, turned) = (camera.place(&mesh, &model), camera.place(&turned, &model));
        let (counted, pixels) = every_way(&mut rng, &instance, &turned);
        (clipped, outside) = (clipped + counted.clipped, outside + counted.outside);
        // Without clipping, faces that would be cut are left out and counted.
        let (inside, of_inside) =
            every_way(&mut rng, &instance.without_clipping(), &turned.without_clipping());
        assert!(inside.clipped == 0 && inside.drawn <= counted.drawn, "{inside:?} {counted:?}");
        assert!(
            inside.outside + inside.culled >= counted.outside + counted.clipped,
            "{inside:?} {counted:?}"
        );
        if counted.clipped + counted.outside == 0 && inside.outside == 0 {
            in_view += 1;
            assert!(inside == counted && of_inside == pixels);
        }
    }
    assert!(clipped > 1000 && outside > 3000 && in_view > 5, "{clipped} {outside} {in_view}");
}
