//! Watertight after clipping: closed convex meshes that straddle the near plane, seen from outside,
//! from inside and from their surface. Counts of front and back faces in each pixel against one ray
//! in f64, and against each other: along a line that starts on the near plane outside the body front
//! and back alternate, so each is met once or not at all; starting inside, only a back face is met.

use super::solids::{self, Solid};
use pinhole::{Cull, Mesh, ScreenVertex};
use support::bridge::draw::{Shader, CUBE, CUBE_FACES};
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::chain::{self, cross, dot, vertex, V3};
use support::oracle::coverage::Area;
use support::oracle::eye::{self, Face};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const WIDTH: u32 = 30;
const HEIGHT: u32 = 20;

/// The octahedron, counter-clockwise from outside.
const OCTAHEDRON: [[i16; 3]; 6] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const OCTAHEDRON_FACES: [[u16; 3]; 8] =
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

fn bodies(rng: &mut Rng) -> Vec<Solid> {
    let mut all = vec![
        Solid::new(CUBE.to_vec(), 1, CUBE_FACES.to_vec()),
        Solid::new(OCTAHEDRON.to_vec(), 1, OCTAHEDRON_FACES.to_vec()),
    ];
    all.extend([5, 8, 12].map(|count| solids::hull(rng, count)));
    all
}

/// How often each pixel is drawn by front faces, and by back faces.
fn counts(camera: &CameraBits, model: &ModelBits, body: &Solid) -> (Recorder<Shader>, Recorder<Shader>) {
    let draw = |faces: &[[u16; 3]], cull: Cull| {
        let mesh = Mesh::new(&body.vertices, body.exponent, faces).expect("a mesh");
        let mut target = Recorder::sized(WIDTH, HEIGHT);
        let instance = camera.library().place(&mesh, &model.library()).with_cull(cull);
        instance
            .solid(|f| Shader(f as u16), &mut [ScreenVertex::default(); 16], &mut target)
            .expect("no error");
        target
    };
    let turned: Vec<[u16; 3]> = body.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let (front, back) = (draw(&body.faces, Cull::Back), draw(&turned, Cull::Back));
    // Without culling front and back faces are drawn.
    let both = draw(&body.faces, Cull::None);
    for (x, y) in Area::new(0, 0, WIDTH.into(), HEIGHT.into()).pixels() {
        let at = (x as i32, y as i32);
        assert_eq!(both.count(at.0, at.1), front.count(at.0, at.1) + back.count(at.0, at.1));
    }
    (front, back)
}

/// Front and back faces met beyond near through (x, y), and whether near's point lies inside the body.
fn met(faces: &[Face], x: f64, y: f64) -> (u32, u32) {
    let mut n = (0, 0);
    for face in faces {
        if face.is_met(x, y) {
            if face.is_front() {
                n.0 += 1;
            } else {
                n.1 += 1;
            }
        }
    }
    n
}

#[derive(Default, Debug)]
struct Tally {
    background: usize,
    outside: usize,
    inside: usize,
    ambiguous: usize,
}

fn compare(camera: &CameraBits, model: &ModelBits, body: &Solid, tally: &mut Tally) {
    let (front, back) = counts(camera, model, body);
    let positions: Vec<V3> = body.vertices.iter().map(|&v| vertex(v, body.exponent)).collect();
    let faces = eye::faces(&camera.exact(), &model.exact(), &positions, &body.faces);
    const T: f64 = 1.0 / 64.0;
    let around = [(0.0, 0.0), (T, 0.0), (-T, 0.0), (0.0, T), (0.0, -T), (T, T), (T, -T), (-T, T), (-T, -T)];
    for (x, y) in Area::new(0, 0, WIDTH.into(), HEIGHT.into()).pixels() {
        let got = (front.count(x as i32, y as i32), back.count(x as i32, y as i32));
        let (cx, cy) = (x as f64 + 0.5, y as f64 + 0.5);
        // The body is closed: front faces draw no pixel twice, nor do back faces, not even on borders.
        assert!(got.0 <= 1 && got.1 <= 1, "({x}, {y}): {got:?} {camera:?} {model:?} {:?}", body.vertices);
        let seen = around.map(|(dx, dy)| met(&faces, cx + dx, cy + dy));
        // On a border or an edge of the body, where one of nine rays may count two faces.
        if seen.iter().any(|n| *n != seen[0]) {
            tally.ambiguous += 1;
            continue;
        }
        assert_eq!(got, seen[0], "({x}, {y}): {camera:?} {model:?} {:?}·2^{}", body.vertices, body.exponent);
        match seen[0] {
            (0, 0) => tally.background += 1,
            (1, 1) => tally.outside += 1,
            (0, 1) => tally.inside += 1,
            other => panic!("a convex body cannot be met so: {other:?}"),
        }
    }
}

fn camera(eye: [i32; 3], gaze: [i32; 3], near: i32) -> CameraBits {
    CameraBits {
        view: ViewBits::LookAlong(eye, gaze, [0, ONE, 0]),
        projection: ProjectionBits::Perspective((1 << 31) / 3, (WIDTH, HEIGHT), near, 100 * ONE),
        viewport: (0, 0, WIDTH, HEIGHT),
    }
}

fn gaze(rng: &mut Rng) -> [i32; 3] {
    loop {
        let g = bits(rng.direction()).expect("in range");
        if g[0].abs().max(g[2].abs()) > 100 {
            return g;
        }
    }
}

fn model(rng: &mut Rng) -> ModelBits {
    let mut model = ModelBits::random_rotation(rng);
    model.0.push(Step::Move([0; 3].map(|_| rng.int(-50 * i64::from(ONE), 50 * i64::from(ONE)) as i32)));
    model
}

/// An eye at a distance from the middle of the body, along a direction.
fn eye_at(model: &ModelBits, body_point: V3) -> [i32; 3] {
    bits(model.exact().apply(body_point)).expect("in range")
}

#[test]
fn from_inside_one_back_face_in_each_pixel_of_the_near_windows_inside() {
    let mut rng = Rng::new(0x91);
    let mut tally = Tally::default();
    for body in bodies(&mut rng) {
        for _ in 0..120 {
            let model = model(&mut rng);
            let eye = eye_at(&model, rng.direction().map(|c| c * 0.3));
            // Near is small enough to stay inside, or sticks out.
            let near = rng.int(i64::from(ONE / 16), i64::from(2 * ONE)) as i32;
            compare(&camera(eye, gaze(&mut rng), near), &model, &body, &mut tally);
        }
    }
    println!("inside: {tally:?}");
    assert!(tally.inside > 50_000 && tally.background > 10_000 && tally.ambiguous * 10 < tally.inside);
}

#[test]
fn from_outside_front_and_back_faces_pair() {
    let mut rng = Rng::new(0x92);
    let mut tally = Tally::default();
    for body in bodies(&mut rng) {
        for _ in 0..120 {
            let model = model(&mut rng);
            let away = rng.direction();
            let eye = eye_at(&model, away.map(|c| c * 4.0));
            // Look near the middle; near cuts through the body as often as not.
            let middle = model.exact().apply(rng.direction().map(|c| c * 1.0));
            let g = bits(core::array::from_fn(|i| middle[i] - chain::fx(eye[i]))).expect("in range");
            if g[0].abs().max(g[2].abs()) < 100 {
                continue;
            }
            let near = rng.int(i64::from(ONE), i64::from(6 * ONE)) as i32;
            compare(&camera(eye, g, near), &model, &body, &mut tally);
        }
    }
    println!("outside: {tally:?}");
    assert!(tally.outside > 20_000 && tally.inside > 10_000 && tally.background > 10_000);
}

#[test]
fn from_the_surface_of_a_mesh_faces_match_the_rays() {
    let mut rng = Rng::new(0x93);
    let mut tally = Tally::default();
    for body in bodies(&mut rng) {
        let positions: Vec<V3> = body.vertices.iter().map(|&v| vertex(v, body.exponent)).collect();
        for k in 0..120 {
            let model = if k % 2 == 0 { ModelBits::default() } else { model(&mut rng) };
            // A vertex, the middle of an edge, or some point of a face.
            let [a, b, c] = body.faces[rng.below(body.faces.len())].map(|i| positions[usize::from(i)]);
            let weights = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.25, 0.25, 0.5]][rng.below(3)];
            let at = core::array::from_fn(|i| dot(weights, [a[i], b[i], c[i]]));
            let near = rng.int(i64::from(ONE / 16), i64::from(2 * ONE)) as i32;
            let mut g = gaze(&mut rng);
            if rng.one_in(4) {
                // Along the surface.
                let along = cross(
                    cross(core::array::from_fn(|i| b[i] - a[i]), core::array::from_fn(|i| c[i] - a[i])),
                    rng.direction(),
                );
                let along = model.exact().apply(along);
                let origin = model.exact().apply([0.0; 3]);
                let turned = bits(core::array::from_fn(|i| along[i] - origin[i])).expect("in range");
                if turned[0].abs().max(turned[2].abs()) > 100 {
                    g = turned;
                }
            }
            compare(&camera(eye_at(&model, at), g, near), &model, &body, &mut tally);
        }
    }
    println!("surface: {tally:?}");
    assert!(tally.inside > 10_000 && tally.background > 10_000);
}

#[test]
fn one_triangle_larger_than_the_screen_in_every_direction_is_drawn() {
    let mut rng = Rng::new(0x94);
    for _ in 0..300 {
        // Through points straight ahead, with all corners far outside, tilted at will.
        let d = rng.log(2.0, 3000.0);
        let tilt = [rng.real(-0.4, 0.4), rng.real(-0.4, 0.4)];
        let turn = rng.real(0.0, core::f64::consts::TAU);
        let size = rng.log(6.0, 30.0).min(9.0);
        let corner = |k: f64| {
            let a = turn + k * core::f64::consts::TAU / 3.0;
            let (x, y) = (size * d * a.cos(), size * d * a.sin());
            [x, y, -d + tilt[0] * x + tilt[1] * y]
        };
        let corners = [corner(0.0), corner(1.0), corner(2.0)];
        let exponent =
            (corners.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs())) / 32_000.0).log2().ceil() as i8;
        let vertices: Vec<[i16; 3]> =
            corners.iter().map(|c| c.map(|v| (v / f64::from(exponent).exp2()).round() as i16)).collect();
        let body = Solid::new(vertices, exponent, vec![[0, 1, 2]]);
        let c = camera([0; 3], [0, 0, -ONE], ONE);
        let (front, back) = counts(&c, &ModelBits::default(), &body);
        for (x, y) in Area::new(0, 0, WIDTH.into(), HEIGHT.into()).pixels() {
            assert_eq!(
                (front.count(x as i32, y as i32), back.count(x as i32, y as i32)),
                (1, 0),
                "{:?}",
                body.vertices
            );
        }
    }
}
