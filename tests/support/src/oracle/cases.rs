//! Random triangles and lines, dense in cases that rasterizers get wrong: ties, slivers, the ends of the range. Vertices
//! spread evenly over all sub-pixels hardly ever meet a pixel centre.

use super::coverage::{centre, Area, P};
use super::rng::Rng;

/// The guard band in sub-pixels.
pub const GUARD: i64 = 8192 * 256;
/// The last pixel that a line may end in.
pub const FARTHEST: i64 = 32_767;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Within two pixels, about a centre as often as not.
    Tiny,
    /// Two vertices anywhere, the third a few sub-pixels off the line through them.
    Sliver,
    /// All vertices on centres, corners or the middles of pixel borders.
    Centres,
    /// One side horizontal or vertical, often through centres.
    Axes,
    /// As large as a small display.
    Plain,
    /// Anywhere in the guard band, its border included.
    Huge,
    /// Sides about as long as those from which on another arithmetic walks along them: `fast/edge20.rs`,
    /// `fast/bresenham_triangle.rs`, and 512 pixels.
    Limits,
}

pub const CLASSES: [Class; 7] =
    [Class::Tiny, Class::Sliver, Class::Centres, Class::Axes, Class::Plain, Class::Huge, Class::Limits];

/// A coordinate of any magnitude up to the guard band, or close to its border.
fn far(rng: &mut Rng) -> i64 {
    match rng.below(4) {
        0 => rng.int(-GUARD, GUARD),
        1 => (GUARD - rng.int(0, 300)) * [1, -1][rng.below(2)],
        2 => 128 * rng.int(-GUARD / 128, GUARD / 128),
        _ => {
            let reach = 1i64 << rng.int(1, 21);
            rng.int(-reach, reach)
        }
    }
}

/// A triangle of a class. All but huge triangles and some slivers lie around the picture of 0 … 64 pixels.
pub fn triangle(rng: &mut Rng, class: Class) -> [P; 3] {
    let near = |rng: &mut Rng, step: i64| step * rng.int(-4000 / step, 20_000 / step);
    match class {
        Class::Tiny => {
            let about = centre(rng.int(-4, 67), rng.int(-4, 67));
            let o = if rng.one_in(2) { about } else { (near(rng, 1), near(rng, 1)) };
            let reach = [2, 20, 128, 256][rng.below(4)];
            let mut p = || (o.0 + rng.int(-reach, reach), o.1 + rng.int(-reach, reach));
            [p(), p(), p()]
        }
        Class::Sliver => {
            let mut end = || match rng.below(3) {
                0 => centre(rng.int(-10, 70), rng.int(-10, 70)),
                1 => (near(rng, 1), near(rng, 1)),
                _ => (far(rng), far(rng)),
            };
            let (a, b) = (end(), end());
            let s = rng.int(-1, 9);
            let off = |a: i64, b: i64, d: i64| (a + (b - a) * s / 8 + d).clamp(-GUARD, GUARD);
            let (dx, dy) = (rng.int(-3, 3), rng.int(-3, 3));
            [a, b, (off(a.0, b.0, dx), off(a.1, b.1, dy))]
        }
        Class::Centres => {
            let mut p = || (near(rng, 128), near(rng, 128));
            [p(), p(), p()]
        }
        Class::Axes => {
            let step = [1, 128][rng.below(2)];
            let mut c = || near(rng, step);
            let (a, b, third) = ((c(), c()), c(), (c(), c()));
            let b = if rng.one_in(2) { (b, a.1) } else { (a.0, b) };
            [a, b, third]
        }
        Class::Plain => {
            let mut p = || (near(rng, 1), near(rng, 1));
            [p(), p(), p()]
        }
        Class::Huge => {
            let mut p = || (far(rng), far(rng));
            [p(), p(), p()]
        }
        Class::Limits => {
            let a = (near(rng, 1), near(rng, 1));
            let mut side = || {
                let limit = [7680, 7936, 8160, 8191, 1 << 17, 2040 * 256][rng.below(6)] + rng.int(-2, 2);
                [limit, -limit, near(rng, 1), rng.int(-limit, limit)][rng.below(4)]
            };
            let mut p = || (a.0 + side(), a.1 + side());
            [a, p(), p()]
        }
    }
}

/// A line: its ends on a small display, about it, anywhere in the range, or at its limits.
pub fn line(rng: &mut Rng) -> (P, P) {
    let end = |rng: &mut Rng, kind: usize| {
        let reach = match kind {
            0 => return (rng.int(-20, 100), rng.int(-20, 100)),
            1 => 1i64 << rng.int(3, 14),
            2 => FARTHEST,
            _ => {
                return [(); 2]
                    .map(|()| [-FARTHEST, 1 - FARTHEST, -1, 0, 1, FARTHEST - 1, FARTHEST][rng.below(7)])
                    .into()
            }
        };
        (rng.int(-reach, reach), rng.int(-reach, reach))
    };
    let kinds = [(0, 0), (0, 1), (1, 0), (1, 2), (2, 3), (3, 3)];
    let Some(&(first, second)) = kinds.get(rng.below(7)) else {
        // A step of a few pixels, many times over, and a little more: a slope on which ties lie.
        let (from, times) = (end(rng, 0), rng.log(1.0, 2000.0) as i64);
        let mut along = |from: i64| from + times * rng.int(-16, 16) + rng.int(-1, 1);
        return (from, (along(from.0), along(from.1)));
    };
    (end(rng, first), end(rng, second))
}

/// A square of pixels somewhere along the closed polygon: at a vertex as often as not.
pub fn window(rng: &mut Rng, polygon: &[P], size: i64) -> Area {
    let k = rng.below(polygon.len());
    let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
    let s = [0, 1 << 20, rng.int(0, 1 << 20), rng.int(0, 1 << 20)][rng.below(4)];
    let at = |a: i64, b: i64, slip: i64| (a + (((b - a) * s) >> 20)).div_euclid(256) + slip - size / 2;
    let reach = size / 2 + 1;
    let (x, y) = (at(a.0, b.0, rng.int(-reach, reach)), at(a.1, b.1, rng.int(-reach, reach)));
    Area::new(x, y, x + size, y + size)
}
