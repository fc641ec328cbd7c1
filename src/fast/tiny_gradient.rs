//! Gradients of depth, and of depth and light, over tiny triangles in 32-bit arithmetic.
//!
//! - **Plain twins**: `Gradient::of_depth` in `raster/depth.rs` and `Gradient::of_light` in `raster/table_light.rs`.
//! - **Domain**: that of `GradientSetup::through_tiny` in `raster/gradient_setup.rs`: corners within 32 pixels, an area that
//!   is not thin, values less than 2¹⁹ − 4 apart. Most triangles of a fine mesh. All others go to the plain twin.
//! - **Gain**: two 32-bit products and no search for leading zeros per step in place of 64-bit products; light shares
//!   depth's reciprocal. Not measured alone.
//! - **Test**: `gradients_are_those_of_the_plain_twins` in this file.

use crate::math::num::mul_high;
use crate::raster::gradient_setup::{differences, to_centre, Extent, GradientSetup, Numerators, Slope};
use crate::raster::{Gradient, Triangle};

/// The gradient of depth, with the bits of `Gradient::of_depth`.
#[inline(never)]
pub(crate) fn depth_gradient(triangle: &Triangle<'_>, depths: &[i32; 3]) -> Gradient {
    if cfg!(pinhole_plain) {
        return Gradient::of_depth(triangle, depths);
    }
    let extent = Extent::of(triangle);
    match GradientSetup::of_tiny(triangle, extent).and_then(|setup| through_tiny(&setup, depths)) {
        Some(gradient) => gradient.add_bias(Gradient::DEPTH_BIAS),
        None => Gradient::of_general_depth(triangle, extent, depths),
    }
}

/// The gradients of depth and light, with the bits of `Gradient::of_depth` and `Gradient::of_light`. Each is stored as soon as
/// it is computed, which frees the registers for the other.
#[inline(never)]
pub(crate) fn depth_and_light_gradients(
    triangle: &Triangle<'_>,
    depths: &[i32; 3],
    lights: &[i32; 3],
) -> [Gradient; 2] {
    if !cfg!(pinhole_plain)
        && let Some(shared) = GradientSetup::of_tiny(triangle, Extent::of(triangle))
        && let Some(of_depth) = through_tiny(&shared, depths)
    {
        let of_depth = of_depth.add_bias(Gradient::DEPTH_BIAS);
        // Light's place holds depth until light is known: to clear it, opt-level "s" would call `memset`.
        let mut gradients = [of_depth, of_depth];
        let [_, of_light] = &mut gradients;
        match shared.through_exactly(lights) {
            Some(gradient) => *of_light = gradient.times_64().add_bias(Gradient::LIGHT_BIAS),
            None => *of_light = Gradient::of_light(triangle, lights),
        }
        return gradients;
    }
    [depth_gradient(triangle, depths), Gradient::of_light(triangle, lights)]
}

/// [`GradientSetup::through_tiny`] in 32 bits, for set-up of a triangle of at most 32 × 32 pixels.
#[inline(always)]
fn through_tiny(setup: &GradientSetup<'_>, values: &[i32; 3]) -> Option<Gradient> {
    let (dz1, dz2) = differences(values);
    if !setup.is_near(dz1, dz2) {
        return None;
    }
    // The products are below 2³⁰, so the sums are below 2³¹.
    let Numerators { x, minus_y, .. } = Numerators::of_scaled(setup.triangle, dz1 >> 2, dz2 >> 2, -2);
    let (x, y) = (mul_high(x, setup.mantissa), mul_high(-minus_y, setup.mantissa));
    let left = 34 - setup.shift; // −7 … 10
    let (right, down) = match left >= 0 {
        true => (x << (left & 31), y << (left & 31)),
        false => (x >> (-left & 31), y >> (-left & 31)),
    };
    let [value, ..] = values;
    let [a, ..] = &setup.triangle.corners;
    let at = (right >> 8) * to_centre(a.x) + (down >> 8) * to_centre(a.y); // two products of 2³⁰
    Some(Slope::new(a, (value << 8).wrapping_add(at), right, down).gradient())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::{area, Scissor, ScreenPoint, FARTHEST};

    #[test]
    fn gradients_are_those_of_the_plain_twins() {
        let random = &mut Random(8);
        let scissor = Scissor::new(-600, -600, 600, 600);
        let mut near = 0;
        for case in 0..200_000 {
            let reach = [100, 1_000, 4_095, 4_100, 20_000, 200_000][case % 6];
            let center = [0; 2].map(|_| random.within(100_000));
            let mut corners = [0; 3].map(|_| {
                let [x, y] = center.map(|m| m + random.within(reach));
                ScreenPoint::from_subpixels(x, y).unwrap()
            });
            if case % 4 == 0 {
                // About as thin as the domain allows.
                let [a, b, c] = &mut corners;
                let away = 40 + random.below(200);
                (c.x, c.y) = ((a.x + b.x) / 2 + random.within(away), (a.y + b.y) / 2 + random.within(away));
            }
            if area(&corners) == 0 {
                continue;
            }
            let apart = [1 << 10, 1 << 18, 1 << 19, 1 << 22][case % 4];
            let lowest = random.below(i64::from(FARTHEST) - apart);
            let depths = [0; 3].map(|_| match random.below(8) {
                0 => lowest as i32,
                1 => (lowest + apart - 4 - random.below(2)) as i32,
                _ => (lowest + random.below(apart)) as i32,
            });
            let lights = [0; 3].map(|_| random.within(255 << 10).abs());
            let triangle = Triangle::new(corners, area(&corners), &scissor);
            let bits = |g: Gradient| (g.origin, g.right, g.down);
            let plain = [Gradient::of_depth(&triangle, &depths), Gradient::of_light(&triangle, &lights)];
            let shared = depth_and_light_gradients(&triangle, &depths, &lights);
            assert_eq!(bits(depth_gradient(&triangle, &depths)), bits(plain[0]), "{triangle:?} {depths:?}");
            assert_eq!(shared.map(bits), plain.map(bits), "{triangle:?} {depths:?} {lights:?}");
            let setup = GradientSetup::new(&triangle);
            let tiny = Extent::of(&triangle).is_tiny().then_some(&setup);
            let plain = setup.through_tiny(&depths);
            let fast = tiny.and_then(|setup| through_tiny(setup, &depths));
            assert_eq!(fast.map(bits), plain.map(bits), "{triangle:?} {depths:?}");
            near += u32::from(fast.is_some());
        }
        assert!(near > 50_000, "{near}");
    }
}
