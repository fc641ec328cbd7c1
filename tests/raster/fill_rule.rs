//! R1–R7 and R9: the library's coverage equals the exact edge functions, with no tolerance. Scissors, of lines too, and errors.

use embedded_graphics::pixelcolor::BinaryColor;
use pinhole::draw::fill_triangle;
use support::bridge;
use support::bridge::compare;
use support::oracle;
use support::oracle::cases::GUARD;
use support::oracle::coverage::{triangle, Area, P};
use support::oracle::rng::Rng;
use support::oracle::target::{Recorder, Refused};

/// All ordered triples of points on a square lattice, repeated points included.
fn exhaustive(side: i64, step: i64, origin: P, area: Area) {
    let n = side * side;
    let at = |k: i64| (origin.0 + step * (k % side), origin.1 + step * (k / side));
    for a in 0..n {
        for b in 0..n {
            for c in 0..n {
                compare::triangle([at(a), at(b), at(c)], area);
            }
        }
    }
}

#[test]
fn r2_r5_every_triangle_on_small_lattices() {
    for (side, step, origin, area) in [
        // On half pixels, and across the origin.
        (5, 128, (0, 0), Area::new(-1, -1, 3, 3)),
        (6, 128, (-384, -384), Area::new(-3, -3, 3, 3)),
        // On centres.
        (6, 256, (-128, 128), Area::new(-2, -1, 7, 7)),
        // On quarter pixels.
        (7, 64, (-64, -64), Area::new(-1, -1, 2, 2)),
        // On sub-pixels around a centre, and around a corner, where nothing is covered.
        (7, 1, (128 - 3, 128 - 3), Area::new(-1, -1, 2, 2)),
        (4, 1, (256 - 2, 256 - 1), Area::new(-1, -1, 3, 3)),
    ] {
        exhaustive(side, step, origin, area);
    }
}

/// (g, s, t) with a·s + b·t = g.
fn euclid(a: i64, b: i64) -> (i64, i64, i64) {
    if b == 0 {
        (a, 1, 0)
    } else {
        let (g, s, t) = euclid(b, a % b);
        (g, t, s - a / b * t)
    }
}

/// The hardest centres for anything that steps: the exact crossing is r/dy sub-pixels from the
/// centre, r = −1, 0, 1 times the gcd, as many rows below the edge's start as there are.
fn near_misses(seed: u64, count: usize, limits: &[(i64, i64)], fars: &[i64]) {
    let mut rng = Rng::new(seed);
    let mut near = 0;
    while near < count {
        let (limit_x, limit_y) = limits[rng.below(limits.len())];
        let side = |rng: &mut Rng, limit: i64| match rng.below(3) {
            0 => limit - rng.int(0, 3),
            1 => rng.int(limit / 2, limit),
            _ => rng.log(200.0, limit as f64) as i64,
        };
        let (dx, dy) = (side(&mut rng, limit_x) * [1, -1][rng.below(2)], side(&mut rng, limit_y));
        let (g, s, t) = euclid(dx.abs(), dy);
        let r = g * rng.int(-1, 1);
        // dx·my − dy·mx = r
        let (my, mx) = (dx.signum() * s * (r / g), -t * (r / g));
        assert_eq!(dx * my - dy * mx, r);
        // Shift by whole periods of the edge, so that it lies on the edge, far down if it may.
        let k = (dy - 1 - my).div_euclid(dy / g);
        let (mx, my) = (mx + k * (dx / g), my + k * (dy / g));
        if my < 1 || my >= dy {
            continue;
        }
        let reach = GUARD - 2 * (1 << 17);
        let (cx, cy) = oracle::coverage::centre(rng.int(-20, 20), rng.int(-20, 20));
        let a = (cx - mx, cy - my);
        let b = (a.0 + dx, a.1 + dy);
        if [a.0, a.1, b.0, b.1].iter().any(|c| c.abs() > reach) {
            continue;
        }
        near += 1;
        let far = fars[rng.below(fars.len())];
        let c = (cx + [far, -far][rng.below(2)], [a.1, b.1, cy, rng.int(a.1, b.1)][rng.below(4)]);
        let (x, y) = (cx.div_euclid(256), cy.div_euclid(256));
        let area = Area::new(x - 1, y - 1, x + 2, y + 2);
        let above = (my / 256 + 2).min(3000);
        compare::triangle_from_above([a, b, c], area, above);
        compare::triangle([a, b, c], area);
    }
}

#[test]
fn r9_edges_that_pass_a_centre_within_one_lattice_unit() {
    let limits = [1 << 17, 1 << 17, 1 << 18, 1 << 21].map(|limit| (limit, limit));
    near_misses(0x95, 12_000, &limits, &[1 << 12, 1 << 17, 1 << 18]);
}

/// On both sides of the 32 pixels within which one digit is enough for an edge.
#[test]
fn r9_short_edges_that_pass_a_centre_within_one_lattice_unit() {
    let limits = [(1 << 13, 1 << 14), (1 << 13, 1 << 14), (1 << 10, 1 << 14), (1 << 14, 1 << 15)];
    near_misses(0x96, 40_000, &limits, &[300, 1 << 11, 1 << 12, 1 << 13]);
}

#[test]
fn scissors_of_extreme_bounds_crop_and_do_not_panic() {
    let t = [(-700, -300), (2000, 50), (300, 2400)];
    let (low, high) = (i64::from(i32::MIN), i64::from(i32::MAX));
    let all = Area::new(-20, -20, 40, 40);
    let whole = bridge::triangle(t, all);
    assert!(whole.total() > 20);
    let exact = triangle(t, all);
    assert_eq!(whole, exact);
    let spans = bridge::triangle_spans(t, Area::new(low, low, high, high));
    assert_eq!(bridge::counts(&spans, all), whole);
    for (l, t0, r, b) in [
        (5, 5, 5, 5),
        (9, 0, 3, 20), // inside out
        (0, 9, 20, 3),
        (high, high, low, low),
        (low, low, low, high),
        (high, low, high, high),
        (low, low, low + 1, high),
        (high - 1, low, high, high),
        (8000, 8000, 8100, 8100),
        (low, high - 1, high, high),
    ] {
        let area = Area::new(l, t0, r, b);
        let spans = [bridge::triangle_spans(t, area), bridge::line_spans((-3, -4), (20, 11), area)].concat();
        assert!(spans.is_empty(), "{spans:?}");
    }
}

/// Errors while lines are drawn are in `lines.rs`.
#[test]
fn an_error_of_the_target_ends_a_triangle_and_is_returned() {
    let corners = [(0, 0), (4000, 100), (300, 4000)].map(bridge::screen_point);
    for n in 0..=15 {
        let mut target = Recorder::failing(16, 16, n);
        let result = fill_triangle(corners, BinaryColor::On, &mut target);
        let wanted = if n < 15 { (Err(Refused(n)), n + 1) } else { (Ok(()), 15) };
        assert_eq!((result, target.calls.len()), wanted);
    }
}
