//! Depth along a line, for the centres of its pixels.

use super::{Pixel, ScreenPoint};
use crate::math::num::{mul_wide, reciprocal};

/// The depth of a line between two points, at the centres of its pixels along the major axis. A centre
/// beyond an end has that end's depth.
///
/// In 16.16, stepped like a [`Plane`](super::Plane): n pixels from the smaller end it is off by less than
/// `n·2⁻¹⁷` for the rounding of the step, and 2⁻¹¹ for the reciprocal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along {
    tall: bool,
    /// The pixels of the ends, along the major axis.
    from: i32,
    to: i32,
    /// At `from`, at `from + 1`, and at `to`.
    first: u32,
    second: u32,
    last: u32,
    step: u32,
}

impl Along {
    /// Of the line that [`line`](super::line()) draws between the pixels of two points; depths in 16.8, 24
    /// bits.
    pub(crate) fn new([a, b]: [ScreenPoint; 2], [za, zb]: [i32; 2]) -> Self {
        let (p, q): (Pixel, Pixel) = (a.pixel(), b.pixel());
        let extent = |a: i16, b: i16| (i32::from(a) - i32::from(b)).abs();
        let tall = extent(p.y, q.y) > extent(p.x, q.x); // as `line` has it
        let (a, b) = if tall { (a.y, b.y) } else { (a.x, b.x) };
        let ((a, za), (b, zb)) = if a <= b { ((a, za), (b, zb)) } else { ((b, zb), (a, za)) };
        let (from, to) = (a >> 8, b >> 8);
        let steps = |z: i32| (z as u32) << 8; // za, zb < 2²⁴
        if from == to {
            let nearer = steps(za.min(zb));
            return Self { tall, from, to, first: nearer, second: nearer, last: nearer, step: 0 };
        }
        // In 2⁻¹² of 2^(53 − shift)·2⁻¹⁶ steps per sub-pixel: 1/(b − a) = mantissa · 2^(shift − 61).
        let r = reciprocal(b - a); // 1 … 2²²
        let product = mul_wide(zb - za, r.mantissa) >> 12; // 25 + 31 − 12 bits
        let down = 41 - r.shift.min(30); // 11 … 41
                                         // Up to 384 sub-pixels: 9 bits.
        let climb = |by: i32| ((product * i64::from(by)) >> down) as u32;
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

    /// The value at a pixel of the line, in 2⁻⁸ of the ends' unit.
    pub(crate) fn at(&self, x: i32, y: i32) -> u32 {
        let along = if self.tall { y } else { x };
        if along <= self.from {
            self.first
        } else if along >= self.to {
            self.last
        } else {
            // Between the ends, so what wraps on the way does no harm.
            self.second.wrapping_add(self.step.wrapping_mul((along - self.from - 1) as u32))
        }
    }

    /// Of depths: 0 near … 65534 far.
    pub(crate) fn depth(&self, x: i32, y: i32) -> u16 {
        (((self.at(x, y) + (1 << 15)) >> 16) as u16).min(u16::MAX - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_along_a_line_is_that_of_the_point_on_it() {
        let mut state = 7u64;
        let mut below = |n: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as i64) % n
        };
        let mut largest = 0;
        for i in 0..200_000 {
            let reach = [300, 3000, 130_000][i % 3];
            let mut point =
                || ScreenPoint::from_subpixels(below(reach) as i32 - 700, below(reach) as i32 - 90).unwrap();
            let (a, b) = (point(), point());
            let (za, zb) = (below(65_534 * 256) as i32, below(65_534 * 256) as i32);
            let along = Along::new([a, b], [za, zb]);
            let (p, q) = (a.pixel(), b.pixel());
            let tall = (i32::from(p.y) - i32::from(q.y)).abs() > (i32::from(p.x) - i32::from(q.x)).abs();
            let of = |p: ScreenPoint| i128::from(if tall { p.y() } else { p.x() });
            let (from, to) = (of(a), of(b));
            if from >> 8 == to >> 8 {
                assert_eq!(along.depth(p.x.into(), p.y.into()), ((za.min(zb) + 128) >> 8) as u16);
                continue;
            }
            for pixel in [from >> 8, (from >> 8) + (to - from).signum(), (from + to) >> 9, to >> 8] {
                // In rationals over to − from, centres beyond the ends brought there.
                let centre = (256 * pixel + 128).clamp(from.min(to), from.max(to));
                let exact = i128::from(za) * (to - centre) + i128::from(zb) * (centre - from);
                let stored = i128::from(along.depth(pixel as i32, pixel as i32)) * 256 * (to - from);
                // In 1/1000 steps.
                let error = (stored - exact).abs() * 1000 / (256 * (to - from).abs());
                largest = largest.max(error);
            }
        }
        // 1/2, 512 pixels of 2⁻¹⁷, the reciprocal.
        assert!((500..=505).contains(&largest), "{largest}");
    }
}
