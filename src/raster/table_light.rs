//! Light over a triangle for a shade table of 256 colours.

use super::gradient_setup::Extent;
use super::{Gradient, GradientSetup, Triangle};

impl Gradient {
    /// The half that rounds light in 8.24 when its lower 24 bits are dropped.
    pub(crate) const LIGHT_BIAS: u32 = 1 << 23;

    /// The gradient of light, given at the corners in 8.10, 0 … 255 · 2¹⁰. Its values at pixels are in 8.24 and include the half
    /// that rounds: their upper 8 bits are the index of the pixel's colour in the table, rounded to nearest after an error of
    /// less than 2⁻⁹.
    ///
    /// Within 128 pixels most triangles keep 10 bits of fraction, so that 32 bits are enough, and are off by
    /// `((w + h)·½ + 35)·2⁻¹⁸`. All others have 16 bits of fraction and the error of [`GradientSetup::through`],
    /// `((w + h)·½ + 34 + 2¹⁰·⁶)·2⁻²⁴`, w + h ≤ 2¹⁵.
    #[inline(never)]
    pub(crate) fn of_light(triangle: &Triangle<'_>, lights: &[i32; 3]) -> Self {
        let extent = Extent::of(triangle);
        match GradientSetup::of_small(triangle, extent).and_then(|setup| setup.through_exactly(lights)) {
            Some(gradient) => gradient.times_64(),
            None => GradientSetup::with_extent(triangle, extent).through(&lights.map(|light| light << 6)), // < 2²⁴
        }
        .add_bias(Self::LIGHT_BIAS)
    }

    /// Converts a gradient of light with 18 bits of fraction to the 24 bits of 8.24: values and steps times 2⁶.
    #[inline(always)]
    pub(crate) fn times_64(self) -> Self {
        Self { origin: self.origin << 6, right: self.right << 6, down: self.down << 6 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::raster::random_triangles::Triangles;

    #[test]
    fn light_over_a_triangle_stays_within_the_bound() {
        let random = &mut Random(7);
        let mut worst = |viewport, cases, reaches: [i64; 3]| {
            let all = reaches.map(|reach| {
                let triangles = Triangles { reach, viewport, cases, most: 255 << 10 };
                triangles.worst(random, (14, Gradient::LIGHT_BIAS), |triangle, lights| {
                    Gradient::of_light(triangle, &lights)
                })
            });
            all.into_iter().max().unwrap()
        };
        // Triangles below 64 pixels have light with 18 fractional bits, so a unit is 2⁶ of 2⁻²⁴; larger triangles have 24.
        let small = worst(600, 30_000, [600, 4_000, 16_000]);
        let large = worst(8192, 1_000, [65_000, 300_000, 2_000_000]);
        let (bound, bound_large) = ((128 + 35) << 6, (1 << 14) + 34 + 1552);
        assert!(bound <= 1 << 15 && bound_large <= 1 << 15, "2⁻⁹");
        assert!(small <= bound && large <= bound_large, "{small} {large}");
        assert!(small > bound / 2 && large > bound_large / 2, "{small} {large}");
    }
}
