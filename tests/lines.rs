//! L1–L3: line pixels equal the exact ones, in every octant, under every scissor, in every order
//! of the ends; runs leave as one span each.

mod bridge;
mod oracle;

use oracle::coverage::{Area, P};
use oracle::line;
use oracle::rng::Rng;

/// The library's pixels equal the oracle's, and leave in as few spans as there are runs.
fn same(a: P, b: P, area: Area) {
    let spans = bridge::line_spans(a, b, area);
    let (ours, exact) = (bridge::counts(&spans, area), line::line(a, b, area));
    assert!(ours == exact, "{a:?} {b:?}\nlibrary\n{ours:?}\nexact\n{exact:?}");
    let pixels = line::clipped(a, b, area);
    assert_eq!(spans.len(), line::runs(a, b, &pixels), "{a:?} {b:?} {area:?}: a span for each run");
}

fn both_ways(a: P, b: P, area: Area) {
    same(a, b, area);
    same(b, a, area);
}

#[test]
fn l1_every_pixel_is_within_half_a_pixel() {
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
fn l1_every_line_in_every_octant() {
    // All lines from one pixel to a 33 × 33 neighbourhood: all octants, all ties, zero length.
    let area = Area::new(-20, -20, 21, 21);
    for a in [(0, 0), (-1, 2)] {
        for (x, y) in Area::new(-16, -16, 17, 17).pixels() {
            both_ways(a, (x, y), area);
        }
    }
}

#[test]
fn b2_ties() {
    let area = Area::new(-70, -70, 71, 71);
    for (x, y) in [(2, 1), (63, 31), (62, 31), (64, 1), (64, 31), (4, 2), (6, 3)] {
        for (x, y) in [(x, y), (y, x)] {
            for (x, y) in [(x, y), (-x, y), (x, -y), (-x, -y)] {
                both_ways((0, 0), (x, y), area);
            }
        }
    }
}

#[test]
fn b2_the_tie_keeps_the_smaller_minor_step() {
    // By hand. From the smaller end in (x, y): (0,0) → (2,1) passes (1, ½).
    let area = Area::new(0, 0, 3, 3);
    assert_eq!(bridge::line((0, 0), (2, 1), area).picture(), "11.\n..1\n...\n");
    assert_eq!(bridge::line((2, 0), (0, 1), area).picture(), "..1\n11.\n...\n");
    assert_eq!(bridge::line((0, 0), (1, 2), area).picture(), "1..\n1..\n.1.\n");
    assert_eq!(bridge::line((1, 0), (0, 2), area).picture(), ".1.\n1..\n1..\n");
}

#[test]
fn l3_reversal() {
    let mut rng = Rng::new(0x13);
    let area = Area::new(0, 0, 64, 64);
    for _ in 0..5000 {
        let mut p = || (rng.int(0, 63), rng.int(0, 63));
        let (a, b) = (p(), p());
        assert_eq!(bridge::line(a, b, area), bridge::line(b, a, area));
    }
}

#[test]
fn l2_every_small_scissor() {
    // Every rectangle of a 9 × 9 field, on lines of every kind through it.
    let lines = [
        ((-3, 1), (11, 7)),
        ((0, 0), (8, 4)),
        ((1, -4), (4, 13)),
        ((8, 0), (0, 4)),
        ((12, -2), (-2, 9)),
        ((-5, -5), (12, 12)),
        ((-2, 10), (10, -2)),
        ((4, -9), (4, 20)),
        ((-9, 3), (20, 3)),
        ((4, 4), (4, 4)),
        ((-30, 2), (40, 5)),
        ((7, 40), (2, -41)),
    ];
    for (a, b) in lines {
        for l in 0..9 {
            for r in l..=9 {
                for t in 0..9 {
                    for d in t..=9 {
                        same(a, b, Area::new(l, t, r, d));
                    }
                }
            }
        }
    }
}

#[test]
fn l2_clipped_is_unclipped_cut() {
    let mut rng = Rng::new(0x12);
    for _ in 0..20_000 {
        let reach = [30, 300, 3000][rng.below(3)];
        let mut p = || (rng.int(-reach, reach), rng.int(-reach, reach));
        let (a, b) = (p(), p());
        // Somewhere on the line, so that most scissors meet it.
        let s = rng.int(0, 1024);
        let x = a.0 + (b.0 - a.0) * s / 1024 + rng.int(-12, 3);
        let y = a.1 + (b.1 - a.1) * s / 1024 + rng.int(-12, 3);
        both_ways(a, b, Area::new(x, y, x + rng.int(1, 20), y + rng.int(1, 20)));
    }
}

#[test]
fn l2_nearly_horizontal_and_nearly_vertical() {
    let mut rng = Rng::new(0x121);
    for _ in 0..2000 {
        let (long, short) = (rng.int(200, 4000), rng.int(-3, 3));
        let a = (rng.int(-50, 50), rng.int(-50, 50));
        for b in [(a.0 + long, a.1 + short), (a.0 + short, a.1 - long)] {
            let s = rng.int(0, 1024);
            let x = a.0 + (b.0 - a.0) * s / 1024 + rng.int(-12, 3);
            let y = a.1 + (b.1 - a.1) * s / 1024 + rng.int(-12, 3);
            both_ways(a, b, Area::new(x, y, x + rng.int(1, 20), y + rng.int(1, 20)));
        }
    }
}

#[test]
fn b5_extremes() {
    let mut rng = Rng::new(0xB5);
    let far = 32767;
    let ends = [-far, -far + 1, -1, 0, 1, far - 1, far];
    for _ in 0..150 {
        let mut c = || ends[rng.below(ends.len())];
        let (a, b) = ((c(), c()), (c(), c()));
        for s in [0, 1 << 19, rng.int(0, 1 << 20), 1 << 20] {
            let x = a.0 + (((b.0 - a.0) * s) >> 20) - rng.int(0, 8);
            let y = a.1 + (((b.1 - a.1) * s) >> 20) - rng.int(0, 8);
            both_ways(a, b, Area::new(x, y, x + 9, y + 9));
        }
    }
    for _ in 0..150 {
        let mut c = || rng.int(-far, far);
        let (a, b) = ((c(), c()), (c(), c()));
        for s in [0, rng.int(0, 1 << 20)] {
            let x = a.0 + (((b.0 - a.0) * s) >> 20) - rng.int(0, 8);
            let y = a.1 + (((b.1 - a.1) * s) >> 20) - rng.int(0, 8);
            both_ways(a, b, Area::new(x, y, x + 9, y + 9));
        }
    }
}

#[test]
fn b5_the_longest_line_whole() {
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
fn b5_the_last_value_of_i16() {
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
            both_ways(a, b, Area::new(x - 5, y - 5, x + 6, y + 6));
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
        both_ways(a, b, area);
    }
}

#[test]
fn b6_zero_length_is_one_pixel() {
    let area = Area::new(-2, -2, 3, 3);
    for (x, y) in area.pixels() {
        let counts = bridge::line((x, y), (x, y), area);
        assert_eq!((counts.total(), counts.at(x, y)), (1, 1));
    }
    assert_eq!(bridge::line((9, 9), (9, 9), area).total(), 0);
}

#[test]
fn scissors_of_every_extreme() {
    let (low, high) = (i64::from(i32::MIN), i64::from(i32::MAX));
    for (l, t, r, b) in [
        (5, 5, 5, 5),
        (9, 0, 3, 20), // inside out
        (0, 9, 20, 3),
        (high, high, low, low),
        (low, low, low, high),
        (high - 1, low, high, high),
        (low, low, low + 1, high),
        (low, high - 1, high, high),
    ] {
        let spans = bridge::line_spans((-3, -4), (20, 11), Area::new(l, t, r, b));
        assert!(spans.is_empty(), "{spans:?}");
    }
}

#[test]
fn an_error_ends_the_line_and_comes_back() {
    use pinhole::raster;
    let (a, b) = (bridge::pixel((0, 0)), bridge::pixel((30, 11)));
    let scissor = bridge::scissor(Area::new(-5, -5, 50, 50));
    for n in 0..12 {
        let mut calls = 0;
        let result = raster::line(a, b, &scissor, |_| {
            calls += 1;
            if calls > n {
                Err(n)
            } else {
                Ok(())
            }
        });
        assert_eq!((result, calls), (Err(n), n + 1));
    }
}
