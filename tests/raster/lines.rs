//! L1–L3: line pixels equal the exact ones, in every octant, under every scissor, in every order
//! of the ends; each run is one span.

use support::bridge;
use support::bridge::compare::{line as same, line_both_ways as both_ways};
use support::oracle::coverage::Area;
use support::oracle::rng::Rng;

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
fn l2_every_small_scissor_crops_the_line() {
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
fn l2_nearly_horizontal_and_vertical_lines_are_exact() {
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

/// The documented range ends at −32767; the type holds one more. No panic, no wrapped line.
#[test]
fn l2_lines_to_the_ends_of_i16_do_not_wrap() {
    let low = -32_768;
    for (a, b) in [
        ((low, low), (32_767, 32_767)),
        ((low, 32_767), (32_767, low)),
        ((low, 0), (32_767, 1)),
        ((0, low), (1, 32_767)),
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
fn scissors_of_extreme_bounds_crop_and_do_not_panic() {
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
fn an_error_of_the_callback_ends_the_line_and_is_returned() {
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
