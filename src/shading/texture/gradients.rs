//! Texture coordinates over a triangle.

use super::linear::{is_linear, linear_gradients, packed_gradient, range};
use super::mapping::{FaceCoords, FRACTION};
use super::perspective::Perspective;
use crate::math::num::leading_zeros;
use crate::raster::{Gradient, Triangle};

/// Texture coordinates over a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gradients {
    /// Linear on the screen: all corners are about as far away, or the projection is parallel. Both coordinates in one
    /// [word](super::line::packed), over a triangle of at most 32 × 32 pixels.
    Packed(Gradient),
    /// Linear on the screen: u and v in 2⁻³² of the sides.
    Linear([Gradient; 2]),
    /// Linear over each row.
    Rows(Perspective),
    Perspective(Perspective),
}

impl Gradients {
    /// Of a texture whose width and height have these binary logarithms; `is_wide`: [`Texels::WIDE`](super::Texels::WIDE).
    #[inline(never)] // its stack frame is gone when it returns, and what it returns is not copied
    pub(super) fn new(
        coords: &FaceCoords,
        size_bits: [u32; 2],
        is_wide: bool,
        triangle: &Triangle<'_>,
    ) -> Self {
        let [[ua, va], [ub, vb], [uc, vc]] = coords.uv;
        let values = [[ua, ub, uc], [va, vb, vc]];
        let [u, v] = &values;
        let ranges @ [(_, width), (_, height)] = [range(u), range(v)];
        // A unit is 2^(unit − FRACTION + bits − 32) texel: |Δu·Δw| ≤ 4·2^−accuracy texels · w, in 2²⁸. The right shifts of w are
        // 5 … 30.
        let (unit @ [u_unit, v_unit], [w, h]) = (coords.unit, size_bits);
        let shift = |unit: u8, bits: u32| {
            (coords.accuracy as u32 + u32::from(unit) + bits).wrapping_sub(FRACTION + 6)
        };
        let [w, h] = [shift(u_unit, w), shift(v_unit, h)];
        // (1/w₀ − 1/w₁)/(1/w₁) = (w₁ − w₀)/w₀.
        let (nearest, apart) = range(&coords.w);
        if is_linear(width as u32, apart as u32, nearest, w)
            && is_linear(height as u32, apart as u32, nearest, h)
        {
            if !is_wide && let Some(gradient) = packed_gradient(triangle, &values, &ranges, unit) {
                return Self::Packed(gradient);
            }
            return Self::Linear(linear_gradients(triangle, &values, &ranges, unit, is_wide));
        }
        Perspective::set_up(coords, size_bits.map(|bits| bits as u8), triangle, |is_by_rows, own| {
            match is_by_rows {
                true => Self::Rows(own),
                false => Self::Perspective(own),
            }
        })
    }

    /// The binary logarithm of the number of texels that a pixel covers along each axis, rounded down, in 2⁻¹⁶; 0 where it differs over
    /// the triangle.
    #[inline(never)] // code size
    pub(super) fn covered(&self, [w, h]: [u32; 2]) -> i32 {
        // Has the highest bit of both magnitudes, or of one unit less. Steps are less than half a side.
        let magnitudes = |a: u32, b: u32| {
            let of = |step: u32| step as i32 ^ (step as i32 >> 31);
            (of(a) | of(b)) as u32
        };
        match self {
            Self::Packed(words) => {
                let [right, down] = [words.step(), words.row_step()];
                // In 2⁻¹⁶ of a side: 15 bits, and at most 8 of the side.
                let (u, v) = (magnitudes(right, down) >> 16, magnitudes(right << 16, down << 16) >> 16);
                (15 - leading_zeros((u << (w & 15)) | (v << (h & 15)))) << 16
            }
            Self::Linear([u, v]) => {
                let of =
                    |bits: u32, u: &Gradient| bits as i32 - leading_zeros(magnitudes(u.step(), u.row_step()));
                (of(w, u).max(of(h, v)) - 1) << 16
            }
            Self::Rows(_) | Self::Perspective(_) => 0,
        }
    }
}
