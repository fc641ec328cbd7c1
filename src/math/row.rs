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
/// is within 2⁻³⁰ of the block's largest (2⁻³¹ just below a power of two).
#[inline(never)] // set-up: small is better
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

    /// By how many bits the form, or a part of it, may pass 2⁶¹ (half of what saturates) over vectors
    /// of up to `reach` bits.
    pub(crate) fn overflow(&self, reach: i32) -> i32 {
        let bits = |v: u64| 64 - v.leading_zeros() as i32;
        let largest = self.linear.iter().map(|c| u64::from(c.unsigned_abs())).max().unwrap_or(0);
        // Three products.
        let linear = if largest == 0 { 0 } else { bits(largest) + self.exponent - 30 + reach + 2 };
        linear.max(bits(self.offset.unsigned_abs())) + 1 - 61
    }

    /// All of it times 2^−`shift`.
    pub(crate) fn shifted(&self, shift: i32) -> Self {
        Self { linear: self.linear, exponent: self.exponent - shift, offset: scale(self.offset, -shift) }
    }

    /// The form on a vector in 2⁻³²: in 2⁻³², saturating.
    #[inline(never)] // set-up: small is better
    pub(crate) fn apply(&self, p: [i64; 3]) -> i64 {
        self.linear
            .iter()
            .zip(p)
            .fold(self.offset, |sum, (&m, c)| add(sum, mul_translation(m, self.exponent - 30, c)))
    }

    /// This form over the coordinates that `rows` computes: their coefficients share an exponent.
    #[inline(never)] // set-up: small is better
    pub(crate) fn of(&self, linear: &[[i32; 3]; 3], exponent: i32, offset: [i64; 3]) -> Self {
        let sums = row_times(self.linear, linear);
        let ([linear], exponent) = block([sums], self.exponent + exponent - 30);
        Self { linear, exponent, offset: self.apply(offset) }
    }

    /// `self · a + other · b` for factors of 30 bits and an exponent each.
    pub(crate) fn combined(&self, a: (i64, i32), other: &Self, b: (i64, i32)) -> Self {
        // Products of at most 2⁶⁰; the one with the smaller exponent is brought to the other's.
        let part =
            |row: &Self, (m, e): (i64, i32)| (row.linear.map(|c| i64::from(c) * m), row.exponent - 30 + e);
        let ((a_sums, a_exponent), (b_sums, b_exponent)) = (part(self, a), part(other, b));
        let blank = |sums: &[i64; 3]| *sums == [0; 3];
        let exponent = match (blank(&a_sums), blank(&b_sums)) {
            (true, _) => b_exponent,
            (_, true) => a_exponent,
            _ => a_exponent.max(b_exponent),
        };
        let at = |sums: [i64; 3], own: i32| sums.map(|c| scale(c, own - exponent));
        let (a_sums, b_sums) = (at(a_sums, a_exponent), at(b_sums, b_exponent));
        let sum = |i: usize| a_sums[i] + b_sums[i];
        let offset = |row: &Self, (m, e): (i64, i32)| mul_translation(m as i32, e, row.offset); // |m| ≤ 2³⁰
        Self::new([sum(0), sum(1), sum(2)], exponent, add(offset(self, a), offset(other, b)))
    }
}
