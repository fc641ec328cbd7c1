//! Points among the depths of lines, and paths of edges that the near plane cuts. Points without depth are compared with their
//! projections by `fuzz/targets/scene/whole.rs`.

use embedded_graphics::prelude::*;
use pinhole::{camera::Projected, prelude::*, target::DepthTestedSurface};
use std::collections::BTreeMap;
use support::bridge::draw::{wireframe, Shader};
use support::bridge::pair::{CameraBits, ModelBits, ONE};
use support::oracle::chain;
use support::oracle::coverage::Area;
use support::oracle::line;
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const SIZE: u32 = 64;

/// With depth, points are the pixels of their projections, among the depths of a line.
#[test]
fn points_are_tested_and_stored_in_a_depth_buffer() {
    let mut rng = Rng::new(0x74);
    let camera = CameraBits::perspective(1 << 30, (SIZE, SIZE), ONE, 5 * ONE);
    let (library, model) = (camera.library(), ModelBits::default().library());
    let (mut hidden, mut shown) = (0, 0);
    for _ in 0..500 {
        let vertices: [[i16; 3]; 20] = core::array::from_fn(|_| {
            [rng.int(-400, 400), rng.int(-400, 400), rng.int(-1500, 0)].map(|c| c as i16)
        });
        let mesh = Mesh::new(&vertices, -8, &[]).and_then(|mesh| mesh.with_edges(&[[0, 1]])).expect("a mesh");
        let instance = library.place(&mesh, &model);
        let drawn = |draw: &dyn Fn(&mut DepthTestedSurface<'_, '_, Recorder<Shader>>)| {
            let (mut target, mut depths) = (Recorder::sized(SIZE, SIZE), [0; (SIZE * SIZE) as usize]);
            let mut depth = DepthBuffer::new(target.bounding_box(), &mut depths).expect("enough");
            let mut tested = target.depth_tested(&mut depth);
            instance.edges(|_| Shader(1)).draw(&mut tested).expect("no error");
            draw(&mut tested);
            let pixels = target.pixels.into_iter().map(|(at, (shader, _))| (at, shader));
            (pixels.collect::<BTreeMap<_, _>>(), depths)
        };
        let (mut pixels, mut depths) = drawn(&|_| ());
        let after = drawn(&|target| {
            instance.points(Shader(2), target).expect("no error");
        });
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
        assert_eq!((pixels, depths), after);
    }
    assert!(hidden > 100 && shown > 2000, "{hidden} {shown}");
}

/// Cut at near: the pixels are the union of the cut lines, whose ends the f64 chain gives.
#[test]
fn paths_through_the_near_plane_are_cut_there() {
    let mut rng = Rng::new(0x73);
    let camera = CameraBits::perspective(1 << 30, (SIZE, SIZE), ONE, 50 * ONE);
    let (exact, model) = (camera.exact(), ModelBits::default());
    let edges: [[u16; 2]; 5] = core::array::from_fn(|i| [i as u16, i as u16 + 1]);
    let (mut cut, mut compared) = (0, 0);
    for _ in 0..3000 {
        let vertices: Vec<[i16; 3]> = (0..6)
            .map(|_| [rng.int(-600, 600) as i16, rng.int(-600, 600) as i16, rng.int(-1500, 300) as i16])
            .collect();
        let mesh = Mesh::new(&vertices, -8, &[]).and_then(|mesh| mesh.with_edges(&edges)).expect("a mesh");
        let mut target = Recorder::sized(SIZE, SIZE);
        let statistics =
            wireframe(&camera.library().place(&mesh, &model.library()), &mut target).expect("no error");
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
    }
    println!("{compared} paths, {cut} cut lines");
    assert!(compared > 1500 && cut > 1500);
}
