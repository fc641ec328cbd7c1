//! Random triangles with exact weights, for tests of interpolation.

use crate::math::random::Random;
use crate::raster::{area, triangle, Scissor, ScreenPoint, Triangle};
use core::convert::Infallible;

/// A triangle that is not degenerate, and the rectangle that it is drawn in.
pub(crate) struct RandomTriangle {
    corners: [[i64; 2]; 3],
    scissor: Scissor,
}

/// Calls `visit` with `cases` triangles, less the degenerate ones. Their corners are within `reach` subpixels of a point in
/// the viewport, which is `viewport` pixels to each side of the origin. Every fourth is a sliver, every fourth as large as
/// `reach` allows.
pub(crate) fn each_random_triangle(
    random: &mut Random,
    reach: i64,
    viewport: i32,
    cases: u32,
    mut visit: impl FnMut(&mut Random, &RandomTriangle),
) {
    let side = i64::from(viewport) * 256;
    let scissor = Scissor::new(-viewport, -viewport, viewport, viewport);
    let in_range = |v: i64| v.clamp(-1 << 21, 1 << 21);
    for case in 0..cases {
        let middle = [0; 2].map(|_| i64::from(random.within(side)));
        let mut corner = || {
            middle.map(|m| {
                let end = (2 * random.below(2) - 1) * reach;
                let away = if case % 4 == 1 { end } else { i64::from(random.within(reach)) };
                in_range(m + away + i64::from(random.within(1)))
            })
        };
        let (a, b, mut c) = (corner(), corner(), corner());
        if case % 4 == 0 {
            let k = i64::from(random.within(256)).abs();
            c = [0, 1].map(|i| in_range(a[i] + (((b[i] - a[i]) * k) >> 8) + i64::from(random.within(1))));
        }
        let triangle = RandomTriangle { corners: [a, b, c], scissor };
        if area(&triangle.points()) != 0 {
            visit(random, &triangle);
        }
    }
}

impl RandomTriangle {
    fn points(&self) -> [ScreenPoint; 3] {
        self.corners.map(|[x, y]| ScreenPoint::from_subpixels(x as i32, y as i32).unwrap())
    }

    pub(crate) fn set_up(&self) -> Triangle<'_> {
        Triangle::new(self.points(), area(&self.points()), &self.scissor)
    }

    /// Calls `visit` with the first and the last pixel of each covered row, and the exact value there of an attribute that has
    /// `values` at the corners, as a numerator and its denominator.
    pub(crate) fn each_row_end(&self, values: [i32; 3], mut visit: impl FnMut(i32, i32, i128, i128)) {
        let [a, b, c] = self.corners;
        let cross = |p: [i64; 2], q: [i64; 2], r: [i64; 2]| {
            i128::from((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
        };
        let Ok::<(), Infallible>(()) = triangle(self.points(), &self.scissor, |span| {
            for x in [span.x, span.x + span.width - 1] {
                let p = [x, span.y].map(|v| i64::from(v) * 256 + 128);
                let [u, v, w] = values.map(i128::from);
                visit(
                    x,
                    span.y,
                    u * cross(p, b, c) + v * cross(a, p, c) + w * cross(a, b, p),
                    cross(a, b, c),
                );
            }
            Ok(())
        });
    }
}
