//! Polylines: a joint is drawn once, and the picture is the union of the lines of the line oracle. Closed figures, and lines that the
//! near plane and the guard band cut. Points are compared with their projections by `fuzz/targets/scene/whole.rs`.

use embedded_graphics::prelude::*;
use pinhole::{camera::Projected, draw::Statistics, prelude::*, target::DepthTestedSurface};
use std::collections::BTreeMap;
use support::bridge::draw::{wireframe, Shader};
use support::bridge::pair::{CameraBits, ModelBits, Step, ONE};
use support::oracle::chain;
use support::oracle::coverage::Area;
use support::oracle::line;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const SIZE: u32 = 64;

const FLAT: CameraBits = CameraBits::pixels((SIZE, SIZE));

fn draw(
    camera: &CameraBits,
    model: &ModelBits,
    vertices: &[[i16; 3]],
    exponent: i8,
) -> (Recorder<Shader>, Statistics) {
    let mesh = Mesh::new(vertices, exponent, &[]).expect("a mesh");
    let mut target = Recorder::sized(SIZE, SIZE);
    let placed_model = model.library();
    let library = camera.library();
    let instance = library.place(&mesh, &placed_model);
    let statistics = instance.polyline(Shader(1), &mut target).expect("no error");
    assert_eq!(target.outside, 0);
    (target, statistics)
}

/// Away from the viewer, so that the box holds it.
fn back() -> ModelBits {
    ModelBits(vec![Step::Move([0, 0, -10 * ONE])])
}

/// Vertices at pixel (x, y), in half pixels so that they lie in its middle.
fn in_pixels(path: &[(i64, i64)]) -> Vec<[i16; 3]> {
    path.iter().map(|&(x, y)| [(2 * x + 1) as i16, -(2 * y + 1) as i16, 0]).collect()
}

/// How many lines draw each pixel, and this count without the repeated joints.
fn oracle(path: &[(i64, i64)]) -> BTreeMap<(i32, i32), u32> {
    let area = Area::new(0, 0, SIZE.into(), SIZE.into());
    let mut counts: BTreeMap<(i32, i32), i32> = BTreeMap::new();
    for pair in path.windows(2) {
        for (x, y) in line::clipped(pair[0], pair[1], area) {
            *counts.entry((x as i32, y as i32)).or_insert(0) += 1;
        }
    }
    let inner = if path.len() > 2 { &path[1..path.len() - 1] } else { &[][..] };
    let closed = path.len() > 2 && path.first() == path.last();
    for &(x, y) in inner.iter().chain(closed.then(|| &path[0])) {
        if area.contains(x, y) {
            *counts.entry((x as i32, y as i32)).or_insert(0) -= 1;
        }
    }
    counts.into_iter().map(|(at, n): (_, i32)| (at, n.max(1) as u32)).collect()
}

fn check(path: &[(i64, i64)]) {
    let (target, statistics) = draw(&FLAT, &back(), &in_pixels(path), -1);
    let got: BTreeMap<_, _> = target.pixels.iter().map(|(&at, &(_, n))| (at, n)).collect();
    assert_eq!(got, oracle(path), "{path:?}\n{}", target.picture(SIZE as i32, SIZE as i32, |_| '#'));
    assert_eq!(statistics.drawn as usize, path.len().saturating_sub(1));
    assert_eq!((statistics.clipped, statistics.outside), (0, 0));
}

#[test]
fn joints_are_drawn_once() {
    check(&[(3, 3), (20, 3), (20, 30)]);
    check(&[(3, 3), (20, 10), (3, 17)]);
    check(&[(5, 5), (30, 5)]);
    // Closed figures.
    check(&[(10, 10), (40, 10), (40, 40), (10, 40), (10, 10)]);
    check(&[(10, 10), (40, 12), (22, 40), (10, 10)]);
    check(&[(30, 30), (31, 30), (30, 31), (30, 30)]);
    // There and back: the second line covers the first again, but for the joints.
    check(&[(10, 10), (40, 10), (10, 10)]);
    // Repeated vertices.
    check(&[(10, 10), (10, 10), (20, 10)]);
    check(&[(10, 10), (20, 10), (20, 10)]);
    check(&[(10, 10), (20, 10), (20, 10), (20, 10), (20, 20)]);
    check(&[(9, 9), (9, 9), (9, 9)]);
    // A corner in every pair of octants.
    for i in 0..16i32 {
        for j in 0..16i32 {
            let end = |k: i32| {
                let turn = f64::from(k) / 16.0 * core::f64::consts::TAU;
                (32 + (20.0 * turn.cos()).round() as i64, 32 + (20.0 * turn.sin()).round() as i64)
            };
            check(&[end(i), (32, 32), end(j)]);
        }
    }
}

/// Vertices too far from the viewport for a `ScreenVertex`: their joints are drawn once too.
#[test]
fn joints_far_out_in_a_wide_viewport_are_drawn_once() {
    const WIDTH: u32 = 4096;
    let camera = CameraBits::pixels((WIDTH, SIZE));
    let (open, closed) = ([(3, 3), (20, 3), (20, 30)], [(4000, 9), (4050, 9), (4020, 40), (4000, 9)]);
    for path in [&open[..], &closed] {
        let (vertices, model) = (in_pixels(path), back().library());
        let mesh = Mesh::new(&vertices, -1, &[]).expect("a mesh");
        let mut target = Recorder::sized(WIDTH, SIZE);
        let Ok(_) = camera.library().place(&mesh, &model).polyline(Shader(1), &mut target) else {
            panic!("a target")
        };
        for &(x, y) in path {
            assert_eq!(target.count(x as i32, y as i32), 1, "({x}, {y}) of {path:?}");
        }
    }
}

#[test]
fn random_paths_are_the_union_of_their_lines() {
    let mut rng = Rng::new(0x71);
    for _ in 0..3000 {
        let reach = [8, 30, 200][rng.below(3)];
        let mut path: Vec<(i64, i64)> = (0..2 + rng.below(8))
            .map(|_| (32 + rng.int(-reach, reach), 32 + rng.int(-reach, reach)))
            .collect();
        if rng.one_in(3) {
            path.push(path[0]);
        }
        check(&path);
    }
}

#[test]
fn a_polyline_of_fewer_than_two_vertices_draws_nothing() {
    for n in 0..2 {
        let (target, statistics) = draw(&FLAT, &back(), &in_pixels(&[(5, 5)][..n]), -1);
        assert!(target.pixels.is_empty());
        assert_eq!(statistics, Statistics::default());
    }
}

/// With depth, a polyline draws the pixels of its lines as edges do, and points those of their projections, among the depths of other lines.
#[test]
fn lines_and_points_are_tested_and_stored_in_a_depth_buffer() {
    let mut rng = Rng::new(0x74);
    let camera = CameraBits::perspective(1 << 30, (SIZE, SIZE), ONE, 5 * ONE);
    let (library, model) = (camera.library(), ModelBits::default().library());
    let edges = core::array::from_fn::<[u16; 2], 19, _>(|i| [i as u16, i as u16 + 1]);
    let (mut hidden, mut shown, mut clipped) = (0, 0, 0);
    for _ in 0..500 {
        let vertices: [[i16; 3]; 20] = core::array::from_fn(|_| {
            [rng.int(-400, 400), rng.int(-400, 400), rng.int(-1500, 0)].map(|c| c as i16)
        });
        let mesh = Mesh::new(&vertices, -8, &[]).and_then(|mesh| mesh.with_edges(&edges)).expect("a mesh");
        let instance = library.place(&mesh, &model);
        // After the first line of all, with its depths.
        let drawn = |draw: &dyn Fn(&mut DepthTestedSurface<'_, '_, Recorder<Shader>>) -> Statistics| {
            let (mut target, mut depths) = (Recorder::sized(SIZE, SIZE), [0; (SIZE * SIZE) as usize]);
            let mut depth = DepthBuffer::new(target.bounding_box(), &mut depths).expect("enough");
            let first = Mesh::new(&vertices[..2], -8, &[]).expect("a mesh");
            let mut tested = target.depth_tested(&mut depth);
            library.place(&first, &model).polyline(Shader(1), &mut tested).expect("no error");
            let statistics = draw(&mut tested);
            (
                target.pixels.into_iter().map(|(at, (shader, _))| (at, shader)).collect::<BTreeMap<_, _>>(),
                depths,
                statistics,
            )
        };
        let line = drawn(&|target| instance.polyline(Shader(2), target).expect("no error"));
        assert_eq!(line, drawn(&|target| instance.edges(|_| Shader(2)).draw(target).expect("no error")));
        clipped += line.2.clipped;

        let [before, after] = [
            drawn(&|_| Statistics::default()),
            drawn(&|target| instance.points(Shader(2), target).expect("no error")),
        ];
        let (mut pixels, mut depths) = (before.0, before.1);
        let is_before_far = |&index: &usize| vertices[index][2] >= -5 * 256;
        let projected =
            (0..vertices.len()).filter(is_before_far).filter_map(|index| instance.project(index).ok());
        for Projected { point, depth } in projected {
            let Point { x, y } = point.into();
            if !(0..SIZE as i32).contains(&x) || !(0..SIZE as i32).contains(&y) {
                continue;
            }
            let stored = &mut depths[(y * SIZE as i32 + x) as usize];
            if depth <= *stored {
                *stored = depth;
                pixels.insert((x, y), Shader(2));
                shown += 1;
            } else {
                hidden += 1;
            }
        }
        assert_eq!((&pixels, depths), (&after.0, after.1));
    }
    assert!(hidden > 100 && shown > 2000 && clipped > 500, "{hidden} {shown} {clipped}");
}

/// Cut at near: the pixels are the union of the cut lines, whose ends the f64 chain gives.
#[test]
fn paths_through_the_near_plane_are_cut_there() {
    let mut rng = Rng::new(0x73);
    let camera = CameraBits::perspective(1 << 30, (SIZE, SIZE), ONE, 50 * ONE);
    let (exact, model) = (camera.exact(), ModelBits::default());
    let (mut cut, mut compared) = (0, 0);
    for _ in 0..3000 {
        let vertices: Vec<[i16; 3]> = (0..6)
            .map(|_| [rng.int(-600, 600) as i16, rng.int(-600, 600) as i16, rng.int(-1500, 300) as i16])
            .collect();
        let (target, statistics) = draw(&camera, &model, &vertices, -8);
        let mut union = std::collections::BTreeSet::new();
        let mut sure = true;
        let (mut drawn, mut clipped, mut outside) = (0, 0, 0);
        for pair in vertices.windows(2) {
            let [mut a, mut b] =
                [pair[0], pair[1]].map(|v| exact.clip(&chain::IDENTITY, chain::vertex(v, -8)));
            let near = |p: [f64; 4]| p[2] + p[3];
            let (da, db) = (near(a), near(b));
            sure &= da.abs() > 1e-6 && db.abs() > 1e-6;
            if da < 0.0 && db < 0.0 {
                outside += 1;
                continue;
            }
            let between =
                |p: [f64; 4], q: [f64; 4], t: f64| core::array::from_fn(|i| p[i] + (q[i] - p[i]) * t);
            if da < 0.0 {
                a = between(b, a, db / (db - da));
            } else if db < 0.0 {
                b = between(a, b, da / (da - db));
            }
            clipped += usize::from(da < 0.0 || db < 0.0);
            drawn += 1;
            let ends = [a, b].map(|p| exact.screen(p));
            // Not where the pixel of an end hangs on the rounding.
            for c in ends.iter().flat_map(|e| [e.0, e.1]) {
                sure &= (c - c.round()).abs() > 0.008 && c.abs() < 8000.0;
            }
            let pixel = |p: (f64, f64)| (p.0.floor() as i64, p.1.floor() as i64);
            union.extend(line::clipped(
                pixel(ends[0]),
                pixel(ends[1]),
                Area::new(0, 0, SIZE.into(), SIZE.into()),
            ));
        }
        if !sure {
            continue;
        }
        compared += 1;
        cut += clipped;
        let got: std::collections::BTreeSet<_> =
            target.pixels.keys().map(|&(x, y)| (i64::from(x), i64::from(y))).collect();
        assert_eq!(got, union, "{vertices:?}");
        assert_eq!(
            (statistics.drawn as usize, statistics.clipped as usize, statistics.outside as usize),
            (drawn, clipped, outside)
        );
        // Edges are cut as the lines of a polyline are.
        let edges: Vec<[u16; 2]> = (1..vertices.len() as u16).map(|end| [end - 1, end]).collect();
        let mesh = Mesh::new(&vertices, -8, &[]).and_then(|mesh| mesh.with_edges(&edges)).expect("a mesh");
        let mut wire = Recorder::sized(SIZE, SIZE);
        let counted = wireframe(&camera.library().place(&mesh, &model.library()), &mut wire);
        assert_eq!(counted, Ok(statistics));
        assert!(wire.pixels.keys().eq(target.pixels.keys()));
    }
    println!("{compared} paths, {cut} cut lines");
    assert!(compared > 1500 && cut > 1500);
}
