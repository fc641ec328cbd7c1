//! R1–R9 in memory: the loops that draw triangles into `Picture::pixels` and `Band::pixels`, against the oracle and, as spans of any other
//! target, against the plain path, for triangles of every tier. With depth, `by_every_call` compares memory with any
//! other target.

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::{draw::fill_triangle, prelude::*};
use support::bridge::{self, Spans};
use support::oracle::cases::{self, CLASSES};
use support::oracle::coverage::{covers, rows, Area, P};
use support::oracle::rng::Rng;

const INK: Gray8 = Gray8::new(1);

/// The pixels of a picture after a triangle is drawn; memory behind the picture must not change.
fn drawn(t: [P; 3], (width, height): (usize, usize)) -> Vec<Gray8> {
    let mut memory = vec![Gray8::BLACK; width * height + 3];
    let mut picture =
        Picture::new(&mut memory, Size::new(width as u32, height as u32)).expect("enough memory");
    let Ok(()) = fill_triangle(t.map(bridge::screen_point), INK, &mut picture.pixels());
    assert!(memory[width * height..].iter().all(|&c| c == Gray8::BLACK), "{t:?}");
    memory.truncate(width * height);
    memory
}

/// A word a row.
fn words(pixels: &[Gray8], width: usize) -> Vec<u64> {
    let word = |row: &[Gray8]| row.iter().enumerate().map(|(x, &c)| u64::from(c == INK) << x).sum();
    pixels.chunks(width).map(word).collect()
}

/// A triangle at or about the largest size of a fast path (8160 sub-pixels across and 7680 down, or 8191 down; on a
/// Cortex-M0 7936 down).
fn small(rng: &mut Rng) -> [P; 3] {
    let reach =
        [256, 1000, 4095, 7680, 7681, 7936, 7937, 8160, 8161, 8191, 8192, 8300, 16_384][rng.below(13)];
    let (x, y) = (rng.int(-300, 16_384), rng.int(-300, 16_384));
    let mut p = |i: usize| match (i, rng.below(3)) {
        (1, 0) => (x + reach, y + reach),
        (2, 0) => (x, y + reach),
        (0, 0) => (x, y),
        _ => (x + rng.int(0, reach), y + rng.int(0, reach)),
    };
    let mut t = [p(0), p(1), p(2)];
    rng.shuffle(&mut t);
    t
}

/// The pixels of a triangle in memory are the oracle's.
fn check(t: [P; 3], (width, height): (usize, usize)) -> u64 {
    let exact = rows(t, Area::new(0, 0, width as i64, height as i64));
    assert!(words(&drawn(t, (width, height)), width) == exact, "{t:?} in {width} x {height}");
    exact.iter().map(|row| u64::from(row.count_ones())).sum()
}

/// In one colour and in colours of their own per pixel, a target that is not the library's gets the spans of the plain path, and memory
/// gets their colours.
fn check_spans(t: [P; 3], (width, height): (usize, usize)) -> usize {
    let area = Area::new(0, 0, width as i64, height as i64);
    let plain = bridge::triangle_spans(t, area);
    let corners = t.map(bridge::screen_point);
    let smooth = Gouraud::new([10, 90, 250].map(|level| Rgb888::new(level, level, level)));
    for is_smooth in [false, true] {
        let mut target = Spans::new(area);
        let mut memory = vec![Gray8::BLACK; width * height];
        let mut picture =
            Picture::new(&mut memory, Size::new(width as u32, height as u32)).expect("enough memory");
        let (Ok(()), Ok(())) = match is_smooth {
            true => (
                fill_triangle(corners, smooth, &mut target),
                fill_triangle(corners, smooth, &mut picture.pixels()),
            ),
            false => {
                (fill_triangle(corners, INK, &mut target), fill_triangle(corners, INK, &mut picture.pixels()))
            }
        };
        assert_eq!(target.spans, plain, "{t:?}");
        let mut expected = vec![Gray8::BLACK; width * height];
        let places =
            plain.iter().flat_map(|s| (s.x..s.x + s.width).map(|x| s.y as usize * width + x as usize));
        places.zip(target.colors).for_each(|(at, color)| expected[at] = color);
        assert!(memory == expected, "{t:?}");
    }
    plain.len()
}

#[test]
fn r9_random_triangles_of_every_class() {
    let mut rng = Rng::new(0x9A18);
    let (mut covered, mut spans) = (0, 0);
    let sizes = [(64, 64), (64, 64), (64, 3), (7, 64), (1, 64), (33, 50)];
    for i in 0..60_000 {
        let t = small(&mut rng);
        covered += check(t, sizes[i % 6]);
        spans += check_spans(t, sizes[i % 6]);
        for class in CLASSES {
            let t = cases::triangle(&mut rng, class);
            covered += check(t, sizes[i / 7 % 6]);
            if i % 12 == 0 {
                spans += check_spans(t, (60, 50));
            }
        }
    }
    assert!(covered > 50_000_000 && spans > 400_000, "{covered} {spans}");
}

#[test]
fn r9_triangles_match_in_wide_and_in_tall_pictures() {
    // Beyond 2047 columns a row is drawn in pieces; beyond 512 rows sides are wide.
    let mut rng = Rng::new(0x9A19);
    for (width, height) in [(2047, 4), (2048, 4), (5000, 3), (6, 700), (3, 3000)] {
        for i in 0..60 {
            let mut p = || (rng.int(-1000, 256 * width + 1000), rng.int(-1000, 256 * height + 1000));
            let mut t = [p(), p(), p()];
            if i % 3 == 0 {
                t = [(0, 0), (256 * width, rng.int(0, 3)), (128, 256 * height)];
            }
            let pixels = drawn(t, (width as usize, height as usize));
            for (at, (x, y)) in Area::new(0, 0, width, height).pixels().enumerate() {
                assert_eq!(pixels[at] == INK, covers(t, x, y), "{t:?} ({x}, {y}) in {width} x {height}");
            }
        }
    }
}

#[test]
fn r9_triangles_match_in_bands_away_from_the_origin() {
    let mut rng = Rng::new(0x9A1A);
    for _ in 0..3000 {
        let (left, top) = (rng.int(-20, 30), rng.int(-20, 30));
        let area = bridge::rectangle(left as i32, top as i32, rng.int(1, 64) as u32, rng.int(1, 40) as u32);
        let class = CLASSES[rng.below(CLASSES.len())];
        let t = if rng.one_in(2) { small(&mut rng) } else { cases::triangle(&mut rng, class) };
        let mut strip = vec![0; area.size.width as usize * rng.int(1, 20) as usize];
        let mut frame = Frame::new(area, Gray8::BLACK);
        while let Some(mut band) = frame.next_band(&mut strip).expect("room for a row") {
            let Ok(()) = fill_triangle(t.map(bridge::screen_point), INK, &mut band.pixels());
            let rows = band.area().rows();
            let pixels =
                Area::new(left, rows.start.into(), left + i64::from(area.size.width), rows.end.into())
                    .pixels();
            for ((x, y), byte) in pixels.zip(band.bytes()) {
                assert_eq!(*byte == INK.luma(), covers(t, x, y), "{t:?} ({x}, {y}) in {:?}", band.area());
            }
        }
    }
}

#[test]
fn clear_resets_every_pixel_of_a_depth_buffer() {
    for (from, count) in
        (0..4).flat_map(|from| [0, 1, 2, 3, 63, 64, 65, 66, 67, 130].map(|count| (from, count)))
    {
        let mut storage = [7; 140];
        let area = Rectangle::new(Point::new(3, -2), Size::new(count as u32, 1));
        let mut depth = DepthBuffer::new(area, &mut storage[from..]).expect("enough memory");
        depth.clear();
        let cleared = storage.iter().enumerate().all(|(i, &v)| {
            let is_inside = (from..from + count).contains(&i);
            v == if is_inside { u16::MAX } else { 7 }
        });
        assert!(cleared, "{count} from {from}: {storage:?}");
    }
}
