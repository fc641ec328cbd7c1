//! A0, A2, A3, A4, A6, A7: the fill rule of triangles and its ties.

use pinhole::{raster, Mesh};
use support::bridge::draw::{solid, Shader};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{self, compare, scalar};
use support::oracle::cases::GUARD;
use support::oracle::chain::{self, vertex};
use support::oracle::coverage::{self, centre, covers, edge, Area, P};
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
fn a0_vertices_are_snapped_to_24_8_after_the_divide() {
    let c = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective((1 << 31) / 3, (60, 40), ONE / 4, 100 * ONE),
        viewport: (0, 0, 60, 40),
    };
    let (library, exact, model) = (c.library(), c.exact(), ModelBits::default());
    let placed_model = model.library();
    let mut rng = Rng::new(0xA0);
    let mut compared = 0;
    while compared < 20_000 {
        // In 1/1024; not far off screen, so that size ÷ distance is about one.
        let z = rng.int(300, 30_000);
        let vertices = [(); 16].map(|()| [rng.int(-z, z), rng.int(-z, z), -z].map(|v| v as i16));
        let mesh = Mesh::new(&vertices, -10, &[]).expect("a mesh");
        let instance = library.place(&mesh, &placed_model);
        for (i, &v) in vertices.iter().enumerate() {
            let (x, y) = exact.screen(exact.clip(&model.exact(), vertex(v, -10)));
            // The chain is within a few 10⁻³ sub-pixels; closer to a tie it may go either way.
            let tie = |v: f64| ((256.0 * v).rem_euclid(1.0) - 0.5).abs() < 0.01;
            if tie(x) || tie(y) {
                continue;
            }
            let p = instance.project(i).expect("in the guard band").point;
            assert_eq!((i64::from(p.x()), i64::from(p.y())), chain::snap((x, y)), "{v:?}");
            compared += 1;
        }
    }
}

#[test]
fn a2_a_sliver_around_a_centre_hits_exactly_that_pixel() {
    for (x, y) in Area::new(-3, -3, 4, 4).pixels() {
        let (cx, cy) = coverage::centre(x, y);
        let area = Area::new(-5, -5, 6, 6);
        let t = [(cx - 1, cy - 1), (cx + 2, cy), (cx - 1, cy + 2)];
        let counts = bridge::triangle(t, area);
        assert_eq!(counts.total(), 1);
        assert_eq!(counts.at(x, y), 1);
    }
}

#[test]
fn a3_degenerate_triangles_cover_nothing() {
    // Every repeated or collinear triple of the half-pixel lattice, through centres, corners and borders.
    let at = |k: i64| (128 * (k % 7) - 256, 128 * (k / 7) - 256);
    let mut seen = 0;
    for a in 0..49 {
        for b in 0..49 {
            for c in (0..49).filter(|&c| edge(at(a), at(b), at(c)) == 0) {
                seen += 1;
                assert!(bridge::triangle_spans([at(a), at(b), at(c)], Area::new(-5, -5, 9, 9)).is_empty());
            }
        }
    }
    assert!(seen > 10_000);
    // As long as the band allows.
    let all = Area::new(-9000, -9000, 9000, 9000);
    for (a, b) in
        [((-GUARD, -GUARD), (GUARD, GUARD)), ((-GUARD, 128), (GUARD, 128)), ((128, -GUARD), (128, GUARD))]
    {
        let middle = ((a.0 + b.0) / 2, (a.1 + b.1) / 2);
        for t in [[a, b, middle], [middle, a, b], [a, middle, b], [a, a, b], [a, b, b], [b, a, b], [a, a, a]]
        {
            assert!(bridge::triangle_spans(t, all).is_empty(), "{t:?}");
        }
    }
}

#[test]
fn a3_degenerate_faces_are_counted_and_draw_nothing() {
    // In half pixels: on centres and borders; the last vertex repeats the first, the one before is collinear.
    let vertices = [[1i16, 1, 0], [9, 5, 0], [17, 9, 0], [5, 3, 0], [1, 1, 0]];
    let mut faces = Vec::new();
    for a in 0..5u16 {
        for b in 0..5 {
            faces.extend((0..5).map(|c| [a, b, c]));
        }
    }
    let mesh = Mesh::new(&vertices, -1, &faces).expect("a mesh");
    let (camera, model) = (flat().library(), before().library());
    let mut target = Recorder::<Shader>::sized(64, 64);
    let s = solid(&camera.place(&mesh, &model), &mut target).expect("no error");
    assert_eq!((s.degenerate as usize, s.drawn, s.culled), (faces.len(), 0, 0));
    assert!(target.calls.is_empty());
    // The degenerate faces moved across the near plane, which cuts them first.
    let model = ModelBits(vec![Step::Y(1 << 29), Step::Move([0, 0, -ONE])]).library();
    solid(&camera.place(&mesh, &model), &mut target).expect("no error");
    assert!(target.pixels.is_empty());
}

/// Whether a tie on an edge counts, from how the edge's function grows to the right and downwards.
type Ties = fn(i64, i64) -> bool;

/// Coverage with another rule for ties.
fn covers_by(ties: Ties, t: [P; 3], (i, j): P) -> bool {
    let (p, full) = (centre(i, j), edge(t[0], t[1], t[2]).signum());
    full != 0
        && (0..3).all(|k| {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            let e = full * edge(a, b, p);
            e > 0 || (e == 0 && ties(-full * (b.1 - a.1), full * (b.0 - a.0)))
        })
}

/// Rules that are wrong, but only in ties.
const WRONG: [(&str, Ties); 5] = [
    ("every border counts", |_, _| true),
    ("no border counts", |_, _| false),
    ("bottom instead of top", |right, down| right > 0 || (right == 0 && down < 0)),
    ("right instead of left", |right, down| right < 0 || (right == 0 && down > 0)),
    ("horizontal edges never count", |right, _| right > 0),
];

#[test]
fn a4_ties_on_centers_and_borders_follow_the_top_left_rule() {
    // All triangles of two lattices: each equals the exact rule, and each wrong rule is found hundreds of times.
    let (mut wrong, mut triangles) = ([0; WRONG.len()], 0);
    for (side, step, origin) in [(5, 128, -128), (4, 256, 128)] {
        let at = |k: i64| (origin + step * (k % side), origin + step * (k / side));
        let area = Area::new(-2, -2, 6, 6);
        for a in 0..side * side {
            for b in 0..side * side {
                for c in 0..side * side {
                    let t = [at(a), at(b), at(c)];
                    compare::triangle(t, area);
                    triangles += 1;
                    for (count, (_, ties)) in wrong.iter_mut().zip(WRONG) {
                        *count +=
                            u32::from(area.pixels().any(|p| covers_by(ties, t, p) != covers(t, p.0, p.1)));
                    }
                }
            }
        }
    }
    for (count, (name, _)) in wrong.into_iter().zip(WRONG) {
        println!("{name}: wrong in {count} of {triangles} triangles of the grids");
        assert!(count > 500, "{name}: {count}");
    }
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
fn a6_the_area_is_positive_counter_clockwise_with_y_up() {
    let mut rng = Rng::new(0xA6);
    for _ in 0..10_000 {
        let reach = 1i64 << rng.int(1, 21);
        let mut p = || (rng.int(-reach, reach), rng.int(-reach, reach));
        let t = [p(), p(), p()];
        // With y down, the edge function is negative for counter-clockwise with y up.
        assert_eq!(raster::area(&t.map(bridge::screen_point)), -coverage::edge(t[0], t[1], t[2]));
    }
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
