//! Depth along a line at the centres of its pixels.

use super::{Pixel, ScreenPoint};
use crate::math::num::{mul_wide, reciprocal};

/// The depth along a line between two points, interpolated at the centres of its pixels along the major axis: x or y, whichever
/// changes more. A centre beyond an end has the depth of that end. If both ends lie in one pixel, the line has the depth
/// of the nearer end.
///
/// Values are in 16.16 and wrap as those of a [`Gradient`](super::Gradient) do. At n pixels from the smaller end, n at least 1,
/// the error is less than `n·2⁻¹⁷` for the rounding of the step plus 2⁻¹³ for the reciprocal. Near depth 0 the value may be
/// negative by as much, and wraps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineDepth {
    /// Whether the major axis is y.
    tall: bool,
    /// The coordinates of the end pixels along the major axis.
    from: i32,
    to: i32,
    /// The values at `from`, at `from + 1`, and at `to`.
    first: u32,
    second: u32,
    last: u32,
    /// The change per pixel.
    step: u32,
}

impl LineDepth {
    /// The depth along the line that [`line`](super::line()) draws between the pixels of two points, with depths in 16.8, 0 to
    /// [`FARTHEST`](super::FARTHEST), at the points.
    pub(crate) fn new([a, b]: [ScreenPoint; 2], [za, zb]: [i32; 2]) -> Self {
        let (p, q): (Pixel, Pixel) = (a.pixel(), b.pixel());
        let extent = |a: i16, b: i16| (i32::from(a) - i32::from(b)).abs();
        let tall = extent(p.y, q.y) > extent(p.x, q.x); // the major axis of `line`
        Self::on_axis(tall, [a, b], [za, zb])
    }

    /// The depth along a line of which x or, if it is `tall`, y is the major axis.
    pub(crate) fn on_axis(tall: bool, [a, b]: [ScreenPoint; 2], [za, zb]: [i32; 2]) -> Self {
        let (a, b) = if tall { (a.y, b.y) } else { (a.x, b.x) };
        let ((a, za), (b, zb)) = if a <= b { ((a, za), (b, zb)) } else { ((b, zb), (a, za)) };
        let (from, to) = (a >> 8, b >> 8);
        let steps = |z: i32| (z as u32) << 8; // za, zb < 2²⁴ − 2⁸
        if from == to {
            let nearer = steps(za.min(zb));
            return Self { tall, from, to, first: nearer, second: nearer, last: nearer, step: 0 };
        }
        // In 2^(shift − 41) of 2⁻¹⁶ steps per sub-pixel: 1/(b − a), of 1 … 2²², is mantissa · 2^(shift − 61).
        let r = reciprocal(b - a);
        // 25 + 31 − 12 bits
        let product = mul_wide(zb - za, r.mantissa) >> 12;
        // In 2⁻³² of 2⁻¹⁶ steps per sub-pixel, modulo 2³² of them. The shift is 8 for 2²² sub-pixels alone: then a bit is lost.
        let slope = match r.shift.min(30) {
            ..9 => product >> 1,
            shift => product << (shift - 9), // 0 … 21
        };

        // `by` is up to 384 sub-pixels: 9 bits. Rounded to nearest, which halves the error of the step.
        let climb = |by: i32| (slope.wrapping_mul(i64::from(by)).wrapping_add(1 << 31) >> 32) as u32;
        let centre = |pixel: i32| 256 * pixel + 128;
        Self {
            tall,
            from,
            to,
            first: steps(za).wrapping_add(climb((centre(from) - a).max(0))),
            second: steps(za).wrapping_add(climb(centre(from + 1) - a)),
            last: steps(zb).wrapping_sub(climb((b - centre(to)).max(0))),
            step: climb(256),
        }
    }

    /// Depths in 16.16 plus half a step, as [`step_of`](Self::step_of) takes them, for a loop over the pixels from `first` to `last` along the major axis:
    /// at both, at `first` by the formula for pixels between the ends, and the change from there to the next pixel.
    #[inline(always)]
    pub(crate) fn between(&self, first: i32, last: i32) -> [u32; 4] {
        let step = if last < first { self.step.wrapping_neg() } else { self.step };
        let rounded = |depth: u32| depth.wrapping_add(1 << 15);
        [rounded(self.at(first)), rounded(self.at(last)), rounded(self.inner(first)), step]
    }

    /// Whether the major axis is y, and the change of depth per pixel along it in 16.16; 0 if both ends lie in one pixel. It wraps
    /// where depth changes by more than half of its range within a pixel.
    pub(crate) fn step(&self) -> (bool, i32) {
        (self.tall, self.step as i32)
    }

    /// The depth at a pixel of the line in 16.16, wrapping.
    fn at(&self, along: i32) -> u32 {
        if along <= self.from {
            self.first
        } else if along >= self.to {
            self.last
        } else {
            self.inner(along)
        }
    }

    /// The depth at a pixel between the end pixels in 16.16, wrapping.
    #[inline(always)]
    fn inner(&self, along: i32) -> u32 {
        // The exact value lies between the ends, so wrapping products and sums are harmless.
        self.second.wrapping_add(self.step.wrapping_mul((along - self.from - 1) as u32))
    }

    /// The depth at a pixel of the line, by its coordinate along the major axis: 0 near … 65534 far.
    pub(crate) fn depth(&self, along: i32) -> u16 {
        Self::step_of(self.at(along).wrapping_add(1 << 15)) as u16 // at most 65534
    }

    /// The step of a depth in 16.16 to which half a step was added.
    #[inline(always)]
    pub(crate) fn step_of(depth: u32) -> u32 {
        // The error is at most 2¹⁴·2⁻¹⁷ + 2⁻¹³ steps, so a value below 0 rounds to 0, and the farthest, 65534.46, does not reach
        // 65536 after the half is added.
        (depth >> 16).min(u32::from(u16::MAX) - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    const DEEPEST: i64 = super::super::FARTHEST as i64;

    #[test]
    fn depth_along_a_line_is_the_depth_of_the_point_on_it() {
        let mut random = Random(7);
        let mut below = |n| random.below(n);
        // Errors in 2⁻²⁰ step: beyond 1/2 and n·2⁻¹⁷, and beyond 1/2 alone.
        let (mut beyond, mut largest) = (i128::MIN, 0);
        for i in 0..400_000 {
            let (reach, start) = [(300, 700), (3000, 90), (130_000, 700), (1 << 22, 1 << 21)][i % 4];
            let mut coordinate = || (below(reach) - start) as i32;
            let mut point = || ScreenPoint::from_subpixels(coordinate(), coordinate()).unwrap();
            let (a, b) = (point(), point());
            // Any depths; depths near both limits; and one near each limit.
            let (za, zb) = match i / 4 % 4 {
                0 => (below(DEEPEST + 1), below(DEEPEST + 1)),
                1 => (below(300), below(300)),
                2 => (DEEPEST - below(300), DEEPEST - below(300)),
                _ => (below(3), DEEPEST - below(3)),
            };
            let along = LineDepth::new([a, b], [za as i32, zb as i32]);
            let (p, q) = (a.pixel(), b.pixel());
            let tall = (i32::from(p.y) - i32::from(q.y)).abs() > (i32::from(p.x) - i32::from(q.x)).abs();
            let of = |p: ScreenPoint| i128::from(if tall { p.y() } else { p.x() });
            let ((from, za), (to, zb)) = if of(a) <= of(b) {
                ((of(a), i128::from(za)), (of(b), i128::from(zb)))
            } else {
                ((of(b), i128::from(zb)), (of(a), i128::from(za)))
            };
            let (first, last) = (from >> 8, to >> 8);
            if first == last {
                assert_eq!(i128::from(along.depth(first as i32)), (za.min(zb) + 128) >> 8);
                continue;
            }
            for pixel in [first, first + 1, (first + last) / 2, last - 1, last] {
                // In rationals over to − from, centres clamped to the ends.
                let centre = (256 * pixel + 128).clamp(from, to);
                let exact = za * (to - centre) + zb * (centre - from);
                let stored = i128::from(along.depth(pixel as i32)) * 256 * (to - from);
                let error = ((stored - exact).abs() << 12) / (to - from);
                let n = if pixel == last { 1 } else { (pixel - first).max(1) };
                beyond = beyond.max(error - (1 << 19) - (n << 3));
                largest = largest.max(error - (1 << 19));
            }
        }
        assert!(beyond < 1 << 7, "{beyond}"); // 2⁻¹³

        // 2¹⁴ pixels.
        assert!((1 << 16..(1 << 17) + (1 << 7)).contains(&largest), "{largest}");
    }

    #[test]
    fn a_line_at_depth_0_and_one_at_the_farthest_depth_do_not_wrap() {
        let points = [-8192 * 256, 8192 * 256].map(|x| ScreenPoint::from_subpixels(x, 0).unwrap());
        for (depths, expected) in [([0, 100], 0), ([DEEPEST as i32, DEEPEST as i32 - 100], 65_534)] {
            for points in [points, [points[1], points[0]]] {
                let along = LineDepth::new(points, depths);
                assert!((-8192..8192).all(|x| along.depth(x) == expected));
            }
        }
    }
}
