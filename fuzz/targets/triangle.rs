//! `raster::triangle` over the whole guard band: the exact top-left answer in a window beside an edge
//! (R1–R7, R9), the same for every order of the corners, one span a row inside the scissor; and with a
//! neighbour across an edge no pixel twice and no gap (R8).
#![no_main]

use support::bridge;
mod bytes;
use support::oracle;

use bridge::{screen_point, triangle_spans};
use bytes::Bytes;
use libfuzzer_sys::fuzz_target;
use oracle::coverage::{centre, covers, edge, on_segment, Area, P};
use pinhole::raster::{self, Span};

const GUARD: i64 = 8192 * 256;
/// 512 pixels, far beyond what is low.
const SHORT: i64 = 1 << 17;
/// Where edges pass from one arithmetic to the other: `fast/edge20.rs`, and for a Cortex-M0 `fast/bresenham_triangle.rs`.
const LOW: [i64; 5] = [7680, 7936, 8160, 8191, 2040 * 256];

fn clamped(p: P) -> P {
    (p.0.clamp(-GUARD, GUARD), p.1.clamp(-GUARD, GUARD))
}

/// Near `from`, on lattices of centres and borders as often as not; far away; or on a limit.
fn coordinate(b: &mut Bytes<'_>, from: i64) -> i64 {
    let kind = b.byte();
    let (low, sign) = (i64::from(kind & 7), if kind & 8 == 0 { 1 } else { -1 });
    match kind >> 4 {
        0 | 1 => from + 128 * sign * low,
        2 => from + 64 * b.i8() / 4,
        3 => from + b.i8(),
        4 => from + sign * low,
        5 => from + 256 * b.i8(),
        6 => 128 * i64::from(b.i16()),
        7 => 64 * i64::from(b.i16()) + low,
        8 => sign * (GUARD - low),
        9 => from + sign * (SHORT - 4 + low),
        10 => from + sign * (LOW[low as usize % 5] + i64::from(b.byte() % 3) - 1),
        11 => from + sign * (SHORT / 2 + b.i8()),
        12 => from + sign * i64::from(b.i16()),
        13 => from + sign * (i64::from(b.u16()) << 2 | low & 3),
        14 => i64::from(b.i16()) << 6 | low,
        // A power of two away, or nearly.
        _ => from + sign * (1i64 << (b.byte() % 23)) + low - 4,
    }
}

fn point(b: &mut Bytes<'_>, from: P) -> P {
    clamped((coordinate(b, from.0), coordinate(b, from.1)))
}

/// The point `s`/2¹⁶ of the way from one point to another.
fn between(p: P, q: P, s: i64) -> P {
    (p.0 + (((q.0 - p.0) * s) >> 16), p.1 + (((q.1 - p.1) * s) >> 16))
}

/// Anywhere on a line's way or one of its ends.
fn place(b: &mut Bytes<'_>, p: P, q: P) -> P {
    match b.byte() {
        0..=31 => p,
        32..=63 => q,
        64..=95 => between(p, q, 1 << 15),
        k => between(p, q, i64::from(k) << 8 | i64::from(b.byte())),
    }
}

fn corner(b: &mut Bytes<'_>, p: P, q: P) -> P {
    if b.byte() & 3 == 0 {
        // A sliver along p–q.
        let on = place(b, p, q);
        return clamped((on.0 + (b.i8() >> 3), on.1 + (b.i8() >> 3)));
    }
    point(b, p)
}

/// At most one span a row, each one row high, not empty, inside the scissor, downwards.
fn well_formed(spans: &[Span], area: Area) {
    let mut last = i64::MIN;
    for s in spans {
        let (x, y, w) = (i64::from(s.x), i64::from(s.y), i64::from(s.width));
        assert!(s.height == 1 && w >= 1 && y > last, "{spans:?}");
        assert!(area.contains(x, y) && area.contains(x + w - 1, y), "{spans:?} in {area:?}");
        last = y;
    }
}

fn drawn(spans: &[Span], x: i64, y: i64) -> bool {
    let row = spans.partition_point(|s| i64::from(s.y) < y);
    spans.get(row).is_some_and(|s| i64::from(s.y) == y && (0..s.width.into()).contains(&(x - i64::from(s.x))))
}

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes::new(data);
    let p = point(&mut b, (0, 0));
    let q = point(&mut b, p);
    let r = corner(&mut b, p, q);
    let t = [p, q, r];
    assert_eq!(raster::area(&t.map(screen_point)), -edge(p, q, r), "with y down");

    // 64 pixels around a point on an edge; the walk starts 64 rows above it.
    let along = b.below(3);
    let at = place(&mut b, t[along], t[(along + 1) % 3]);
    let shape = b.byte();
    let width = 1 << (shape % 7);
    let height = 64 / width;
    let left = at.0.div_euclid(256) - width / 2 + (b.i8() >> 5);
    let top = at.1.div_euclid(256) - height / 2 + (b.i8() >> 5);
    let window = Area::new(left, top, left + width, top + height);
    let above = match b.byte() {
        0..=127 => 0,
        k => i64::from(k & 63) << ((k >> 6 & 1) * 5), // up to 2016
    };
    let area = Area { top: top - above, ..window };

    let spans = triangle_spans(t, area);
    well_formed(&spans, area);
    for (x, y) in window.pixels() {
        assert_eq!(drawn(&spans, x, y), covers(t, x, y), "{t:?} at ({x}, {y}) in {area:?}");
    }
    // R7: any other order of the corners.
    let orders = [[p, r, q], [q, p, r], [q, r, p], [r, p, q], [r, q, p]];
    let other = orders[usize::from(shape) / 7 % 5];
    assert_eq!(triangle_spans(other, area), spans, "{other:?} and {t:?}");

    // R8: a fourth corner across the edge that the window lies on.
    let (from, to, third) = (t[along], t[(along + 1) % 3], t[(along + 2) % 3]);
    let mut fourth = corner(&mut b, from, to);
    let (side, own) = (edge(from, to, fourth), edge(from, to, third));
    if side.signum() == own.signum() {
        fourth = (from.0 + to.0 - fourth.0, from.1 + to.1 - fourth.1);
        if clamped(fourth) != fourth {
            return;
        }
    }
    if own == 0 || edge(from, to, fourth) == 0 {
        return;
    }
    let neighbour = [to, from, fourth];
    let beyond = triangle_spans(neighbour, window);
    well_formed(&beyond, window);
    for (x, y) in window.pixels() {
        let c = centre(x, y);
        let (here, there) = (drawn(&spans, x, y), drawn(&beyond, x, y));
        assert!(!(here && there), "({x}, {y}) twice, by {t:?} and {neighbour:?}");
        if on_segment(from, to, c) && c != from && c != to {
            assert!(here || there, "({x}, {y}) missed by {t:?} and {neighbour:?}");
        }
    }
});
