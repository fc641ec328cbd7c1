//! Drawing agrees with `project`: the exact coverage of the snapped triangle, the exact line
//! between the ends' pixels; faces are culled by the snapped area; every primitive is counted once.

use pinhole::raster::ScreenPoint;
use pinhole::{Cull, Mesh, Painter, ScreenVertex, Statistics};
use std::collections::BTreeMap;
use support::bridge::draw::Shader;
use support::bridge::pair::{bits, random_view, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::oracle::coverage::{self, Area};
use support::oracle::line;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const WIDTH: i64 = 40;
const HEIGHT: i64 = 30;

/// A random soup of faces and edges before a random camera.
struct Scene {
    camera: CameraBits,
    model: ModelBits,
    vertices: Vec<[i16; 3]>,
    faces: Vec<[u16; 3]>,
    edges: Vec<[u16; 2]>,
}

fn scene(rng: &mut Rng) -> Scene {
    let size = rng.log(0.5, 100.0);
    let distance = size * rng.log(0.3, 4.0);
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: if rng.one_in(4) {
            let w = (size * 65536.0) as i32;
            ProjectionBits::Orthographic([-w, w, -w, w], ONE / 4, 1000 * ONE)
        } else {
            ProjectionBits::Perspective(rng.int(1 << 28, 3 << 29) as u32, (4, 3), ONE / 4, 1000 * ONE)
        },
        viewport: (0, 0, WIDTH as u32, HEIGHT as u32),
    };
    let mut model = ModelBits::random_rotation(rng);
    let scale = (size / 32767.0 * 4096.0 * 65536.0) as i32;
    model.0.push(Step::Scale([scale; 3]));
    model.0.push(Step::Move(bits([0.0, 0.0, -distance]).expect("in range")));
    let n = rng.int(3, 12);
    let vertices = (0..n).map(|_| [0; 3].map(|_| rng.int(-32767, 32767) as i16)).collect::<Vec<[i16; 3]>>();
    let mut index = || rng.int(0, n - 1) as u16;
    let faces = (0..8).map(|_| [index(), index(), index()]).collect();
    let edges = (0..8).map(|_| [index(), index()]).collect();
    Scene { camera, model, vertices, faces, edges }
}

/// Coordinates in units of 2⁻¹² before the scale.
const EXPONENT: i8 = -12;

impl Scene {
    fn mesh(&self) -> Mesh<'_> {
        Mesh::new(&self.vertices, EXPONENT, &self.faces)
            .and_then(|m| m.with_edges(&self.edges))
            .expect("a mesh")
    }
}

fn at(p: ScreenPoint) -> (i64, i64) {
    (p.x().into(), p.y().into())
}

fn counts(target: &Recorder<Shader>) -> BTreeMap<(i32, i32), u32> {
    target.pixels.iter().map(|(&p, &(_, n))| (p, n)).collect()
}

fn total(s: Statistics) -> u32 {
    s.drawn + s.culled + s.outside + s.degenerate
}

#[test]
fn r9_faces_are_the_exact_coverage_of_their_corners() {
    let mut rng = Rng::new(0xD9);
    let (mut whole, mut drawn) = (0, 0);
    for _ in 0..1500 {
        let scene = scene(&mut rng);
        let (camera, model) = (scene.camera.library(), scene.model.library());
        for cull in [Cull::Back, Cull::None] {
            for face in &scene.faces {
                let one = [*face];
                let mesh = Mesh::new(&scene.vertices, EXPONENT, &one).expect("a mesh");
                let instance = camera.place(&mesh, &model).with_cull(cull);
                let corners = face.map(|i| instance.project(usize::from(i)).map(|seen| seen.point));
                let [Ok(a), Ok(b), Ok(c)] = corners else {
                    continue;
                };
                whole += 1;
                let mut target = Recorder::sized(WIDTH as u32, HEIGHT as u32);
                let mut cache = [ScreenVertex::default(); 12];
                let s = instance.solid(|_| Shader(1), &mut cache, &mut target).expect("no error");
                let t = [at(a), at(b), at(c)];
                // Front is counter-clockwise with y up: the edge function is negative with y down.
                let area = coverage::edge(t[0], t[1], t[2]);
                let visible = area != 0 && (area < 0 || cull == Cull::None);
                let mut wanted = BTreeMap::new();
                if visible {
                    for (x, y) in Area::new(0, 0, WIDTH, HEIGHT).pixels() {
                        if coverage::covers(t, x, y) {
                            wanted.insert((x as i32, y as i32), 1);
                        }
                    }
                }
                assert!(counts(&target) == wanted, "{:?} {:?} {t:?}", scene.camera, scene.model);
                drawn += usize::from(!wanted.is_empty());
                assert!(s.clipped <= s.drawn);
                let expected = match (area == 0, visible) {
                    (true, _) => (0, 0, 1),
                    (_, true) => (1, 0, 0),
                    _ => (0, 1, 0),
                };
                // A face that lies completely beside the viewport may only count as drawn.
                assert_eq!(
                    (s.drawn, s.culled, s.degenerate, s.outside),
                    (expected.0, expected.1, expected.2, 0)
                );
            }
        }
    }
    assert!(whole > 5000 && drawn > 1000, "{whole} {drawn}");
}

#[test]
fn l1_edges_are_the_exact_lines_between_their_ends() {
    let mut rng = Rng::new(0xDE);
    let mut drawn = 0;
    for _ in 0..1500 {
        let scene = scene(&mut rng);
        let (camera, model) = (scene.camera.library(), scene.model.library());
        for edge in &scene.edges {
            let one = [*edge];
            let mesh =
                Mesh::new(&scene.vertices, EXPONENT, &[]).and_then(|m| m.with_edges(&one)).expect("a mesh");
            let instance = camera.place(&mesh, &model);
            let [Ok(a), Ok(b)] = edge.map(|i| instance.project(usize::from(i)).map(|seen| seen.point)) else {
                continue;
            };
            let mut target = Recorder::sized(WIDTH as u32, HEIGHT as u32);
            instance.wireframe(Shader(1), &mut [], &mut target).expect("no error");
            let pixel = |p: ScreenPoint| {
                let (x, y) = at(p);
                (x.div_euclid(256), y.div_euclid(256))
            };
            let exact = line::clipped(pixel(a), pixel(b), Area::new(0, 0, WIDTH, HEIGHT));
            let wanted: BTreeMap<_, _> = exact.into_iter().map(|(x, y)| ((x as i32, y as i32), 1)).collect();
            assert!(counts(&target) == wanted, "{:?} {:?} {edge:?}", scene.camera, scene.model);
            drawn += usize::from(!wanted.is_empty());
        }
    }
    assert!(drawn > 2000, "{drawn}");
}

#[test]
fn l3_an_edge_is_the_same_from_both_ends_wherever_it_is_cut() {
    let mut rng = Rng::new(0xD3);
    let mut cut = 0;
    for _ in 0..1500 {
        let mut scene = scene(&mut rng);
        let (camera, model) = (scene.camera.library(), scene.model.library());
        let mut first = Recorder::sized(WIDTH as u32, HEIGHT as u32);
        let s =
            camera.place(&scene.mesh(), &model).wireframe(Shader(1), &mut [], &mut first).expect("no error");
        cut += s.clipped;
        for edge in &mut scene.edges {
            edge.swap(0, 1);
        }
        let mut second = Recorder::sized(WIDTH as u32, HEIGHT as u32);
        let t =
            camera.place(&scene.mesh(), &model).wireframe(Shader(1), &mut [], &mut second).expect("no error");
        assert_eq!(s, t);
        assert!(first.pixels == second.pixels, "{:?} {:?} {:?}", scene.camera, scene.model, scene.edges);
    }
    assert!(cut > 500);
}

#[test]
fn r7_a_face_is_the_same_from_every_corner_wherever_it_is_cut() {
    let mut rng = Rng::new(0xD7);
    let mut cut = 0;
    for _ in 0..1000 {
        let scene = scene(&mut rng);
        let (camera, model) = (scene.camera.library(), scene.model.library());
        for &[a, b, c] in &scene.faces {
            let mut pictures = Vec::new();
            for face in [[[a, b, c]], [[b, c, a]], [[c, a, b]]] {
                let mesh = Mesh::new(&scene.vertices, EXPONENT, &face).expect("a mesh");
                let mut target = Recorder::sized(WIDTH as u32, HEIGHT as u32);
                let s =
                    camera.place(&mesh, &model).solid(|_| Shader(1), &mut [], &mut target).expect("no error");
                cut += s.clipped;
                pictures.push((counts(&target), s));
            }
            assert!(
                pictures[0] == pictures[1] && pictures[1] == pictures[2],
                "{:?} {:?} {:?} of {:?}: {:?} {:?} {:?}",
                scene.camera,
                scene.model,
                [a, b, c],
                scene.vertices,
                pictures[0].1,
                pictures[1].1,
                pictures[2].1
            );
        }
    }
    assert!(cut > 500);
}

#[test]
fn every_primitive_is_counted_exactly_once() {
    let mut rng = Rng::new(0x57);
    let mut all = [0u32; 5];
    for _ in 0..1500 {
        let mut scene = scene(&mut rng);
        if rng.one_in(3) {
            scene.camera.view = random_view(&mut rng);
        }
        let (camera, model, mesh) = (scene.camera.library(), scene.model.library(), scene.mesh());
        let instance = camera.place(&mesh, &model);
        let mut target = Recorder::sized(WIDTH as u32, HEIGHT as u32);
        let mut shaded = 0;
        let s = instance
            .solid(
                |_| {
                    shaded += 1;
                    Shader(0)
                },
                &mut [],
                &mut target,
            )
            .expect("no error");
        assert_eq!(total(s) as usize, scene.faces.len());
        assert_eq!(shaded, s.drawn, "shade is asked once for each face drawn");
        assert!(s.clipped <= s.drawn);
        let w = instance.wireframe(Shader(0), &mut [], &mut target).expect("no error");
        assert_eq!(total(w) as usize, scene.edges.len());
        assert_eq!((w.culled, w.degenerate), (0, 0));
        let mut painter = Painter::<Shader, 200, 100>::new();
        painter.add(&instance, |_| Shader(0)).expect("enough room");
        assert_eq!(painter.draw(&mut target), Ok(s));
        for (sum, n) in all.iter_mut().zip([s.drawn, s.culled, s.clipped, s.outside, s.degenerate]) {
            *sum += n;
        }
    }
    assert!(all.iter().all(|&n| n > 100), "{all:?}");
}

#[test]
fn clipped_counts_what_was_cut_and_nothing_else() {
    // 90°, 15 px of focal length: a corner at x, z = −3 lies at 20 + 5·x px; the guard band ends at
    // ±8192.
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), ONE, 100 * ONE),
        viewport: (0, 0, 40, 30),
    }
    .library();
    let model = ModelBits::default().library();
    for (x, clipped) in [(1i16, 0), (300, 0), (810, 0), (1000, 0), (1600, 0), (1634, 0), (1635, 1), (9000, 1)]
    {
        let vertices = [[0, 0, -3], [x, -1, -3], [0, 2, -3]];
        let mesh =
            Mesh::new(&vertices, 0, &[[0, 1, 2]]).and_then(|m| m.with_edges(&[[0, 1]])).expect("a mesh");
        let instance = camera.place(&mesh, &model);
        assert_eq!(instance.project(1).is_err(), clipped == 1, "{x}");
        let mut target = Recorder::sized(WIDTH as u32, HEIGHT as u32);
        let faces = instance.solid(|_| Shader(0), &mut [], &mut target).expect("no error");
        let edges = instance.wireframe(Shader(0), &mut [], &mut target).expect("no error");
        assert_eq!((faces.drawn, faces.clipped), (1, clipped), "a face with a corner at {x}");
        assert_eq!((edges.drawn, edges.clipped), (1, clipped), "an edge with an end at {x}");
    }
}
