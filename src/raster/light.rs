//! One light over a triangle: a plane in 8.24, of most triangles made with depth's reciprocal where both are asked for.

use super::plane::Extent;
use super::{Plane, Planes, Triangle};

impl Plane {
    /// Lights in 8.10, 0 … 255 · 2¹⁰, with the half that rounds: the upper 8 bits at a pixel are its light, rounded to
    /// nearest, with an error of less than 2⁻⁹ before that.
    ///
    /// Most small triangles keep 10 bits of fraction, so that 32 bits are enough, and are off by
    /// `((w + h)·½ + 35)·2⁻¹⁸`, w and h at most 128; all others have 16, and the error of [`Planes::through`],
    /// `((w + h)·½ + 34 + 2¹⁰·⁶)·2⁻²⁴`, w + h ≤ 2¹⁵.
    #[inline(never)]
    pub(crate) fn of_light(triangle: &Triangle<'_>, lights: &[i32; 3]) -> Self {
        let extent = Extent::of(triangle);
        match Planes::small(triangle, extent).and_then(|planes| planes.exact(lights)) {
            Some(plane) => plane.times_64(),
            None => Planes::of_extent(triangle, extent).through(&lights.map(|light| light << 6)), // < 2²⁴
        }
        .rounding_light()
    }

    /// [`of_depth`](Self::of_depth) and [`of_light`](Self::of_light), to the same bits. Each is stored as soon as it is there: the
    /// other one needs the registers.
    #[inline(never)]
    pub(crate) fn of_depth_and_light(
        triangle: &Triangle<'_>,
        depths: &[i32; 3],
        lights: &[i32; 3],
    ) -> [Self; 2] {
        let mut planes = [Self::default(); 2];
        let [of_depth, of_light] = &mut planes;
        if let Some(shared) = Planes::tiny(triangle, Extent::of(triangle)) {
            if let Some(plane) = shared.through_near(depths) {
                *of_depth = plane.with_half();
                match shared.exact(lights) {
                    Some(plane) => *of_light = plane.times_64().rounding_light(),
                    None => *of_light = Self::of_light(triangle, lights),
                }
                return planes;
            }
        }
        *of_depth = Self::of_depth(triangle, depths);
        *of_light = Self::of_light(triangle, lights);
        planes
    }

    /// Of values that have 6 bits less.
    #[inline(always)]
    fn times_64(self) -> Self {
        Self { origin: self.origin << 6, right: self.right << 6, down: self.down << 6 }
    }

    /// With the half that rounds.
    #[inline(always)]
    fn rounding_light(self) -> Self {
        Self { origin: self.origin.wrapping_add(1 << 23), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, triangle, Scissor, ScreenPoint};

    /// A light of a table's entry plus ½ or more is the next entry, at every pixel: on a small and a large triangle, by
    /// itself and next to depth.
    #[test]
    fn an_even_light_is_rounded_to_the_nearest_entry() {
        for size in [8, 2000] {
            let at = |x: i32, y: i32| ScreenPoint::from_subpixels(x << 8, y << 8).unwrap();
            let corners = [at(0, 0), at(0, size), at(size, 0)];
            let scissor = Scissor::new(0, 0, size, size);
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            for (light, entry) in [(100 << 10, 100), ((100 << 10) + 256, 100), ((100 << 10) + 768, 101)] {
                let alone = Plane::of_light(&triangle, &[light; 3]);
                let [_, with_depth] = Plane::of_depth_and_light(&triangle, &[1 << 16; 3], &[light; 3]);
                for plane in [alone, with_depth] {
                    assert_eq!(plane.at(1, 1) >> 24, entry, "{light} over {size} pixels");
                }
            }
        }
    }

    /// The largest distance of a covered pixel's light from the exact one, in 2⁻²⁴, rounded up.
    fn worst(random: &mut Random, reach: i64, viewport: i32, cases: u32) -> i128 {
        let (mut worst, side) = (0, i64::from(viewport) * 256);
        let scissor = Scissor::new(-viewport, -viewport, viewport, viewport);
        for case in 0..cases {
            let middle = [0; 2].map(|_| i64::from(random.within(side)));
            let mut corner = || {
                middle.map(|m| {
                    // Every fourth one as large as can be.
                    let end = (2 * random.below(2) - 1) * reach;
                    let away = if case % 4 == 1 { end } else { i64::from(random.within(reach)) };
                    (m + away + i64::from(random.within(1))).clamp(-1 << 21, 1 << 21)
                })
            };
            let (a, b, mut c) = (corner(), corner(), corner());
            if case % 4 == 0 {
                // As thin as can be.
                let k = i64::from(random.within(256)).abs();
                c = [0, 1].map(|i| a[i] + (((b[i] - a[i]) * k) >> 8) + i64::from(random.within(1)));
                c = c.map(|v| v.clamp(-1 << 21, 1 << 21));
            }
            let points = [a, b, c].map(|[x, y]| ScreenPoint::from_subpixels(x as i32, y as i32).unwrap());
            if area(&points) == 0 {
                continue;
            }
            let lights = [0; 3].map(|_| match random.within(2) {
                0 => 0,
                1 => 255 << 10,
                _ => random.within(255 << 10).abs(),
            });
            let plane = Plane::of_light(&Triangle::new(points, area(&points), &scissor), &lights);
            let cross = |p: [i64; 2], q: [i64; 2], r: [i64; 2]| {
                i128::from((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
            };
            let Ok::<(), core::convert::Infallible>(()) = triangle(points, &scissor, |span| {
                for x in [span.x, span.x + span.width - 1] {
                    let p = [x, span.y].map(|v| i64::from(v) * 256 + 128);
                    let [u, v, w] = lights.map(i128::from);
                    let exact = u * cross(p, b, c) + v * cross(a, p, c) + w * cross(a, b, p);
                    let whole = cross(a, b, c);
                    // No sum leaves 0 … 2³²: the half is taken off again.
                    let light = i128::from(plane.at(x, span.y)) - (1 << 23);
                    worst = worst.max((light * whole - (exact << 14)).abs() / whole.abs() + 1);
                }
                Ok(())
            });
        }
        worst
    }

    /// Where they share a reciprocal and where they do not.
    #[test]
    fn depth_and_light_at_once_are_those_of_each() {
        let random = &mut Random(8);
        let scissor = Scissor::new(-600, -600, 600, 600);
        for case in 0..60_000 {
            let reach = [100, 1_000, 4_100, 20_000, 200_000][case % 5];
            let middle = [0; 2].map(|_| random.within(100_000));
            let corners = [0; 3].map(|_| {
                let [x, y] = middle.map(|m| m + random.within(reach));
                ScreenPoint::from_subpixels(x, y).unwrap()
            });
            let apart = [1 << 10, 1 << 18, 1 << 22][case % 3];
            let depths = [0; 3].map(|_| (1 << 23) + random.within(apart));
            let lights = [0; 3].map(|_| random.within(255 << 10).abs());
            if area(&corners) != 0 {
                let triangle = Triangle::new(corners, area(&corners), &scissor);
                let each = [Plane::of_depth(&triangle, &depths), Plane::of_light(&triangle, &lights)];
                let numbers = |planes: [Plane; 2]| planes.map(|p| (p.origin, p.right, p.down));
                let at_once = Plane::of_depth_and_light(&triangle, &depths, &lights);
                assert_eq!(numbers(at_once), numbers(each), "{triangle:?} {depths:?} {lights:?}");
            }
        }
    }

    #[test]
    fn light_over_a_triangle_stays_within_the_bound() {
        let random = &mut Random(7);
        // Below 64 pixels in 18 bits, 2⁶ of these; all others in 24.
        let small = [600, 4_000, 16_000].map(|reach| worst(random, reach, 600, 30_000));
        let large = [65_000, 300_000, 2_000_000].map(|reach| worst(random, reach, 8192, 1_000));
        let (small, large) = (small.into_iter().max().unwrap(), large.into_iter().max().unwrap());
        let (bound, bound_large) = ((128 + 35) << 6, (1 << 14) + 34 + 1552);
        assert!(bound <= 1 << 15 && bound_large <= 1 << 15, "2⁻⁹");
        assert!(small <= bound && large <= bound_large, "{small} {large}");
        assert!(small > bound / 2 && large > bound_large / 2, "{small} {large}");
    }
}
