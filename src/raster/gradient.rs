//! Attribute interpolation: a value that varies linearly over a triangle, stepped from pixel to pixel in 32 bits.

/// A value that is linear over a triangle, such as depth or a colour channel: its value at pixel (0, 0), and its change per
/// column and per row. It is evaluated at the centres of the pixels that the triangle covers. Values have 24 bits at the corners
/// and 32 bits at pixels, in units of 2⁻⁸ of the corners' unit. [`SpanShader`](crate::shading::SpanShader) has an example.
///
/// The value at a covered pixel lies between the values of the corners, so arithmetic modulo 2³² is enough: all sums wrap, and
/// no gradient is too steep.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gradient {
    /// The value at pixel (0, 0), in 2⁻⁸ of the corners' unit, wrapping, as are the steps.
    pub(crate) origin: u32,
    /// The change from a pixel to its right neighbour.
    pub(crate) right: u32,
    /// The change from a pixel to the pixel below.
    pub(crate) down: u32,
}

impl Gradient {
    /// The value at the centre of a covered pixel, column `x` and row `y`, in 2⁻⁸ of the corners' unit: between the
    /// corners' values, and within `(w + h)/2 + 34 + 2¹⁰·⁶` units of the exact value, w columns and h rows from the pixel of
    /// the first corner. At a pixel that the triangle does not cover the value may wrap.
    #[inline(always)]
    pub fn at(&self, x: i32, y: i32) -> u32 {
        self.origin
            .wrapping_add(self.right.wrapping_mul(x as u32))
            .wrapping_add(self.down.wrapping_mul(y as u32))
    }

    /// The change from a pixel to its right neighbour, in 2⁻⁸ of the corners' unit; add it wrapping.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.right
    }

    /// The change from a pixel to the pixel below, to be added wrapping.
    #[inline(always)]
    pub(crate) fn row_step(&self) -> u32 {
        self.down
    }

    /// Adds a constant, such as the half that turns truncation into rounding.
    #[inline(always)]
    pub(crate) fn add_bias(self, bias: u32) -> Self {
        Self { origin: self.origin.wrapping_add(bias), ..self }
    }
}
