//! A5: triangles of any size in the guard band are exact to the pixel; larger triangles are cut there first.

use crate::near_plane;
use pinhole::Mesh;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, ViewBits, ONE};
use support::bridge::{self, compare};
use support::oracle::cases::{window, GUARD};
use support::oracle::chain::vertex;
use support::oracle::coverage::{self, Area, P};
use support::oracle::rng::Rng;

/// Random triangles in windows about their vertices and borders, some of which are reached from far above.
fn cover_exactly(seed: u64, count: usize, triangle: impl Fn(&mut Rng) -> [P; 3]) {
    let mut rng = Rng::new(seed);
    for _ in 0..count {
        let t = triangle(&mut rng);
        for _ in 0..2 {
            let area = window(&mut rng, &t, 7);
            compare::triangle(t, area);
        }
        let area = window(&mut rng, &t, 5);
        let above = 1 << rng.int(0, 11);
        compare::triangle_from_above(t, area, above);
    }
}

fn of_corners(rng: &mut Rng, coordinate: impl Fn(&mut Rng) -> i64) -> [P; 3] {
    [(); 3].map(|()| (coordinate(rng), coordinate(rng)))
}

#[test]
fn a5_huge_triangles_cover_exactly() {
    // Anywhere in the guard band, on centres and borders, on the band's border, and with near and far corners.
    cover_exactly(0xA51, 15_000, |rng| of_corners(rng, |rng| rng.int(-GUARD, GUARD)));
    cover_exactly(0xA52, 15_000, |rng| of_corners(rng, |rng| 128 * rng.int(-GUARD / 128, GUARD / 128)));
    let limit = |rng: &mut Rng| match rng.below(4) {
        0 => -GUARD + rng.int(0, 2),
        1 => GUARD - rng.int(0, 2),
        2 => rng.int(-2, 2),
        _ => rng.int(-GUARD, GUARD),
    };
    cover_exactly(0xA53, 15_000, |rng| of_corners(rng, limit));
    let mixed = |rng: &mut Rng| {
        let reach = 1i64 << rng.int(1, 21);
        rng.int(-reach, reach)
    };
    cover_exactly(0xA54, 20_000, |rng| of_corners(rng, mixed));
}

#[test]
fn a5_huge_slivers_cover_exactly() {
    cover_exactly(0xA55, 15_000, |rng| {
        let [a, b, _] = of_corners(rng, |rng| rng.int(-GUARD, GUARD));
        let s = rng.int(0, 1 << 16);
        let mut on = |a: i64, b: i64| (a + (((b - a) * s) >> 16) + rng.int(-300, 300)).clamp(-GUARD, GUARD);
        [a, b, (on(a.0, b.0), on(a.1, b.1))]
    });
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
    use pinhole::raster::ScreenPoint;
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
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective((1 << 20) + 1, (24, 18), ONE / 4, 1000 * ONE),
        viewport: (0, 0, 24, 18),
    };
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
            let t = near_plane::compare(&camera, false, &model, &vertices, -3, &faces, 0.15 + 1.0 / 64.0);
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
