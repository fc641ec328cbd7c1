//! Texture coordinates over a triangle.

use super::linear::{is_linear, linear_gradients, packed_gradient, range};
use super::mapping::{FaceCoords, FRACTION};
use super::perspective::Perspective;
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
}
