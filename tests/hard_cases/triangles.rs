//! A0, A5 to A7: the fill rule of triangles by hand, the snap of their corners, and triangles as large as the guard band and larger.
//! `tests/raster` compares all triangles of small lattices, and a million random ones, with the exact rule: A2 to A5.

use crate::near_plane;
use pinhole::raster::ScreenPoint;
use pinhole::Mesh;
use support::bridge::draw::{solid, Shader};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{self, scalar};
use support::oracle::cases::GUARD;
use support::oracle::chain::vertex;
use support::oracle::coverage::{self, edge, Area};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

/// A box in which a world unit is a pixel: x and -y of the world are x and y of the screen, on both sides of zero.
fn flat() -> CameraBits {
    CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([-32 * ONE, 32 * ONE, -32 * ONE, 32 * ONE], ONE, 100 * ONE),
        viewport: (-32, -32, 64, 64),
    }
}

/// Ten units before the camera.
fn before() -> ModelBits {
    ModelBits(vec![Step::Move([0, 0, -10 * ONE])])
}

/// From 2⁻¹⁶ px to the nearest sub-pixel, ties up.
fn nearest(v: i64) -> i64 {
    (v + 128).div_euclid(256)
}

#[test]
fn a0_only_top_and_left_edges_cover_their_ties() {
    // A square from centre to centre, cut along either diagonal.
    let (a, b, c, d) = ((128, 128), (640, 128), (640, 640), (128, 640));
    for (t, picture) in [
        // The top row and the left column count, the right column and the bottom row do not.
        ([a, b, d], "11..\n1...\n....\n"),
        // Its diagonal is a left edge and counts, but for its ends on the right and bottom edges.
        ([b, c, d], "....\n.1..\n....\n"),
        // The diagonal from top left is a left edge here ...
        ([a, b, c], "11..\n.1..\n....\n"),
        // ... and a right edge here.
        ([a, c, d], "....\n1...\n....\n"),
    ] {
        assert_eq!(bridge::triangle(t, Area::new(0, 0, 4, 3)).picture(), picture, "{t:?}");
    }
    // A horizontal edge is a top edge only with the interior below it, whatever the third vertex's side.
    let row = |y: i64, third: i64| {
        bridge::triangle([(0, y), (1024, y), (512, third)], Area::new(0, 0, 4, 4)).hits[4..8]
            .iter()
            .sum::<u32>()
    };
    assert_eq!((row(384, 1024), row(384, 0)), (4, 0), "the edge runs through the centres of row 1");
    assert_eq!((row(385, 1024), row(383, 1024)), (0, 4), "one unit below them, and one above");
}

#[test]
fn a6_faces_are_culled_by_their_snapped_area() {
    let mut rng = Rng::new(0xA6);
    let (camera, model) = (flat().library(), before().library());
    let (mut turned, mut vanished, mut drawn) = (0, 0, 0);
    for _ in 0..20_000 {
        // A few sub-pixels large, in 2⁻¹⁶ px: the snap may turn it over or flatten it.
        // Half of them about a centre.
        let mut place = || 65536 * rng.int(0, 10) + if rng.one_in(2) { 32768 } else { rng.int(0, 65535) };
        let o = (place(), place());
        let mut p = || (o.0 + rng.int(-400, 400), o.1 + rng.int(-400, 400));
        let t = [p(), p(), p()];
        if t.iter().any(|p| p.0.rem_euclid(256) == 128 || p.1.rem_euclid(256) == 128) {
            continue; // a tie of the snap is A7's matter
        }
        let snapped = t.map(|p| (nearest(p.0), nearest(p.1)));
        let (exact, after) =
            (edge(t[0], t[1], t[2]).signum(), edge(snapped[0], snapped[1], snapped[2]).signum());
        turned += u32::from(exact * after < 0);
        vanished += u32::from(exact != 0 && after == 0);
        let vertices = t.map(|p| [scalar(p.0 as i32), scalar(-p.1 as i32), scalar(0)]);
        let mesh = Mesh::from_fixed(&vertices, &[[0, 1, 2]]).expect("a mesh");
        let mut target = Recorder::<Shader>::sized(16, 16);
        let s = solid(&camera.place(&mesh, &model), &mut target).expect("no error");
        // Front is counter-clockwise with y up.
        let wanted = [u32::from(after < 0), u32::from(after > 0), u32::from(after == 0)];
        assert_eq!([s.drawn, s.culled, s.degenerate], wanted, "{t:?} {snapped:?}");
        if after < 0 {
            let exact = coverage::triangle(snapped, Area::new(0, 0, 16, 16));
            drawn += exact.total();
            for (x, y) in exact.area.pixels() {
                assert_eq!(target.count(x as i32, y as i32), exact.at(x, y), "{t:?}");
            }
        }
    }
    println!("{turned} turned over by the snap, {vanished} flattened; {drawn} pixels drawn");
    assert!(turned > 50 && vanished > 50 && drawn > 0);
}

#[test]
fn a7_the_snap_rounds_to_nearest_on_both_sides_of_zero() {
    let (camera, model) = (flat().library(), before().library());
    // All positions within ±4 sub-pixels of the origin in steps of 2⁻¹⁶ px, and of some other points.
    let (mut floored, mut truncated, mut all) = (0, 0, 0);
    for about in [0, -65536, 65536, -31 * 65536, 31 * 65536, -(65536 / 2), 7 * 65536 + 91] {
        let offsets: Vec<i64> = (-1024..1024).map(|k| about + k).collect();
        let vertices: Vec<_> =
            offsets.iter().map(|&v| [scalar(v as i32), scalar(-v as i32), scalar(0)]).collect();
        let mesh = Mesh::from_fixed(&vertices, &[]).expect("a mesh");
        let instance = camera.place(&mesh, &model);
        let mut largest = 0;
        for (i, &v) in offsets.iter().enumerate() {
            let p = instance.project(i).expect("on the screen").point;
            let (x, y) = (i64::from(p.x()), i64::from(p.y()));
            // An exact tie may go down, because the reciprocal of w is rounded down before.
            let right = |c: i64| c == nearest(v) || (v.rem_euclid(256) == 128 && c == nearest(v) - 1);
            assert!(right(x) && right(y), "{v}·2⁻¹⁶ px: ({x}, {y})");
            largest = largest.max((256 * x - v).abs());
            // The grid shows both wrong roundings, `>>` and `/` without adding one half.
            floored += u32::from(x != v >> 8);
            truncated += u32::from(x != v / 256);
            all += 1;
        }
        // Half a sub-pixel; truncation would be twice as far off.
        assert_eq!(largest, 128);
    }
    assert!(3 * floored > all && 3 * truncated > all, "{floored} {truncated} of {all}");
}

#[test]
fn a5_every_row_of_the_guard_band_has_its_exact_span() {
    // Every row's first and last pixel of a triangle 16384 px high, against exact division.
    for t in [
        [(-GUARD, -GUARD), (GUARD, -GUARD + 1), (-GUARD + 1, GUARD)],
        [(-3, -GUARD), (GUARD, 77), (-GUARD + 128, GUARD)],
        [(128, -GUARD + 128), (GUARD - 128, 128), (-GUARD + 128, GUARD - 128)],
    ] {
        let all = Area::new(-9000, -9000, 9000, 9000);
        let spans = bridge::triangle_spans(t, all);
        assert!(spans.len() > 16_000);
        for s in spans {
            let (x, y, w) = (i64::from(s.x), i64::from(s.y), i64::from(s.width));
            assert_eq!(s.height, 1);
            assert!(coverage::covers(t, x, y) && !coverage::covers(t, x - 1, y));
            assert!(coverage::covers(t, x + w - 1, y) && !coverage::covers(t, x + w, y));
        }
    }
}

#[test]
fn a5_screen_points_end_at_the_guard_band() {
    let g = GUARD as i32;
    for (x, y) in [(g, g), (-g, -g), (g, -g), (0, 0)] {
        let p = ScreenPoint::from_subpixels(x, y).expect("inside");
        assert_eq!((p.x(), p.y()), (x, y));
    }
    for (x, y) in
        [(g + 1, 0), (0, g + 1), (-g - 1, 0), (0, -g - 1), (i32::MIN, 0), (0, i32::MIN), (i32::MAX, i32::MAX)]
    {
        assert!(ScreenPoint::from_subpixels(x, y).is_none(), "{x} {y}");
    }
}

#[test]
fn a5_faces_beyond_the_guard_band_are_cut_there() {
    // Vertices 2¹⁴ to 2²³ px off, through the longest lens: one that wraps would draw elsewhere.
    let camera = CameraBits::perspective((1 << 20) + 1, (24, 18), ONE / 4, 1000 * ONE);
    let focal = 9.0 / (core::f64::consts::PI / 4096.0).tan();
    let mut rng = Rng::new(0xA56);
    let (mut covered, mut background, mut cut) = (0, 0, 0);
    for _ in 0..4000 {
        // In 1/8 units. Two vertices of three may be seen.
        let vertices: [[i16; 3]; 3] = core::array::from_fn(|k| {
            let z = rng.real(2.5, 20.0);
            let far =
                if k > 0 && rng.one_in(3) { rng.log(4.0, 4096.0) } else { rng.log(16_384.0, 8_388_608.0) };
            let turn = rng.real(0.0, core::f64::consts::TAU);
            let at = |v: f64| (8.0 * v * far * z / focal).clamp(-32_000.0, 32_000.0) as i16;
            [at(turn.cos()), at(turn.sin()), (-8.0 * z) as i16]
        });
        let model = ModelBits::default();
        for faces in [[[0, 1, 2]], [[0, 2, 1]]] {
            // ARCHITECTURE's budget for half extent ÷ distance up to 1600: 12·2⁻³⁰·8192·1600 < 0.15 px.
            let t = near_plane::compare(&camera, &model, &vertices, -3, &faces, 0.15 + 1.0 / 64.0);
            (covered, background) = (covered + t.covered, background + t.background);
        }
        let mesh = Mesh::new(&vertices, -3, &[]).expect("a mesh");
        let (library, model_map) = (camera.library(), model.library());
        for (i, &v) in vertices.iter().enumerate() {
            let exact = camera.exact();
            let (x, y) = exact.screen(exact.clip(&model.exact(), vertex(v, -3)));
            if x.abs().max(y.abs()) > 8193.0 {
                cut += 1;
                assert_eq!(library.place(&mesh, &model_map).project(i).ok(), None, "({x}, {y})");
            }
        }
    }
    println!("{cut} vertices beyond the band; {covered} pixels covered, {background} background");
    assert!(cut > 6000 && covered > 50_000 && background > 50_000);
}
