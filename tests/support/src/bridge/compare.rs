//! The library against the exact oracles: panics with both pictures where a pixel differs.

use crate::oracle::chain::V3;
use crate::oracle::coverage::{self, Area, P};
use crate::oracle::line;

pub fn triangle(t: [P; 3], area: Area) {
    let (ours, exact) = (super::triangle(t, area), coverage::triangle(t, area));
    assert!(ours == exact, "{t:?}\nlibrary\n{ours:?}\nexact\n{exact:?}");
}

/// Compares a window that the triangle reaches from `above` rows higher up: the edges have come a long
/// way by then.
pub fn triangle_from_above(t: [P; 3], area: Area, above: i64) {
    let tall = Area { top: area.top - above, ..area };
    let ours = super::triangle(t, tall);
    for (x, y) in area.pixels() {
        assert_eq!(ours.at(x, y) == 1, coverage::covers(t, x, y), "{t:?} at ({x}, {y}), scissor {tall:?}");
    }
}

/// The library's pixels equal the oracle's, with one span for each run.
pub fn line(a: P, b: P, area: Area) {
    let spans = super::line_spans(a, b, area);
    let (ours, exact) = (super::counts(&spans, area), line::line(a, b, area));
    assert!(ours == exact, "{a:?} {b:?}\nlibrary\n{ours:?}\nexact\n{exact:?}");
    let pixels = line::clipped(a, b, area);
    assert_eq!(spans.len(), line::runs(a, b, &pixels), "{a:?} {b:?} {area:?}: a span for each run");
}

pub fn line_both_ways(a: P, b: P, area: Area) {
    line(a, b, area);
    line(b, a, area);
}

/// Half a unit of the last place of I16F16, and a little for earlier roundings.
pub const HALF: f64 = 0.51 / 65536.0;

/// Asserts that each coordinate is within a bound.
pub fn close3(ours: V3, exact: V3, bound: f64, what: &str) {
    for i in 0..3 {
        let error = (ours[i] - exact[i]).abs();
        assert!(error <= bound, "{what}: {ours:?} instead of {exact:?}");
    }
}
