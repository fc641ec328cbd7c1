//! Depth, or a channel of colour, over a triangle: the plane through its corners' values, stepped in
//! 32 bits.
//!
//! At the centre of a covered pixel the plane lies between the values of the corners, so only its value
//! modulo 2²⁴ units has to be carried: all sums here wrap, and no gradient is too steep.
//!
//! With corners a, b, c and differences from a, the plane climbs by
//!
//! ```text
//!     ∂z/∂x = (dz₁·dy₂ − dz₂·dy₁) / den,   ∂z/∂y = (dx₁·dz₂ − dx₂·dz₁) / den,   den = dx₁·dy₂ − dx₂·dy₁
//! ```
//!
//! (Pineda, *A parallel algorithm for polygon rasterization*, 1988, section 3.4.)

use super::{Scissor, ScreenPoint};
use crate::math::num::{mul_wide, reciprocal};

/// The largest depth of a corner in 16.8: half a step below the far plane's 65535, and 9/256 less, so
/// that what stepping adds to it within 512 pixels does not reach 65535, which stands for nothing.
pub(crate) const FARTHEST: i32 = 65_534 * 256 + 119;

/// The same beyond 512 pixels, where stepping adds 2⁻¹⁷ for every column and row.
fn farthest_of_large(viewport: &Scissor) -> i32 {
    let pixels = (viewport.right - viewport.left).max(0) + (viewport.bottom - viewport.top).max(0); // ≤ 2¹⁷
    FARTHEST.min(65_534 * 256 + 127 - (pixels >> 9))
}

/// A triangle ready to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    corners: [ScreenPoint; 3],
    /// [`area`](super::area); not zero.
    area: i64,
    viewport: Scissor,
}

impl Triangle {
    /// `area` is that of the corners, and not zero; pixels outside the viewport will not be asked for.
    #[inline(always)]
    pub(crate) fn new(corners: [ScreenPoint; 3], area: i64, viewport: &Scissor) -> Self {
        Self { corners, area, viewport: *viewport }
    }

    /// Its covered pixels inside the scissor, row by row.
    #[inline]
    pub(crate) fn fill<E>(
        &self,
        scissor: &Scissor,
        span: impl FnMut(super::Span) -> Result<(), E>,
    ) -> Result<(), E> {
        super::fill(self.corners, self.area > 0, scissor, span)
    }

    /// Whether all its edges are shorter than 512 pixels.
    fn is_small(&self) -> bool {
        self.extent() < 1 << 17
    }

    /// A number with as many bits as the largest difference from its first corner has, in sub-pixels.
    fn extent(&self) -> u32 {
        let [a, b, c] = self.corners;
        let (dx1, dy1) = (b.x - a.x, b.y - a.y);
        let (dx2, dy2) = (c.x - a.x, c.y - a.y);
        (dx1.abs() | dx2.abs() | dy1.abs() | dy2.abs()).unsigned_abs()
    }
}

/// What varies linearly over a triangle on the screen, for the centres of the pixels that it covers:
/// depth, or a channel of colour. Values are 24 bits at the corners, 32 bits at the pixels.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// At pixel (0, 0), in 2⁻⁸ of the corners' unit, wrapping, as are the steps.
    origin: u32,
    right: u32,
    down: u32,
}

impl Plane {
    /// Through corners with values 0 … 2²⁴ − 1.
    ///
    /// **Error.** In 2⁻⁸ of the corners' unit, a pixel w columns and h rows from the corner's pixel, and
    /// not more than they span from it, is off by less than `(w + h)·½` for the rounding of the steps, 1
    /// for that of the origin, and, by the quick way, 2¹⁰·⁶ for the reciprocal: see [`quick`].
    #[inline]
    pub(crate) fn new(triangle: &Triangle, [za, zb, zc]: [i32; 3]) -> Self {
        let Triangle { corners: [a, b, c], area, viewport } = triangle;
        // |dx|, |dy| ≤ 2²², |dz| < 2²⁴.
        let (dx1, dy1) = (b.x - a.x, b.y - a.y);
        let (dx2, dy2) = (c.x - a.x, c.y - a.y);
        let (dz1, dz2) = (zb - za, zc - za);
        // Below 2⁴⁷ each; over `den = −area`.
        let across = mul_wide(dz2, dy1) - mul_wide(dz1, dy2);
        let along = mul_wide(dx2, dz1) - mul_wide(dx1, dz2);
        let (across, along) = if *area < 0 { (-across, -along) } else { (across, along) };
        let area = area.unsigned_abs();
        // Steps per sub-pixel: 24 bits of the values, and 40 more.
        let quick = if triangle.is_small() { quick(across, along, area, triangle.extent()) } else { None };
        let (column, row, gradient) = match quick {
            Some(gradient) => (a.x >> 8, a.y >> 8, gradient),
            None => {
                // From a pixel near those that are asked for: the error grows with the way. Not nearer
                // than the viewport, so that every band computes the same.
                let column = (a.x >> 8).clamp(viewport.left, viewport.right.max(viewport.left));
                let row = (a.y >> 8).clamp(viewport.top, viewport.bottom.max(viewport.top));
                (column, row, (quotient(across, area), quotient(along, area)))
            }
        };
        // To that pixel's centre: up to 2²³ sub-pixels.
        let (x, y) = (256 * column + 128 - a.x, 256 * row + 128 - a.y);
        let at = ((za as u64) << 40)
            .wrapping_add((gradient.0 as u64).wrapping_mul(i64::from(x) as u64))
            .wrapping_add((gradient.1 as u64).wrapping_mul(i64::from(y) as u64));
        // A pixel is 256 sub-pixels; from 24.40 to 24.8, to nearest.
        let step = |g: i64| (((g << 8).wrapping_add(1 << 31)) >> 32) as u32;
        let (right, down) = (step(gradient.0), step(gradient.1));
        let origin = ((at >> 32) as u32)
            .wrapping_sub(right.wrapping_mul(column as u32))
            .wrapping_sub(down.wrapping_mul(row as u32));
        Self { origin, right, down }
    }

    /// Depths in 16.8, 0 … [`FARTHEST`], with the half that rounds: the upper 16 bits at a pixel are its
    /// depth. In steps of depth the error of [`new`](Self::new) is `(w + h)·2⁻¹⁷`, 2⁻¹⁶ and 2⁻⁵·⁴:
    /// triangles within 512 pixels stay below 1/30, all others below ¼.
    #[inline]
    pub(crate) fn of_depth(triangle: &Triangle, depths: [i32; 3]) -> Self {
        let depths = if triangle.is_small() {
            depths
        } else {
            depths.map(|z| z.min(farthest_of_large(&triangle.viewport)))
        };
        let plane = Self::new(triangle, depths);
        Self { origin: plane.origin.wrapping_add(1 << 15), ..plane }
    }

    /// At the centre of a covered pixel.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// From a pixel to its right neighbour, to be added wrapping.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.right
    }
}

/// Both gradients of a triangle within 512 pixels by a reciprocal, in 2⁻⁴⁰, or `None` where they are too steep for it.
///
/// The reciprocal of the area is off by 2⁻²⁸ of itself, and the area and the numerator, cut to 31
/// bits, by 2⁻³⁰ each: together less than 2⁻²⁷·⁴. Gradient times extent, below 2²¹ steps for x and
/// for y, makes that 2⁻⁵·⁴ steps.
#[inline]
fn quick(across: i64, along: i64, area: u64, extent: u32) -> Option<(i64, i64)> {
    // area = m·2^down with 31 bits, or fewer where it has fewer.
    let down = (33 - area.leading_zeros() as i32).max(0);
    let r = reciprocal((area >> down) as i32); // 1/m = mantissa · 2^(shift − 61)
    let by_area = |v: i64| {
        let cut = (33 - v.unsigned_abs().leading_zeros() as i32).max(0);
        // v/area · 2⁴⁰ = (v >> cut) · mantissa · 2^(cut − down + shift − 21): |product| < 2⁶².
        let left = cut - down + r.shift as i32 - 21;
        let product = mul_wide((v >> cut) as i32, r.mantissa);
        // At least 2⁻⁶¹: shifted by 21 + 17 at most, as area < 2⁴⁵.
        (left <= 0).then(|| product >> (-left).min(63))
    };
    let (x, y) = (by_area(across)?, by_area(along)?);
    let steepest = x.unsigned_abs() | y.unsigned_abs();
    // In bits: 40 of the gradient's and 8 of the extent's are fractions, and 2²¹ may be reached.
    let bits = (64 - steepest.leading_zeros()) + (32 - extent.leading_zeros());
    (bits <= 69).then_some((x, y))
}

/// `⌊v · 2⁴⁰ / area⌋` modulo 2⁶⁴ for |v| < 2⁴⁷ and 0 < area < 2⁴⁶, by long division: 87 steps, for
/// slivers and for triangles beyond 512 pixels.
#[cold]
fn quotient(v: i64, area: u64) -> i64 {
    let magnitude = v.unsigned_abs();
    let (mut quotient, mut rest) = (0u64, 0u64);
    for bit in (-40..47).rev() {
        let digit = if bit >= 0 { (magnitude >> bit) & 1 } else { 0 };
        rest = (rest << 1) | digit; // rest < 2·area
        quotient = quotient.wrapping_shl(1);
        if rest >= area {
            rest = rest.wrapping_sub(area);
            quotient |= 1;
        }
    }
    let quotient = quotient as i64;
    if v < 0 {
        quotient.wrapping_neg().wrapping_sub(i64::from(rest > 0))
    } else {
        quotient
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{area, triangle};

    /// Half a step, in 2⁻²⁰; a pixel's 2⁻¹⁷ is 8 of these.
    const HALF: i128 = 1 << 19;

    struct Random(u64);

    impl Random {
        fn below(&mut self, n: i64) -> i64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((self.0 >> 33) as i64) % n
        }

        fn within(&mut self, n: i64) -> i32 {
            (self.below(2 * n + 1) - n) as i32
        }
    }

    /// Largest distance of a covered pixel's stored depth from the exact plane, in 2⁻²⁰ steps, rounded
    /// up; the plane in rationals, over all covered pixels of a scissor.
    fn worst(corners: [(i32, i32, i32); 3], scissor: &Scissor) -> i128 {
        let points = corners.map(|(x, y, _)| ScreenPoint::from_subpixels(x, y).unwrap());
        if area(&points) == 0 {
            return 0;
        }
        let plane = Plane::of_depth(&Triangle::new(points, area(&points), scissor), corners.map(|c| c.2));
        // The determinant form of the plane, at p: three areas as weights.
        let cross = |p: (i128, i128), q: (i128, i128), r: (i128, i128)| {
            (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)
        };
        let [a, b, c] = corners.map(|(x, y, _)| (i128::from(x), i128::from(y)));
        // From the first corner, as the code measures it.
        let beyond = |c: &(i32, i32, i32)| {
            let (dx, dy) = (c.0 - corners[0].0, c.1 - corners[0].1);
            dx.abs().max(dy.abs()) >= 512 * 256
        };
        let farthest = if corners.iter().any(beyond) { farthest_of_large(scissor) } else { FARTHEST };
        let [za, zb, zc] = corners.map(|c| i128::from(c.2.min(farthest)));
        let whole = cross(a, b, c);
        let mut worst = 0;
        let Ok::<(), core::convert::Infallible>(()) = triangle(points, scissor, |span| {
            // A span's ends and its middle: the error is linear in between but for rounding.
            for x in [span.x, span.x + span.width / 2, span.x + span.width - 1] {
                let p = (i128::from(x) * 256 + 128, i128::from(span.y) * 256 + 128);
                let exact = za * cross(p, b, c) + zb * cross(a, p, c) + zc * cross(a, b, p);
                let stored = i128::from(plane.at(x, span.y) >> 16);
                assert!(stored <= 65_534, "{corners:?} ({x}, {}): {stored}", span.y);
                // 24 + 46 + 20 bits over 54.
                let error = (stored * 256 * whole - exact).abs() << 20;
                worst = worst.max(error / (256 * whole.abs()) + 1);
            }
            Ok(())
        });
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
    fn d2_small_triangles_and_slivers_stay_within_the_bound() {
        let (mut random, mut largest) = (Random(1), 0);
        let scissor = Scissor::new(-600, -600, 600, 600);
        for i in 0..100_000 {
            let reach = [3, 40, 300, 2_000, 20_000, 130_000][i % 6];
            let centre = (random.within(1000), random.within(1000));
            let mut corner = || (centre.0 + random.within(reach), centre.1 + random.within(reach));
            let (a, b, mut c) = (corner(), corner(), corner());
            if i % 4 == 0 {
                // On the line through a and b but for a unit: as thin as can be.
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

    #[test]
    fn d2_triangles_across_the_guard_band_stay_within_the_bound() {
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
