//! L1–L3 in memory: the loops that draw lines into `Picture::pixels`, against the oracle and against lines on any other
//! target.

use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::Gray8;
use pinhole::{draw_line, Picture};
use support::bridge;
use support::oracle::cases;
use support::oracle::coverage::Area;
use support::oracle::line::{self, P};
use support::oracle::rng::Rng;

/// The pixels of a picture after a line is drawn in either direction; memory behind the picture must not change.
fn drawn(a: P, b: P, (width, height): (u32, u32), fast: bool) -> Vec<bool> {
    let (empty, ink, size) = (Gray8::new(0), Gray8::new(1), (width * height) as usize);
    let mut memory = vec![empty; size + 3];
    let mut picture = Picture::new(&mut memory, Size::new(width, height)).expect("enough memory");
    let (a, b) = (bridge::pixel(a), bridge::pixel(b));
    let Ok(()) = match fast {
        true => draw_line(a, b, ink, &mut picture.pixels()),
        false => draw_line(a, b, ink, &mut picture),
    };
    assert!(memory[size..].iter().all(|&c| c == empty), "{a:?} {b:?}");
    memory[..size].iter().map(|&c| c == ink).collect()
}

/// Compares the picture with the oracle and returns the number of pixels of the line.
fn check(a: P, b: P, size: (u32, u32)) -> usize {
    let (width, height) = (i64::from(size.0), i64::from(size.1));
    let mut exact = vec![false; (width * height) as usize];
    let pixels = line::clipped(a, b, Area::new(0, 0, width, height));
    for &(x, y) in &pixels {
        exact[(y * width + x) as usize] = true;
    }
    for (a, b) in [(a, b), (b, a)] {
        assert!(drawn(a, b, size, true) == exact, "{a:?} {b:?} {size:?}");
        assert!(drawn(a, b, size, false) == exact, "{a:?} {b:?} {size:?} as any target");
    }
    pixels.len()
}

#[test]
fn l1_every_line_in_every_octant() {
    // Whole, and cut by each border: horizontal, vertical and diagonal ones, all ties, single pixels.
    for a in [(12, 12), (2, 3), (21, 20)] {
        for (x, y) in Area::new(-4, -4, 29, 29).pixels() {
            check(a, (x, y), (25, 24));
        }
    }
}

#[test]
fn l2_lines_match_in_pictures_of_every_shape() {
    let mut rng = Rng::new(0x4C49);
    let mut pixels = 0;
    for size in [(1, 1), (1, 40), (40, 1), (2, 2), (2, 60), (3, 41), (60, 2), (37, 53), (64, 32), (240, 17)] {
        for _ in 0..1000 {
            let mut end = |extent: u32| rng.int(-3, i64::from(extent) + 2);
            pixels += check((end(size.0), end(size.1)), (end(size.0), end(size.1)), size);
        }
    }
    assert!(pixels > 60_000, "{pixels}");
}

#[test]
fn l2_lines_to_the_ends_of_the_range() {
    let mut rng = Rng::new(0x4C4A);
    let mut pixels = 0;
    for _ in 0..20_000 {
        let (a, b) = cases::line(&mut rng);
        pixels += check(a, b, [(64, 48), (48, 70), (5, 90), (2, 9)][rng.below(4)]);
    }
    assert!(pixels > 50_000, "{pixels}");
}

#[test]
fn l2_the_longest_lines_of_each_loop_match() {
    // A slope in 32 bits is for lines up to 6688; in narrow pictures, whole, and in wide ones, cut.
    let mut rng = Rng::new(0x4C4B);
    for length in [6600, 6687, 6688, 6689, 6690, 8000] {
        for width in [2, 5, 30] {
            for rise in [0, 1, width - 1, rng.int(0, width - 1)] {
                check((0, 0), (rise, length), (width as u32, length as u32 + 1));
                check((0, length), (rise, 0), (width as u32, length as u32 + 1));
                check((0, 0), (length, rise), (length as u32 + 1, width as u32));
                check((0, rise), (length, 0), (length as u32 + 1, width as u32));
            }
        }
        for _ in 0..400 {
            // Through the middle of a picture, at any slope.
            let (x, y) = (rng.int(0, 40), rng.int(0, 40));
            let (dx, dy) = (rng.int(-length / 2, length / 2), length / 2);
            check((x - dx, y - dy), (x + dx, y - dy + length), (41, 41));
            check((x - dy, y - dx), (x - dy + length, y + dx), (41, 41));
        }
    }
}
