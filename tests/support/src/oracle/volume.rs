//! The homogeneous volume −w ≤ x, y, z ≤ w (docs/spec.md, section 5), in f64.

use super::chain::V4;

/// The distances from its six planes, in the order of the outcode's bits.
pub fn distances([x, y, z, w]: V4) -> [f64; 6] {
    [w + x, w - x, w + y, w - y, w + z, w - z]
}

/// The parameters between which a + t·(b − a) lies inside, by all six planes at once, of the volume grown by
/// `more` on all sides.
pub fn inside(a: V4, b: V4, more: f64) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0f64, 1f64);
    for (da, db) in distances(a).into_iter().zip(distances(b)) {
        let (da, db) = (da + more, db + more);
        if da < 0.0 && db < 0.0 {
            return None;
        }
        if da < 0.0 {
            from = from.max(da / (da - db));
        } else if db < 0.0 {
            to = to.min(da / (da - db));
        }
    }
    (from <= to).then_some((from, to))
}

pub fn largest(p: V4) -> f64 {
    p.iter().fold(0.0, |m, c| c.abs().max(m))
}

/// The largest difference of a coordinate.
pub fn gap(a: V4, b: V4) -> f64 {
    largest(core::array::from_fn(|i| a[i] - b[i]))
}
