//! `raster::line` in a scissor: exactly the exact line's pixels that lie in it, one span a run, and the
//! same from both ends (L1–L3).
#![no_main]

use support::bridge;
mod bytes;
use support::oracle;

use bridge::line_spans;
use bytes::Bytes;
use libfuzzer_sys::fuzz_target;
use oracle::coverage::Area;
use oracle::line::{self, P};
use pinhole::raster::Span;

const MIN: i64 = i16::MIN as i64;
const MAX: i64 = i16::MAX as i64;

fn point(b: &mut Bytes<'_>, from: P) -> P {
    let mut near = |from: i64| match b.byte() {
        k @ 0..=95 => from + i64::from(k) - 48,
        k @ 96..=111 => MAX - i64::from(k - 96),
        k @ 112..=127 => MIN + i64::from(k - 112),
        128..=159 => from + 16 * b.i8(),
        _ => i64::from(b.i16()),
    };
    (near(from.0).clamp(MIN, MAX), near(from.1).clamp(MIN, MAX))
}

/// The two ends; the slope may be a simple one, on which ties lie.
fn ends(b: &mut Bytes<'_>) -> (P, P) {
    let from = point(b, (0, 0));
    let kind = b.byte();
    if kind & 3 != 0 {
        return (from, point(b, from));
    }
    // A step of a few pixels, many times over, and a little more.
    let (dx, dy, times) = (b.i8() >> 3, b.i8() >> 3, i64::from(b.u16()));
    let along = |v: i64, d: i64, more: i64| (v + d * times + more).clamp(MIN, MAX);
    let more = |k: u8| i64::from(kind >> k & 3) - 1;
    (from, (along(from.0, dx, more(2)), along(from.1, dy, more(4))))
}

/// About a pixel of the line or anywhere, with up to 64 pixels a side; or, for short lines, of any size.
fn scissor(b: &mut Bytes<'_>, from: P, to: P) -> Area {
    let major = (to.0 - from.0).abs().max((to.1 - from.1).abs());
    let kind = b.byte();
    if kind & 7 == 0 && major <= 256 {
        let [left, top, right, bottom] = [(); 4].map(|()| i64::from(b.wild()));
        return Area::new(left, top, right, bottom);
    }
    let at = match kind >> 3 & 3 {
        0 => from,
        1 => to,
        _ => line::pixel(from, to, (i64::from(b.u16()) * major) >> 16),
    };
    let (left, top) = (at.0 + (b.i8() >> 2), at.1 + (b.i8() >> 2));
    // Inside out too.
    Area::new(left, top, left + (b.i8() >> 1), top + (b.i8() >> 1))
}

/// The runs along the major axis of the line's pixels in the area, in their order.
fn runs(a: P, b: P, area: Area) -> Vec<Span> {
    let (a, b) = if a <= b { (a, b) } else { (b, a) };
    let steep = line::is_steep(a, b);
    let (start, end) = if steep { (a.1, b.1) } else { (a.0, b.0) };
    let (low, high) = if steep { (area.top, area.bottom - 1) } else { (area.left, area.right - 1) };
    // Steps along the major axis that fall into the area's columns or rows.
    let (first, last) = if end < start { (start - high, start - low) } else { (low - start, high - start) };
    let (first, last) = (first.max(0), last.min((end - start).abs()));
    let mut runs: Vec<Span> = Vec::new();
    for k in first..=last {
        let (x, y) = line::pixel(a, b, k);
        if !area.contains(x, y) {
            continue;
        }
        let (x, y) = (x as i32, y as i32);
        match runs.last_mut() {
            Some(run) if steep && run.x == x => {
                run.y = run.y.min(y);
                run.height += 1;
            }
            Some(run) if !steep && run.y == y => run.width += 1,
            _ => runs.push(Span { x, y, width: 1, height: 1 }),
        }
    }
    runs
}

fuzz_target!(|data: &[u8]| {
    let mut b = Bytes::new(data);
    let (from, to) = ends(&mut b);
    let area = scissor(&mut b, from, to);
    let wanted = runs(from, to, area);
    assert_eq!(line_spans(from, to, area), wanted, "{from:?} {to:?} in {area:?}");
    assert_eq!(line_spans(to, from, area), wanted, "{to:?} {from:?} in {area:?}");
});
