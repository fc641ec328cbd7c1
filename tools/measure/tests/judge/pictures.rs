//! Complete pictures against an oracle that knows the scene only from the file that `--used` wrote.
//!
//! 100 random scenes of each kind; `PINHOLE_FULL=1 cargo test -p pinhole-measure pictures -- --nocapture` draws 3000.

use crate::harness::{used, Drawn, Folder};
use pinhole_apps_support::bodies::{cuboid, moved, torus, Body};
use serde_json::{json, Value};
use std::path::Path;
use support::oracle;
use support::oracle::chain::{matmul4, M4, V3};
use support::oracle::picture::{compare, Comparison};
use support::oracle::rng::Rng;

/// The picture against the scene that `--used` names.
fn judge(drawn: &Drawn) -> Comparison {
    compare(&used(&drawn.used), &drawn.ids, &drawn.depth)
}

/// The largest move of an edge that a picture may need: half a sub-pixel along both
/// axes is 0.00276; the largest met is below it, as all three corners would have to be at their worst.
const SHIFT: f64 = 0.0025;
/// The documented bound: half a step for rounding, and what stepping and the corners' rounding add. What the
/// chain leaves the corners' depths is the oracle's to allow, by its own documented budget.
const DEPTH: f64 = 0.54;
/// Faces that reach far end half a step before it.
const DEPTH_AT_FAR: f64 = 1.1;

fn is_explained(found: &Comparison) -> bool {
    found.shift <= SHIFT && found.depth <= DEPTH && found.depth_at_far <= DEPTH_AT_FAR
}

#[test]
fn the_samples_are_explained_by_moving_edges_less_than_half_a_sub_pixel() {
    let to = Folder::new("samples");
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/scenes");
    let files = std::fs::read_dir(samples).unwrap().map(|entry| entry.unwrap().path());
    for file in files.filter(|file| file.extension().is_some_and(|e| e == "json")) {
        let name = file.display();
        let found = judge(&to.draw_file(file.to_str().unwrap(), "", false));
        println!("{name}: {found:?}");
        assert!(found.covered * 10 > found.pixels, "{name} shows little: {found:?}");
        assert!(is_explained(&found), "{name}: {found:?}");
    }
}

/// Random tetrahedra: they pierce each other and themselves cover little, slivers among them.
fn splinters(rng: &mut Rng) -> Body {
    let mut body = Body::new();
    for _ in 0..40 {
        let at = [0; 3].map(|_| rng.real(-1.0, 1.0));
        let size = rng.log(0.01, 1.0);
        let corners = [0; 4].map(|_| at.map(|c| c + rng.real(-size, size)));
        body.extend([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(|t| t.map(|i: usize| corners[i])));
    }
    body
}

fn rotation(rng: &mut Rng) -> M4 {
    let w = rng.direction();
    let helper = if w[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let u = oracle::chain::normalise(oracle::chain::cross(helper, w));
    let v = oracle::chain::cross(w, u);
    let row = |a: V3| [a[0], a[1], a[2], 0.0];
    [row(u), row(v), row(w), [0.0, 0.0, 0.0, 1.0]]
}

fn random_body(rng: &mut Rng) -> Body {
    match rng.below(3) {
        0 => torus(1.0, rng.real(0.1, 0.6), 3 + rng.below(20), 3 + rng.below(12)),
        1 => moved(&cuboid([2.0; 3]), |corner| corner.map(|c| c - 1.0)),
        _ => splinters(rng),
    }
}

/// A random scene of a closed mesh; the camera stands outside, inside, or in its surface.
fn random_scene(rng: &mut Rng, body: &Body, far_from_origin: bool) -> Value {
    let triangles: Vec<_> = (0..body.len()).map(|i| [0, 1, 2].map(|corner| 3 * i + corner)).collect();
    let size = rng.log(0.01, 100.0);
    let mut model = rotation(rng);
    for row in model.iter_mut().take(3) {
        let stretch = [1.0, rng.real(0.5, 1.0)][rng.below(2)];
        row.iter_mut().for_each(|c| *c *= size * stretch);
    }
    // A mesh may stand far from its own origin.
    let own = [0.0, rng.log(10.0, 1e6)][rng.below(2)];
    let own: V3 = [0; 3].map(|_| rng.real(-own, own));
    let vertices: Vec<V3> = body.iter().flatten().map(|v| core::array::from_fn(|i| v[i] + own[i])).collect();
    let place = if far_from_origin { 20_000.0 } else { size };
    let at: V3 = [0; 3].map(|_| rng.real(-place, place));
    for (row, c) in model.iter_mut().zip(at) {
        row[3] = c - (row[0] * own[0] + row[1] * own[1] + row[2] * own[2]);
    }
    // The camera looks at a point of the mesh's surroundings.
    let distance = size * [rng.real(1.5, 5.0), rng.real(0.0, 1.0), rng.real(0.7, 1.5)][rng.below(3)];
    let mut view = rotation(rng);
    let eye: V3 = core::array::from_fn(|i| at[i] + view[2][i] * distance + rng.real(-0.2, 0.2) * size);
    for row in view.iter_mut().take(3) {
        row[3] = -(row[0] * eye[0] + row[1] * eye[1] + row[2] * eye[2]);
    }
    let (width, height) = (rng.int(40, 200), rng.int(40, 160));
    let near = size * rng.log(0.01, 0.5);
    let far = size * rng.real(4.0, 20.0);
    let half = rng.real(0.2, 1.0);
    let aspect = width as f64 / height as f64;
    let kind = rng.below(4);
    let (is_parallel, is_askew) = (kind == 0, kind == 1);
    let lens = if is_parallel { oracle::chain::orthographic } else { oracle::chain::frustum };
    let half = half * if is_parallel { 2.0 * size } else { near };
    let [x, y] = [0; 2].map(|_| if is_askew { rng.real(-0.5, 0.5) * half } else { 0.0 });
    let across = if is_askew { half } else { half * aspect };
    let projection = lens(x - across, x + across, y - half, y + half, near, far);
    // It stands for itself times any factor, and takes a turn of the view as well as any other matrix.
    let projection = match rng.below(3) {
        0 => matmul4(&projection, &rotation_about_z(rng)).map(|row| row.map(|c| c * 3.7e-5)),
        _ => projection,
    };
    let viewport = match rng.below(3) {
        0 => vec![rng.int(-60, 60), rng.int(-60, 60), rng.int(60, 300), rng.int(60, 300)],
        _ => vec![0, 0, width, height],
    };
    json!({
        "vertices": vertices, "triangles": triangles,
        "model": model, "view": view, "projection": projection,
        "width": width, "height": height, "viewport": viewport,
        "cull": if rng.one_in(2) { "none" } else { "back" },
    })
}

fn rotation_about_z(rng: &mut Rng) -> M4 {
    let (s, c) = rng.real(0.0, 6.3).sin_cos();
    [[c, -s, 0.0, 0.0], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

fn random_scenes(name: &str, seed: u64, far_from_origin: bool) {
    let to = Folder::new(name);
    let mut rng = Rng::new(seed);
    let mut all = Comparison::default();
    let count = if std::env::var_os("PINHOLE_FULL").is_some() { 3000 } else { 100 };
    for _ in 0..count {
        let body = random_body(&mut rng);
        let scene = random_scene(&mut rng, &body, far_from_origin);
        let found = judge(&to.draw(&scene, ""));
        assert!(is_explained(&found), "{found:?}: {scene}");
        all.add(&found);
    }
    println!("{name}, {count} scenes: {all:?}");
    assert!(all.covered * 10 > all.pixels, "{all:?}");
    // The bound is no more than twice what is met.
    assert!(all.shift * 2.0 > SHIFT && all.depth * 2.0 > DEPTH, "{all:?}");
}

#[test]
fn a_mesh_of_more_vertices_than_16_bits_name_is_explained() {
    // 24 000 triangles with corners of their own.
    let scene = random_scene(&mut Rng::new(3), &torus(1.0, 0.4, 150, 80), false);
    let drawn = Folder::new("large").draw(&scene, "");
    let found = judge(&drawn);
    assert!(is_explained(&found) && found.covered * 10 > found.pixels, "{found:?}");
    assert!(drawn.ids.iter().max().unwrap() > &21_845, "the last part is there, too");
}

#[test]
fn random_closed_meshes_are_explained_from_outside_from_inside_and_through_near() {
    random_scenes("near", 1, false);
}

#[test]
fn random_closed_meshes_are_explained_20000_units_from_the_origin() {
    random_scenes("far", 2, true);
}
