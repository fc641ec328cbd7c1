//! Depth and 1/w at the corners of a triangle, for shaders that ask for them.

use crate::math::num::reciprocal_called;
use crate::math::unrolled::map3;

/// Depth and 1/w at the corners of a triangle, in the order of its corners: see
/// [`Shader::with_corners`](crate::shading::Shader::with_corners).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CornerValues {
    depths: [i32; 3],
    /// In the unit of the face's vertices. Those of one face may be compared, as multiples of each other.
    pub(super) w: [i32; 3],
}

impl CornerValues {
    /// From depths in 16.8, and positive w in any unit.
    #[inline(always)]
    pub(crate) const fn new(depths: [i32; 3], w: [i32; 3]) -> Self {
        Self { depths, w }
    }

    /// Depths in 1/256 of a step: 0 near … 65534·256 + 119 far, linear on the screen. Without a meaning if the shader does not
    /// [ask for them](crate::shading::Shader::NEEDS_DEPTH).
    pub const fn depths(&self) -> [i32; 3] {
        self.depths
    }

    /// Numbers proportional to 1/w, the reciprocal of clip space's w, which is linear on the screen. The largest of the three
    /// is 2³⁰ … 2³¹ − 1; the error of each is at most 2⁻²⁹ of its value, plus 1. All three are equal in a parallel projection.
    ///
    /// The unknown factor is the same for the three corners, but differs from triangle to triangle: divide interpolated values
    /// of one triangle (u/w by 1/w), but do not compare values of two triangles.
    pub fn inverse_w(&self) -> [i32; 3] {
        inverse_w(self.w)
    }
}

/// Reciprocals of three w with one common factor, as [`CornerValues::inverse_w`] returns them.
pub(super) fn inverse_w(w: [i32; 3]) -> [i32; 3] {
    // 1/w = mantissa · 2^(shift − 61), mantissa 2³⁰ … 2³¹ − 1: the smallest w has the largest shift.
    let reciprocals = map3(w, |w| reciprocal_called(w.max(1)));
    let most = reciprocals.iter().fold(0, |most, r| r.shift.max(most));
    map3(reciprocals, |r| r.mantissa >> most.wrapping_sub(r.shift).min(31))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_w_is_proportional_to_the_reciprocal_of_w() {
        for w in [[1, 2, 4], [7, 7, 7], [1 << 20, 3, 1000], [i32::MAX, 1 << 30, 12_345], [5, 1 << 24, 5]] {
            let values = CornerValues::new([1, 2, 3], w);
            assert_eq!(values.depths(), [1, 2, 3]);
            let inverse = values.inverse_w();
            let least = f64::from(*w.iter().min().unwrap());
            let most = f64::from(*inverse.iter().max().unwrap());
            assert!((2.0_f64.powi(30)..2.0_f64.powi(31)).contains(&most), "{inverse:?}");
            for (own, w) in inverse.map(f64::from).into_iter().zip(w.map(f64::from)) {
                // Each is within 2⁻²⁹ of itself and 1, and so is the largest.
                let exact = most * least / w;
                assert!((own - exact).abs() <= 1.0 + exact * 2.0_f64.powi(-28), "{w}: {own} for {exact}");
            }
        }
    }

    #[test]
    fn w_that_is_not_positive_counts_as_the_least() {
        let values = CornerValues::new([0; 3], [0, -5, 1]);
        assert_eq!(values.inverse_w(), CornerValues::new([0; 3], [1; 3]).inverse_w());
    }
}
