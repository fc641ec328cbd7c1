//! A linear form over a space: the stuff of matrices.

use super::num::{add, excess, mul_translation, row_times, scale};

/// `linear · p · 2^(exponent − 30) + offset`: 30-bit coefficients with one exponent, and a
/// constant in 2⁻³² that keeps what a coefficient's rounding would lose far from the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    /// Each at most 2³⁰ in absolute value.
    pub(crate) linear: [i32; 3],
    /// Of the block.
    pub(crate) exponent: i32,
    /// In 2⁻³², at most 2⁶² in absolute value.
    pub(crate) offset: i64,
}

/// Brings sums of products to 30 bits and one exponent: rounded to nearest, so each coefficient
/// is within 2⁻³¹ of the block's largest (2⁻³⁰ just below a power of two).
pub(crate) fn block<const N: usize>(sums: [[i64; 3]; N], exponent: i32) -> ([[i32; 3]; N], i32) {
    let largest = sums.iter().flatten().map(|c| c.unsigned_abs()).max().unwrap_or(0);
    if largest == 0 {
        return ([[0; 3]; N], 0);
    }
    let shift = excess(largest, 30);
    // 30 bits, or 2³⁰ itself when rounding carries.
    (sums.map(|row| row.map(|c| scale(c, -shift) as i32)), exponent + shift)
}

impl Row {
    pub(crate) const ZERO: Self = Self { linear: [0; 3], exponent: 0, offset: 0 };

    /// From coefficients `linear · 2^exponent`, each below 2⁶², and an offset in 2⁻³².
    pub(crate) fn new(linear: [i64; 3], exponent: i32, offset: i64) -> Self {
        let ([linear], exponent) = block([linear], exponent + 30);
        Self { linear, exponent, offset }
    }

    /// The form on a vector in 2⁻³²: in 2⁻³², saturating.
    pub(crate) fn apply(&self, p: [i64; 3]) -> i64 {
        self.linear
            .iter()
            .zip(p)
            .fold(self.offset, |sum, (&m, c)| add(sum, mul_translation(m, self.exponent - 30, c)))
    }

    /// This form over the coordinates that `rows` computes: their coefficients share an exponent.
    pub(crate) fn of(&self, linear: &[[i32; 3]; 3], exponent: i32, offset: [i64; 3]) -> Self {
        let sums = row_times(self.linear, linear);
        let ([linear], exponent) = block([sums], self.exponent + exponent - 30);
        Self { linear, exponent, offset: self.apply(offset) }
    }
}
