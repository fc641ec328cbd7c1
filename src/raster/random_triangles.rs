//! Gradients over random triangles against exact weights, for tests of interpolation.

use crate::math::random::Random;
use crate::raster::{area, Gradient, Scissor, ScreenPoint, Triangle};

/// Random triangles, less the degenerate ones. Their corners are within `reach` subpixels of a point in the viewport, which is `viewport`
/// pixels to each side of the origin. Every fourth is a sliver, every fourth as large as `reach` allows. Their corners have values up to
/// `most`, often 0 or `most` itself.
pub(crate) struct Triangles {
    pub(crate) reach: i64,
    pub(crate) viewport: i32,
    pub(crate) cases: u32,
    pub(crate) most: i32,
}

impl Triangles {
    /// The largest distance of the gradient from the exact value, in units of the gradient, rounded up: at the first and the last pixel
    /// of each covered row. A unit of a corner's value is `1 << shift` of the gradient, which counts from `bias` and may wrap.
    pub(crate) fn worst(
        &self,
        random: &mut Random,
        (shift, bias): (u32, u32),
        gradient: impl Fn(&Triangle<'_>, [i32; 3]) -> Gradient,
    ) -> i128 {
        let scissor = Scissor::new(-self.viewport, -self.viewport, self.viewport, self.viewport);
        let mut worst = 0;
        for case in 0..self.cases {
            let corners @ [a, b, c] = self.corners(random, case);
            let points = corners.map(|[x, y]| ScreenPoint::from_subpixels(x as i32, y as i32).unwrap());
            if area(&points) == 0 {
                continue;
            }
            let values = [0; 3].map(|_| match random.within(2) {
                0 => 0,
                1 => self.most,
                _ => random.within(self.most.into()).abs(),
            });
            let triangle = Triangle::new(points, area(&points), &scissor);
            let found = gradient(&triangle, values);
            let cross = |p: [i64; 2], q: [i64; 2], r: [i64; 2]| {
                i128::from((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
            };
            let (total, [u, v, w]) = (cross(a, b, c), values.map(i128::from));
            for span in triangle.spans(&scissor) {
                for x in [span.x, span.x + span.width - 1] {
                    let p = [x, span.y].map(|v| i64::from(v) * 256 + 128);
                    let exact = u * cross(p, b, c) + v * cross(a, p, c) + w * cross(a, b, p);
                    let own = i128::from(found.at(x, span.y).wrapping_sub(bias));
                    let turn = total.abs() << 32;
                    let off = (own * total - (exact << shift)).rem_euclid(turn);
                    worst = worst.max(off.min(turn - off) / total.abs() + 1);
                }
            }
        }
        worst
    }

    fn corners(&self, random: &mut Random, case: u32) -> [[i64; 2]; 3] {
        let in_range = |v: i64| v.clamp(-1 << 21, 1 << 21);
        let middle = [0; 2].map(|_| i64::from(random.within(i64::from(self.viewport) * 256)));
        let mut corner = || {
            middle.map(|m| {
                let end = (2 * random.below(2) - 1) * self.reach;
                let away = if case % 4 == 1 { end } else { i64::from(random.within(self.reach)) };
                in_range(m + away + i64::from(random.within(1)))
            })
        };
        let (a, b, mut c) = (corner(), corner(), corner());
        if case.is_multiple_of(4) {
            let k = i64::from(random.within(256)).abs();
            c = [0, 1].map(|i| in_range(a[i] + (((b[i] - a[i]) * k) >> 8) + i64::from(random.within(1))));
        }
        [a, b, c]
    }
}
