//! Depth over a triangle in 16.16, always less than 65535, the value of a clear depth buffer.

use super::gradient_setup::Extent;
use super::{Gradient, GradientSetup, Scissor, Triangle};

/// The largest depth of a corner in 16.8: half a step below the far plane's 65535, and 9/256 less. So the errors of steps within
/// 512 pixels do not raise it to 65535, the value of a clear depth buffer.
pub(crate) const FARTHEST: i32 = 65_534 * 256 + 119;

/// The largest depth of a corner of triangles beyond 512 pixels, where every column and row may add an error of 2⁻¹⁷.
fn farthest_of_large(viewport: &Scissor) -> i32 {
    let pixels = (viewport.right - viewport.left).max(0) + (viewport.bottom - viewport.top).max(0); // ≤ 2¹⁷
    FARTHEST.min(65_534 * 256 + 127 - (pixels >> 9))
}

#[cold]
fn clamp_depths(depths: [i32; 3], viewport: &Scissor) -> [i32; 3] {
    let farthest = farthest_of_large(viewport);
    depths.map(|z| z.min(farthest))
}

impl Gradient {
    /// The half that rounds depths in 16.16 when their lower 16 bits are dropped.
    pub(crate) const DEPTH_BIAS: u32 = 1 << 15;

    /// The gradient of depth, given at the corners in 16.8, 0 … [`FARTHEST`]. Its values include the half that rounds: the upper
    /// 16 bits at a pixel are its depth. The error of [`GradientSetup::through`] is at most `(w + h)·2⁻¹⁷ + 34·2⁻¹⁶ + 2⁻⁵·⁴`
    /// depth steps, where a pixel is w columns and h rows from the first corner: below 1/30 for triangles within 512 pixels,
    /// below ¼ for all others.
    ///
    /// Its fast twin is `fast::depth_gradient`.
    pub(crate) fn of_depth(triangle: &Triangle<'_>, depths: &[i32; 3]) -> Self {
        let extent = Extent::of(triangle);
        match GradientSetup::with_extent(triangle, extent).through_tiny(depths) {
            Some(gradient) => gradient.add_bias(Self::DEPTH_BIAS),
            None => Self::of_general_depth(triangle, extent, depths),
        }
    }

    /// [`of_depth`](Self::of_depth) outside of the domain of [`GradientSetup::through_tiny`].
    #[inline(never)]
    pub(crate) fn of_general_depth(triangle: &Triangle<'_>, extent: Extent, depths: &[i32; 3]) -> Self {
        let mut depths = *depths;
        if extent.is_large() {
            depths = clamp_depths(depths, triangle.viewport);
        }
        GradientSetup::with_extent(triangle, extent).through(&depths).add_bias(Self::DEPTH_BIAS)
    }
}

impl Triangle<'_> {
    /// The gradient of depth, for custom shaders, from the corners' [depths](crate::shading::CornerValues::depths): the upper 16 bits at a
    /// pixel are the depth that a depth buffer stores there.
    pub fn depth_gradient(&self, depths: [i32; 3]) -> Gradient {
        Gradient::of_depth(self, &depths.map(|depth| depth.clamp(0, FARTHEST)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, ScreenPoint};

    /// Half a step of depth in 2⁻²⁰; the 2⁻¹⁷ of a pixel are 8 of these units.
    const HALF: i128 = 1 << 19;

    /// The largest distance of a covered pixel's stored depth from the exact value, over all covered pixels of a scissor,
    /// in 2⁻²⁰ steps, rounded up. The exact value is computed in rationals.
    fn worst(corners: [(i32, i32, i32); 3], scissor: &Scissor) -> i128 {
        let points = corners.map(|(x, y, _)| ScreenPoint::from_subpixels(x, y).unwrap());
        if area(&points) == 0 {
            return 0;
        }
        let gradient =
            Gradient::of_depth(&Triangle::new(points, area(&points), scissor), &corners.map(|c| c.2));
        // The exact value at p in barycentric form: three areas as weights.
        let cross = |p: (i128, i128), q: (i128, i128), r: (i128, i128)| {
            (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)
        };
        let [a, b, c] = corners.map(|(x, y, _)| (i128::from(x), i128::from(y)));
        // Differences from the first corner, as `Extent` measures them.
        let beyond = |c: &(i32, i32, i32)| {
            let (dx, dy) = (c.0 - corners[0].0, c.1 - corners[0].1);
            dx.abs().max(dy.abs()) >= 512 * 256
        };
        let farthest = if corners.iter().any(beyond) { farthest_of_large(scissor) } else { FARTHEST };
        let [za, zb, zc] = corners.map(|c| i128::from(c.2.min(farthest)));
        let total = cross(a, b, c);
        let mut worst = 0;
        for span in Triangle::new(points, area(&points), scissor).spans(scissor) {
            // A span's ends and its middle: the error is linear in between but for rounding.
            for x in [span.x, span.x + span.width / 2, span.x + span.width - 1] {
                let p = (i128::from(x) * 256 + 128, i128::from(span.y) * 256 + 128);
                let exact = za * cross(p, b, c) + zb * cross(a, p, c) + zc * cross(a, b, p);
                let stored = i128::from(gradient.at(x, span.y) >> 16);
                assert!(stored <= 65_534, "{corners:?} ({x}, {}): {stored}", span.y);
                // 24 + 46 + 20 bits over 54.
                let error = (stored * 256 * total - exact).abs() << 20;
                worst = worst.max(error / (256 * total.abs()) + 1);
            }
        }
        worst
    }

    fn depth(random: &mut Random) -> i32 {
        match random.below(6) {
            0 => 0,
            1 => FARTHEST,
            2 => FARTHEST - random.below(1000) as i32,
            3 => random.below(1000) as i32,
            _ => random.below(i64::from(FARTHEST) + 1) as i32,
        }
    }

    #[test]
    fn d2_depth_of_small_triangles_and_slivers_stays_within_the_bound() {
        let (mut random, mut largest) = (Random(1), 0);
        let scissor = Scissor::new(-600, -600, 600, 600);
        for i in 0..100_000 {
            let reach = [3, 40, 300, 2_000, 20_000, 130_000][i % 6];
            let centre = (random.within(1000), random.within(1000));
            let mut corner = || (centre.0 + random.within(reach), centre.1 + random.within(reach));
            let (a, b, mut c) = (corner(), corner(), corner());
            if i % 4 == 0 {
                // Within a unit of the line through a and b: a sliver.
                let t = random.below(257) as i32;
                let along = |p: i32, q: i32| (i64::from(p) + ((i64::from(q - p) * i64::from(t)) >> 8)) as i32;
                c = (along(a.0, b.0) + random.within(1), along(a.1, b.1) + random.within(1));
            }
            let mut with = |p: (i32, i32)| (p.0, p.1, depth(&mut random));
            largest = largest.max(worst([with(a), with(b), with(c)], &scissor));
        }
        // 1/2, 1200 columns and rows of 2⁻¹⁷ each, and the reciprocal.
        let bound = HALF + (2400 << 3) + 25_165; // 0.024
        assert!(largest <= bound && largest > HALF + (HALF / 100), "{largest} of {bound}");
    }

    /// The bound of docs/spec.md, section 7, for triangles at and inside the limits of `through_tiny`, as most triangles of a fine mesh are.
    #[test]
    fn d2_depth_of_tiny_triangles_stays_within_the_bound() {
        let (mut random, mut largest, mut near) = (Random(3), 0, 0);
        let scissor = Scissor::new(-600, -600, 600, 600);
        for i in 0..200_000 {
            let reach = [100, 400, 1000, 4095, 4100][i % 5];
            let centre = (random.within(100_000), random.within(100_000));
            let mut point = || (centre.0 + random.within(reach), centre.1 + random.within(reach));
            let (a, b, mut c) = (point(), point(), point());
            if i % 2 == 0 {
                // Close to the edge from a to b: about as thin as the domain allows.
                let away = 40 + random.below(200);
                c = ((a.0 + b.0) / 2 + random.within(away), (a.1 + b.1) / 2 + random.within(away));
            }
            let apart = [1 << 19, 1 << 17, 1 << 20, 1 << 10][(i / 8) % 4];
            let lowest = random.below(i64::from(FARTHEST) - apart);
            let mut with = |p: (i32, i32)| match random.below(8) {
                0 => (p.0, p.1, lowest as i32),
                1 => (p.0, p.1, (lowest + apart - 5) as i32),
                _ => (p.0, p.1, (lowest + random.below(apart)) as i32),
            };
            let corners = [with(a), with(b), with(c)];
            let points = corners.map(|(x, y, _)| ScreenPoint::from_subpixels(x, y).unwrap());
            if area(&points) != 0 {
                let triangle = Triangle::new(points, area(&points), &scissor);
                let own = worst(corners, &scissor);
                if GradientSetup::new(&triangle).through_tiny(&corners.map(|c| c.2)).is_some() {
                    (largest, near) = (largest.max(own), near + 1);
                }
            }
        }
        // Half a step for rounding, and the error that `through_tiny` documents.
        let bound = HALF + 20_496; // 1281 · 2⁻¹⁶
        assert!(largest <= bound && largest - HALF > (bound - HALF) / 2, "{largest} of {bound}");
        assert!(near > 80_000, "{near}");
    }

    #[test]
    fn d2_depth_of_triangles_across_the_guard_band_stays_within_the_bound() {
        let (mut random, mut largest) = (Random(2), 0);
        for i in 0..1_000 {
            let mut corner = || (random.within(1 << 21), random.within(1 << 21));
            let (a, b, c) = (corner(), corner(), corner());
            let mut with = |p: (i32, i32)| (p.0, p.1, depth(&mut random));
            let corners = [with(a), with(b), with(c)];
            let (x, y) = (random.within(8000), random.within(8000));
            let scissor = match i % 2 {
                0 => Scissor::new(x, y, x + 320, y + 240),
                _ => Scissor::new(-8192, -8192, 8192, 8192),
            };
            let own = worst(corners, &scissor);
            let pixels = if i % 2 == 0 { 560 } else { 32_768 };
            assert!(own <= HALF + (pixels << 3) + 104, "{own}: {corners:?}"); // and 0.0001
            largest = largest.max(own);
        }
        assert!(largest > HALF + HALF / 10, "{largest}"); // the whole band shows the rounding of the steps
    }
}
