//! Line pixels by docs/spec.md, section 7: ends ordered by (x, y) ascending, one pixel per major step, the nearest
//! minor step, a tie takes the smaller one. Each pixel has its own exact division, without an error term.

use super::coverage::{Area, Counts};

pub type P = (i64, i64);

fn ordered(a: P, b: P) -> (P, P) {
    if a <= b {
        (a, b)
    } else {
        (b, a)
    }
}

/// Is y the major axis?
pub fn is_steep(a: P, b: P) -> bool {
    (b.1 - a.1).abs() > (b.0 - a.0).abs()
}

/// The pixel `k` major steps from the smaller end.
pub fn pixel(a: P, b: P, k: i64) -> P {
    let (a, b) = ordered(a, b);
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let major = dx.abs().max(dy.abs());
    let minor = dx.abs().min(dy.abs());
    // round(k · minor / major), a half going down: floor((2·k·minor + major − 1) / (2·major))
    let m = if major == 0 { 0 } else { (2 * k * minor + major - 1).div_euclid(2 * major) };
    if is_steep(a, b) {
        (a.0 + m * dx.signum(), a.1 + k * dy.signum())
    } else {
        (a.0 + k * dx.signum(), a.1 + m * dy.signum())
    }
}

/// All pixels from the smaller end to the larger.
pub fn pixels(a: P, b: P) -> Vec<P> {
    let (a, b) = ordered(a, b);
    let major = (b.0 - a.0).abs().max((b.1 - a.1).abs());
    (0..=major).map(|k| pixel(a, b, k)).collect()
}

/// L2: the pixels of the unclipped line that lie in the area. Only the steps that reach its rows (or columns, along
/// the major axis) are computed, each by itself, so that a long line in a small area costs little.
pub fn clipped(a: P, b: P, area: Area) -> Vec<P> {
    let (a, b) = ordered(a, b);
    let (from, to, low, high) =
        if is_steep(a, b) { (a.1, b.1, area.top, area.bottom) } else { (a.0, b.0, area.left, area.right) };
    // Steps go from `from` to `to`; |position − from| = step.
    let steps = if from <= to { (low - from, high - 1 - from) } else { (from - (high - 1), from - low) };
    (steps.0.max(0)..=steps.1.min((to - from).abs()))
        .map(|k| pixel(a, b, k))
        .filter(|&(x, y)| area.contains(x, y))
        .collect()
}

pub fn line(a: P, b: P, area: Area) -> Counts {
    let mut counts = Counts::new(area);
    for (x, y) in clipped(a, b, area) {
        counts.hit(x, y);
    }
    counts
}

/// The number of runs along the major axis that the pixels (in order) fall into.
pub fn runs(a: P, b: P, pixels: &[P]) -> usize {
    let minor = |p: &P| if is_steep(a, b) { p.0 } else { p.1 };
    let steps = pixels.windows(2).filter(|w| minor(&w[0]) != minor(&w[1]));
    steps.count() + usize::from(!pixels.is_empty())
}
