//! The borders of the view in an object's coordinates, for culling of clusters.

use super::VertexTransform;
use crate::math::num::{bits_of, scale, shift_to_fit, sqrt_word};

/// The borders of the viewport and the near plane as linear forms, negative outside, of points whose largest justified coordinate
/// is 2¹⁵.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Borders([Border; 5]);

/// Of one plane: coefficients, a constant, and the length of the normal, rounded up.
#[derive(Clone, Copy, Debug)]
struct Border {
    linear: [i32; 3],
    constant: i32,
    length: i32,
}

impl Borders {
    /// Coefficients and the offset are at most 2^BITS in magnitude.
    const BITS: i32 = 13;

    /// The four numbers of a form are off by a half, which coordinates up to 2¹⁵ multiply, and 2¹⁵ for the offset.
    const MARGIN: i32 = 4 << 14;

    #[inline(never)] // set-up: code size counts
    pub(crate) fn new(transform: &VertexTransform) -> Self {
        Self(transform.borders().map(|form| {
            let down = shift_to_fit(bits_of(&form), Self::BITS);
            let [a, b, c, offset] = form.map(|v| scale(v, -down) as i32);
            let square = (a * a + b * b + c * c) as u32; // at most 3·2²⁶
            let length = sqrt_word(square) as i32 + 1;
            Border { linear: [a, b, c], constant: (offset << 15) + Self::MARGIN, length }
        }))
    }

    /// Whether a ball lies on the outer side of one of the planes: then no face that it contains covers a pixel. The centre and the radius (a
    /// `u16`) are the first four numbers of a cluster.
    #[inline(always)]
    pub(crate) fn exclude(&self, &[x, y, z, radius, ..]: &[i16; 8]) -> bool {
        let (x, y, z, radius) = (i32::from(x), i32::from(y), i32::from(z), i32::from(radius as u16));
        self.0.iter().any(|&Border { linear: [a, b, c], constant, length }| {
            // 4·2²⁸ + 2¹⁶, and less than 2³⁰ for the radius, as √3·2¹³·2¹⁶ is 0.87·2³⁰: below 2³¹.
            a * x + b * y + c * z + constant + length * radius < 0
        })
    }
}
