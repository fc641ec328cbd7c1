//! R9 and L2 by sheer number: a million random triangles of mixed classes and a million lines, compared pixel by
//! pixel with the exact oracles. `--nocapture` shows how many pixels that is.
//!
//! Small triangles are compared completely. Larger triangles and lines are compared in small scissors along their borders
//! and about their vertices, where rasterizers go wrong; some scissors are reached from many rows above.

use support::bridge;
use support::oracle::cases::{self, CLASSES};
use support::oracle::coverage::{rows, Area, P};
use support::oracle::line;
use support::oracle::rng::Rng;

/// The number of lines, and about that of triangles.
const NUMBER: usize = 1_000_000;

/// The library's pixels inside a window at most 64 wide, as words; the number of those drawn more than once is added to `twice`.
fn words(spans: &[pinhole::raster::Span], window: Area, twice: &mut u64) -> Vec<u64> {
    let mut words = vec![0u64; window.height()];
    for span in spans {
        for y in i64::from(span.y)..i64::from(span.y + span.height) {
            for x in i64::from(span.x)..i64::from(span.x + span.width) {
                if window.contains(x, y) {
                    let (word, bit) = (&mut words[(y - window.top) as usize], 1 << (x - window.left));
                    *twice += u64::from(*word & bit != 0);
                    *word |= bit;
                }
            }
        }
    }
    words
}

/// The covered pixels of a window, which are equal.
fn compare(ours: &[u64], exact: &[u64], window: Area, what: impl core::fmt::Debug) -> u64 {
    assert!(ours == exact, "{what:?} in {window:?}: {ours:x?} instead of {exact:x?}");
    exact.iter().map(|row| u64::from(row.count_ones())).sum()
}

/// The window of a triangle to compare.
fn windows(rng: &mut Rng, t: [P; 3]) -> Vec<Area> {
    let (x, y) = (t.map(|p| p.0.div_euclid(256)), t.map(|p| p.1.div_euclid(256)));
    let low = |c: [i64; 3]| c[0].min(c[1]).min(c[2]) - 1;
    let high = |c: [i64; 3]| c[0].max(c[1]).max(c[2]) + 2;
    let whole = Area::new(low(x), low(y), high(x), high(y));
    if whole.width() <= 20 && whole.height() <= 20 {
        vec![whole]
    } else {
        vec![cases::window(rng, &t, 11), cases::window(rng, &t, 11)]
    }
}

#[test]
fn r9_random_triangles_of_every_class() {
    let (mut rng, mut twice) = (Rng::new(0x9A17), 0);
    for class in CLASSES {
        let (mut pixels, mut covered) = (0, 0);
        for _ in 0..NUMBER / CLASSES.len() {
            let t = cases::triangle(&mut rng, class);
            for window in windows(&mut rng, t) {
                // Some scissors begin far above the window, so that the edge walkers take many steps.
                let above = if rng.one_in(8) { 1 << rng.int(0, 9) } else { 0 };
                let scissor = Area { top: window.top - above, ..window };
                let ours = words(&bridge::triangle_spans(t, scissor), window, &mut twice);
                covered += compare(&ours, &rows(t, window), window, t);
                pixels += (window.width() * window.height()) as u64;
            }
        }
        println!("{class:?}: {pixels} pixels, {covered} covered");
        assert!(covered * 500 > pixels, "{class:?} shows too little");
    }
    assert_eq!(twice, 0);
}

#[test]
fn l2_random_lines_to_the_ends_of_the_range() {
    let mut rng = Rng::new(0x119E);
    let (mut covered, mut twice) = (0, 0);
    for _ in 0..NUMBER {
        let (a, b) = cases::line(&mut rng);
        for _ in 0..2 {
            let window = cases::window(&mut rng, &[(256 * a.0, 256 * a.1), (256 * b.0, 256 * b.1)], 24);
            let ours = words(&bridge::line_spans(a, b, window), window, &mut twice);
            let mut exact = vec![0u64; window.height()];
            for (x, y) in line::clipped(a, b, window) {
                exact[(y - window.top) as usize] |= 1 << (x - window.left);
            }
            covered += compare(&ours, &exact, window, (a, b));
        }
    }
    assert_eq!(twice, 0);
    assert!(covered > 10 * NUMBER as u64);
}
