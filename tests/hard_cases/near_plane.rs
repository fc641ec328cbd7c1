//! C1–C6: the near plane always cuts, and each pixel shows the face that its ray meets. The oracle does not clip.
//!
//! A snapped vertex is up to 1/256 px off, so pixels whose answer is not certain for every ray within
//! 1/64 px are left out; their number is bounded.

use pinhole::{draw::Cull, mesh::Coordinate, Mesh};
use support::bridge::draw::{solid, wireframe, Shader, CUBE, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{bits, CameraBits, ModelBits, Step, ONE};
use support::bridge::scalar;
use support::oracle::chain::{self, vertex, V3, V4};
use support::oracle::coverage::{self, triangle, Area};
use support::oracle::eye;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const TOLERANCE: f64 = 1.0 / 64.0;

/// With a field of view of 60°.
fn camera(width: u32, height: u32, near: i32, far: i32) -> CameraBits {
    CameraBits::perspective((1 << 31) / 3, (width, height), near, far)
}

#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    pub(crate) covered: usize,
    pub(crate) background: usize,
}

/// Draws the front faces of a mesh and compares every pixel with the ray through it, except pixels where a ray within
/// `tolerance` px may hit another face.
pub(crate) fn compare(
    c: &CameraBits,
    model: &ModelBits,
    vertices: &[[i16; 3]],
    exponent: i8,
    faces: &[[u16; 3]],
    tolerance: f64,
) -> Tally {
    let mesh = Mesh::new(vertices, exponent, faces).expect("a mesh");
    let positions: Vec<V3> = vertices.iter().map(|&v| vertex(v, exponent)).collect();
    compare_mesh(c, model, &mesh, &positions, tolerance)
}

fn compare_mesh<V: Coordinate<Stored = V>>(
    c: &CameraBits,
    model: &ModelBits,
    mesh: &Mesh<'_, V>,
    positions: &[V3],
    tolerance: f64,
) -> Tally {
    let (_, _, width, height) = c.viewport;
    let faces = mesh.faces();
    let mut target = Recorder::sized(width, height);
    let library = c.library();
    let statistics = solid(&library.place(mesh, &model.library()), &mut target).expect("no error");
    let seen = eye::faces(&c.exact(), &model.exact(), positions, faces);
    let mut tally = Tally::default();
    for (x, y) in Area::new(0, 0, width.into(), height.into()).pixels() {
        let (count, colour) = (target.count(x as i32, y as i32), target.colour(x as i32, y as i32));
        match eye::pixel(&seen, (x, y), false, tolerance) {
            Ok(Some(face)) => {
                tally.covered += 1;
                assert_eq!(
                    (count, colour),
                    (1, Some(Shader(face as u16))),
                    "({x}, {y}) sees face {face}; {c:?} {model:?} {positions:?} {faces:?} {statistics:?}"
                );
            }
            Ok(None) => {
                tally.background += 1;
                assert_eq!(
                    count, 0,
                    "({x}, {y}) sees nothing but {colour:?} is drawn; {c:?} {model:?} {positions:?} {faces:?} {statistics:?}"
                );
            }
            Err(()) => assert!(count <= 1, "({x}, {y}) is drawn {count} times"),
        }
    }
    tally
}

/// The corners of one triangle in the oracle's clip space.
fn corners(c: &CameraBits, model: &ModelBits, vertices: &[[i16; 3]], exponent: i8) -> Vec<V4> {
    let (camera, model) = (c.exact(), model.exact());
    vertices.iter().map(|&v| camera.clip(&model, vertex(v, exponent))).collect()
}

#[test]
fn c2_a_vertex_exactly_on_near_is_not_cut() {
    let mut rng = Rng::new(0xC2);
    let near = ONE / 2;
    let c = camera(40, 30, near, 100 * ONE);
    for k in 0..3000 {
        // Units of 1/64; near is at z = −32.
        let on = k % 3; // one, two or three vertices lie on it
        let vertices: Vec<[i16; 3]> = (0..3)
            .map(|i| {
                let z = if i <= on { -32 } else { -32 - rng.int(1, 200) };
                let r = -z / 2;
                [rng.int(-r, r) as i16, rng.int(-r, r) as i16, z as i16]
            })
            .collect();
        let model = ModelBits::default();
        let clip = corners(&c, &model, &vertices, -6);
        // Nothing is cut, so the snapped triangle's coverage is exact.
        let exact = c.exact();
        let at: Vec<(f64, f64)> = clip.iter().map(|&p| exact.screen(p)).collect();
        let tie = |v: f64| ((v * 256.0).fract().abs() - 0.5).abs() < 1e-3;
        if at.iter().any(|&(x, y)| tie(x) || tie(y)) {
            continue;
        }
        let t = [chain::snap(at[0]), chain::snap(at[1]), chain::snap(at[2])];
        let front = coverage::edge(t[0], t[1], t[2]) < 0;
        let faces = [if front { [0, 1, 2] } else { [0, 2, 1] }];
        let mesh = Mesh::new(&vertices, -6, &faces).expect("a mesh");
        let mut target = Recorder::sized(40, 30);
        let library = c.library();
        solid(&library.place(&mesh, &model.library()), &mut target).expect("no error");
        let wanted = triangle(t, Area::new(0, 0, 40, 30));
        for (x, y) in wanted.area.pixels() {
            assert_eq!(target.count(x as i32, y as i32), wanted.at(x, y), "({x}, {y}) of {vertices:?}");
        }
        for (v, at) in t.into_iter().enumerate() {
            let pinhole::camera::Projected { point: p, depth } =
                library.place(&mesh, &model.library()).project(v).expect("on near is visible");
            assert_eq!((i64::from(p.x()), i64::from(p.y())), at);
            if v <= on {
                assert_eq!(depth, 0);
            }
        }
    }
}

#[test]
fn c2_touching_near_from_in_front_draws_nothing() {
    let near = ONE / 2;
    let c = camera(40, 30, near, 100 * ONE);
    for vertices in [
        [[-9i16, -9, -32], [9, -9, -31], [0, 9, -20]],
        [[-9, -9, -32], [9, -9, -32], [0, 9, -31]],
        [[-9, -9, -32], [9, -9, 0], [0, 9, 40]],
        [[-9, -9, -32], [9, -9, -32], [0, 9, 100]],
    ] {
        for faces in [[[0, 1, 2]], [[0, 2, 1]]] {
            let mesh = Mesh::new(&vertices, -6, &faces).expect("a mesh");
            let mut target = Recorder::sized(40, 30);
            let model = ModelBits::default().library();
            solid(&c.library().place(&mesh, &model), &mut target).expect("no error");
            assert!(target.pixels.is_empty(), "{vertices:?}");
        }
    }
}

#[test]
fn c3_faces_with_w_of_a_billionth_cover_what_rays_meet() {
    // The model flattens z by 2¹⁴: one corner has w from 2⁻³⁰ on, of either sign or none, the others are far away.
    let mut rng = Rng::new(0xC39);
    let c = camera(24, 18, ONE / 4, 1000 * ONE);
    let model = ModelBits(vec![Step::Scale([ONE, ONE, ONE >> 14])]);
    let mut covered = 0;
    for k in 0..3000 {
        let corners = [0, 1, 2].map(|corner| {
            let z = match corner {
                // 10⁻⁹ and 10⁻⁶ are 1 and 1074 of 2⁻³⁰.
                0 => [0, 1, -1, 2, 1074, -1074, 100_000][rng.below(7)],
                _ => rng.int(8192 << 16, 32767 << 16) as i32,
            };
            let reach = if corner == 0 { rng.log(1.0, 65536.0) as i64 } else { 2 << 16 };
            [rng.int(-reach, reach) as i32, rng.int(-reach, reach) as i32, -z]
        });
        let fixed = corners.map(|corner| corner.map(scalar));
        let positions = corners.map(chain::fx3);
        let face = [[[0, 1, 2]], [[0, 2, 1]]][k % 2];
        let mesh = Mesh::from_fixed(&fixed, &face).expect("a mesh");
        covered += compare_mesh(&c, &model, &mesh, &positions, TOLERANCE).covered;
    }
    assert!(covered > 10_000, "{covered}");
}

#[test]
fn c4_everything_behind_is_empty() {
    let c = camera(40, 30, ONE / 4, 100 * ONE);
    for z in [10, 3, 2] {
        let model = ModelBits(vec![Step::Move([0, 0, z * ONE])]).library();
        let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
        let library = c.library();
        let instance = library.place(&mesh, &model);
        let mut target = Recorder::sized(40, 30);
        let s = solid(&instance, &mut target).expect("no error");
        let w = wireframe(&instance, &mut target).expect("no error");
        assert!(target.calls.is_empty());
        assert_eq!((s.drawn, w.drawn), (0, 0));
        for v in 0..8 {
            assert!(instance.project(v).is_err());
        }
    }
}

#[test]
fn c6_lines_to_far_outside_the_guard_band_stay_on_course() {
    // An end is floored to a pixel: its centre is up to ½ px off in x and in y, so up to 1 px along the
    // minor axis, and Bresenham adds ½. The cut at the guard band must not add a pixel to that.
    let mut rng = Rng::new(0x6B);
    let c = camera(60, 40, ONE / 4, 30000 * ONE);
    let exact = c.exact();
    let mut pixels = 0;
    for _ in 0..4000 {
        let inner = [rng.int(-40, 40) as i16, rng.int(-30, 30) as i16, -64];
        let outer = [rng.int(-32000, 32000) as i16, rng.int(-32000, 32000) as i16, rng.int(-600, 600) as i16];
        let vertices = [inner, outer];
        let model = ModelBits::default();
        let clip = corners(&c, &model, &vertices, -6);
        let edges = [[0, 1]];
        let mesh = Mesh::new(&vertices, -6, &[]).and_then(|m| m.with_edges(&edges)).expect("a mesh");
        let mut target = Recorder::sized(60, 40);
        wireframe(&c.library().place(&mesh, &model.library()), &mut target).expect("no error");
        // The line on screen through the two homogeneous points.
        let (a, b) = (exact.homogeneous_screen(clip[0]), exact.homogeneous_screen(clip[1]));
        let l = chain::cross(a, b);
        let steepness = l[0].abs().max(l[1].abs());
        for &(x, y) in target.pixels.keys() {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5, 1.0];
            let off = (chain::dot(l, p) / steepness).abs();
            assert!(off <= 1.5 + 1.0 / 64.0, "({x}, {y}) is {off} px off {vertices:?}");
        }
        pixels += target.pixels.len();
        // The inner end lies well inside: it is drawn.
        let (x, y) = exact.screen(clip[0]);
        if x > 0.1 && y > 0.1 && x < 59.9 && y < 39.9 {
            assert!(!target.pixels.is_empty(), "{vertices:?}");
        }
    }
    assert!(pixels > 40_000);
}

#[test]
fn c6_the_cut_of_a_shared_edge_is_the_same_point_for_both() {
    // Two huge triangles, 10⁴ times larger than their distance, share a diagonal through the picture
    // that near cuts: were the cut a unit apart, centres on the diagonal would show it.
    let mut rng = Rng::new(0xB8);
    let mut once = 0;
    for _ in 0..800 {
        let near = rng.real(1.0, 2.0);
        let camera = camera(64, 48, (near * 65536.0) as i32, 32767 * ONE);
        // A plane through the axis just behind near, tilted.
        let tilt = rng.real(0.5, 1.2);
        let (turn, spin) = (rng.real(0.0, core::f64::consts::TAU), rng.real(0.0, core::f64::consts::TAU));
        let across = [turn.cos(), turn.sin(), 0.0];
        let along = [-turn.sin() * tilt.cos(), turn.cos() * tilt.cos(), tilt.sin()];
        let size = rng.log(3000.0, 20_000.0);
        let centre = [0.0, 0.0, -near * rng.real(1.05, 1.3)];
        let corners: Option<Vec<[i32; 3]>> = (0..4)
            .map(|k| {
                let a = spin + core::f64::consts::FRAC_PI_2 * f64::from(k);
                let (u, v) = (size * a.cos(), size * a.sin());
                bits(core::array::from_fn(|i| centre[i] + u * across[i] + v * along[i]))
            })
            .collect();
        let corners = corners.expect("in range");
        let fixed: Vec<_> = corners.iter().map(|c| c.map(scalar)).collect();
        let positions: Vec<_> = corners.iter().map(|&c| chain::fx3(c)).collect();
        let faces = [[0, 1, 2], [0, 2, 3]];
        let mesh = Mesh::from_fixed(&fixed, &faces).expect("a mesh");
        let (library, model) = (camera.library(), ModelBits::default());
        let mut target = Recorder::sized(64, 48);
        library
            .place(&mesh, &model.library())
            .with_cull(Cull::None)
            .faces(|face| Shader(face as u16))
            .draw(&mut target)
            .expect("no error");
        // The quadrangle split along its other diagonal, seen from either side.
        let other = [[0, 1, 3], [1, 2, 3], [3, 1, 0], [3, 2, 1]];
        let seen = eye::faces(&camera.exact(), &model.exact(), &positions, &other);
        for (x, y) in Area::new(0, 0, 64, 48).pixels() {
            let count = target.count(x as i32, y as i32);
            match eye::pixel(&seen, (x, y), false, 0.75) {
                Ok(Some(_)) => {
                    once += 1;
                    assert_eq!(count, 1, "({x}, {y}): {camera:?} {corners:?}");
                }
                Ok(None) => assert_eq!(count, 0, "({x}, {y}): {camera:?} {corners:?}"),
                Err(()) => assert!(count <= 1, "({x}, {y}): {camera:?} {corners:?}"),
            }
        }
    }
    assert!(once > 500_000, "{once}");
}
