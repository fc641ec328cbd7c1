//! B1–B7: lines.

use embedded_graphics_core::primitives::Rectangle;
use pinhole::{raster, Mesh};
use support::bridge::draw::Shader;
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{self, compare};
use support::oracle::coverage::{Area, P};
use support::oracle::line;
use support::oracle::rng::Rng;
use support::oracle::target::{Call, Recorder};

#[test]
fn b1_lines_have_one_pixel_per_step_within_half_a_pixel() {
    let mut rng = Rng::new(0x11);
    let area = Area::new(-100, -100, 101, 101);
    for _ in 0..2000 {
        let mut p = || (rng.int(-100, 100), rng.int(-100, 100));
        let (a, b) = (p(), p());
        let counts = bridge::line(a, b, area);
        let major = (b.0 - a.0).abs().max((b.1 - a.1).abs());
        assert_eq!(counts.total(), major as u64 + 1);
        assert_eq!((counts.at(a.0, a.1), counts.at(b.0, b.1)), (1, 1));
        for (x, y) in area.pixels() {
            if counts.at(x, y) > 0 {
                assert!(line::within_half(a, b, (x, y)), "{a:?} {b:?} ({x}, {y})");
            }
        }
    }
}

#[test]
fn b2_a_tie_takes_the_smaller_minor_step() {
    // By hand. From the smaller end in (x, y): (0,0) → (2,1) passes (1, ½).
    let area = Area::new(0, 0, 3, 3);
    assert_eq!(bridge::line((0, 0), (2, 1), area).picture(), "11.\n..1\n...\n");
    assert_eq!(bridge::line((2, 0), (0, 1), area).picture(), "..1\n11.\n...\n");
    assert_eq!(bridge::line((0, 0), (1, 2), area).picture(), "1..\n1..\n.1.\n");
    assert_eq!(bridge::line((1, 0), (0, 2), area).picture(), ".1.\n1..\n1..\n");
}

#[test]
fn b3_reversal_and_b4_clipping_keep_every_pixel() {
    let mut rng = Rng::new(0xB4);
    let all = Area::new(-240, -240, 304, 304);
    let (mut turned, mut moved) = (0, 0);
    for _ in 0..6000 {
        let mut p = || (rng.int(-200, 263), rng.int(-200, 263));
        let (a, b) = (p(), p());
        let whole = bridge::line(a, b, all);
        assert_eq!(whole, line::line(a, b, all));
        // About a pixel of the line.
        let k = rng.int(0, 64);
        let (x, y) =
            (a.0 + (b.0 - a.0) * k / 64 - rng.int(0, 30), a.1 + (b.1 - a.1) * k / 64 - rng.int(0, 30));
        let window = Area::new(x, y, x + rng.int(1, 40), y + rng.int(1, 40));
        let (there, back) = (bridge::line(a, b, window), bridge::line(b, a, window));
        assert_eq!(there, back);
        for (x, y) in window.pixels() {
            assert_eq!(there.at(x, y), whole.at(x, y), "{a:?} {b:?} {window:?} at ({x}, {y})");
        }
        // The cases have teeth: a walk from the other end, and clipping to integer ends, would draw other pixels.
        let half_turn = |p: P| (63 - p.0, 63 - p.1);
        let other = line::line(half_turn(a), half_turn(b), all);
        turned += u32::from(all.pixels().any(|(x, y)| whole.at(x, y) != other.at(63 - x, 63 - y)));
        if let [first, .., last] = line::clipped(a, b, window)[..] {
            moved += u32::from(line::line(first, last, window) != there);
        }
    }
    assert!(turned > 500 && moved > 100, "{turned} {moved}");
}

#[test]
fn b5_the_longest_and_steepest_lines_match_exact_division() {
    let mut rng = Rng::new(0xB5);
    let far = 32767;
    let ends = [-far, -far + 1, -1, 0, 1, far - 1, far];
    for case in 0..300 {
        let mut c = || if case % 2 == 0 { ends[rng.below(ends.len())] } else { rng.int(-far, far) };
        let (a, b) = ((c(), c()), (c(), c()));
        for s in [0, 1 << 19, rng.int(0, 1 << 20), 1 << 20] {
            let x = a.0 + (((b.0 - a.0) * s) >> 20) - rng.int(0, 8);
            let y = a.1 + (((b.1 - a.1) * s) >> 20) - rng.int(0, 8);
            compare::line_both_ways(a, b, Area::new(x, y, x + 9, y + 9));
        }
    }
}

#[test]
fn b5_every_pixel_of_the_longest_line_is_exact() {
    let far = 32767;
    let all = Area::new(i64::from(i32::MIN), i64::from(i32::MIN), i64::from(i32::MAX), i64::from(i32::MAX));
    for (a, b) in [
        ((-far, -far), (far, far - 1)),
        ((-far, far), (far, -far)),
        ((far, -far), (-far + 1, far)),
        ((-far, 0), (far, 1)),
        ((-far, 5), (far, 5)),
        ((5, -far), (5, far)),
    ] {
        let mut pixels: Vec<P> = Vec::new();
        for s in bridge::line_spans(a, b, all) {
            for y in 0..i64::from(s.height) {
                for x in 0..i64::from(s.width) {
                    pixels.push((i64::from(s.x) + x, i64::from(s.y) + y));
                }
            }
        }
        let mut exact = line::pixels(a, b);
        pixels.sort_unstable();
        exact.sort_unstable();
        assert!(pixels == exact, "{a:?} {b:?}");
    }
}

#[test]
fn b5_the_type_refuses_coordinates_beyond_16_bits() {
    // i32 ends would need 33-bit deltas: they have no way in.
    let door: fn(i16, i16) -> raster::Pixel = |x, y| raster::Pixel { x, y };
    assert_eq!(door(i16::MAX, -i16::MAX), bridge::pixel((32_767, -32_767)));
}

#[test]
fn b5_the_coordinate_minus_32768_draws_without_wrapping() {
    // The documented range ends at −32767; the type holds one more. No panic, no wrapped line.
    let low = -32768;
    for (a, b) in [
        ((low, low), (32767, 32767)),
        ((low, 32767), (32767, low)),
        ((low, 0), (32767, 1)),
        ((0, low), (1, 32767)),
        ((low, low), (low, low)),
        ((low, 3), (low + 9, 5)),
    ] {
        for s in [0, 1 << 19, 1 << 20] {
            let x = a.0 + (((b.0 - a.0) * s) >> 20);
            let y = a.1 + (((b.1 - a.1) * s) >> 20);
            compare::line_both_ways(a, b, Area::new(x - 5, y - 5, x + 6, y + 6));
        }
    }
}

#[test]
fn b6_horizontal_and_vertical_lines_are_one_span() {
    let area = Area::new(-10, -10, 30, 30);
    for (a, b, n) in [
        ((0, 3), (20, 3), 1),
        ((-50, 3), (50, 3), 1),
        ((4, 0), (4, 29), 1),
        ((4, 90), (4, -90), 1),
        ((4, 4), (4, 4), 1),
        ((0, 0), (9, 9), 10),
        ((0, 40), (20, 40), 0),
    ] {
        assert_eq!(bridge::line_spans(a, b, area).len(), n);
        compare::line_both_ways(a, b, area);
    }
}

#[test]
fn b6_diagonals_take_one_pixel_a_row() {
    let area = Area::new(-40, -40, 41, 41);
    for n in 0..40 {
        for (x, y) in [(n, n), (n, -n), (-n, n), (-n, -n)] {
            let counts = bridge::line((0, 0), (x, y), area);
            assert_eq!(counts.total(), n as u64 + 1);
            assert!((0..=n).all(|k| counts.at(k * x.signum(), k * y.signum()) == 1));
            compare::line_both_ways((0, 0), (x, y), area);
        }
    }
}

#[test]
fn b7_the_first_line_draws_the_pixel_of_a_joint() {
    // A box in which a unit is a pixel. A poly-line draws a joint once, with the line that ends there; edges of a
    // wireframe know nothing of each other and draw it each.
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([0, 32 * ONE, -32 * ONE, 0], ONE, 100 * ONE),
        viewport: (0, 0, 32, 32),
    };
    let (library, model) = (camera.library(), ModelBits(vec![Step::Move([0, 0, -9 * ONE])]).library());
    for path in [
        [(3, 3), (20, 3), (20, 29)],
        [(3, 3), (20, 10), (5, 17)],
        [(30, 2), (16, 16), (1, 30)],
        [(30, 2), (16, 16), (17, 16)],
    ] {
        // In half pixels, at the centres.
        let vertices = path.map(|(x, y)| [2 * x + 1, -(2 * y + 1), 0]);
        let mesh =
            Mesh::new(&vertices, -1, &[]).and_then(|m| m.with_edges(&[[0, 1], [1, 2]])).expect("a mesh");
        let instance = library.place(&mesh, &model);
        let (mut once, mut each) = (Recorder::<Shader>::sized(32, 32), Recorder::<Shader>::sized(32, 32));
        instance.polyline(Shader(1), &mut once).expect("no error");
        instance.wireframe(Shader(1), &mut [], &mut each).expect("no error");
        let [a, joint, b] = path.map(|(x, y)| (i64::from(x), i64::from(y)));
        let area = Area::new(0, 0, 32, 32);
        for (x, y) in area.pixels() {
            let lines = [line::line(a, joint, area).at(x, y), line::line(joint, b, area).at(x, y)];
            let met = lines[0] + lines[1];
            assert_eq!(each.count(x as i32, y as i32), met, "({x}, {y}) of {path:?}");
            let joined = u32::from((x, y) == joint);
            assert_eq!(once.count(x as i32, y as i32), met - joined, "({x}, {y}) of {path:?}");
        }
        // The joint comes with the first line's pixels: before any that the second line has alone.
        let spans: Vec<_> = once
            .calls
            .iter()
            .filter_map(|c| match c {
                Call::Solid(span, _) => Some(*span),
                _ => None,
            })
            .collect();
        let holds = |s: &Rectangle, p: (i64, i64)| {
            let (dx, dy) = (p.0 - i64::from(s.top_left.x), p.1 - i64::from(s.top_left.y));
            dx >= 0 && dy >= 0 && dx < i64::from(s.size.width) && dy < i64::from(s.size.height)
        };
        let first = |p: (i64, i64)| spans.iter().position(|s| holds(s, p)).expect("drawn");
        assert!(first(joint) < first(b), "{path:?}");
        assert!(line::pixels(a, joint).into_iter().all(|p| first(p) < first(b)), "{path:?}");
    }
}
