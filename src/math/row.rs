//! Rows of matrices: linear forms with an exponent (block floating point).

use super::hints::{keep_rolled, opaque_next};
use super::num::{
    add, bits_of, magnitude, max, mul_translation, row_times, scale, shift_to_fit, Accumulator,
};

/// `linear · p · 2^(exponent − 30) + offset`: 30-bit coefficients with one exponent, and a constant in 2⁻³². The constant has
/// its own precision, so that points far from the origin stay exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    /// Each at most 2³⁰ in absolute value.
    pub(crate) linear: [i32; 3],
    /// The exponent that the three coefficients share.
    pub(crate) exponent: i32,
    /// The constant in 2⁻³², at most 2⁶² in absolute value.
    pub(crate) offset: i64,
}

/// Scales sums of products to 30 bits with one exponent, which it returns. Rounded to nearest: each coefficient is within 2⁻³⁰
/// of the block's largest (2⁻³¹ just below a power of two).
#[inline(never)] // set-up: code size counts, speed does not; slices keep the loops rolled
pub(crate) const fn block_scaled(sums: &[i64], exponent: i32, linear: &mut [i32]) -> i32 {
    let bits = bits_of(sums);
    let shift = shift_to_fit(bits, 30);
    let mut i = 0;
    while i < sums.len() && i < linear.len() {
        keep_rolled();
        linear[i] = scale(sums[i], -shift) as i32; // 30 bits, or 2³⁰ itself when rounding carries
        i += 1;
    }
    match bits {
        0 => 0,
        _ => exponent + shift,
    }
}

/// Three rows whose coefficients share an exponent: an affine map to another space.
pub(crate) struct RowBlock {
    /// Each at most 2³⁰ in absolute value.
    pub(crate) linear: [[i32; 3]; 3],
    /// The exponent that all nine coefficients share.
    pub(crate) exponent: i32,
    /// The constants in 2⁻³², at most 2⁶² in absolute value.
    pub(crate) offset: [i64; 3],
}

/// Maps a point in 2⁻³² by three rows; the result is in 2⁻³² and saturates.
#[inline(never)] // set-up: code size counts, speed does not
pub(crate) fn transform_point(
    linear: &[[i32; 3]; 3],
    exponent: i32,
    p: &[i64; 3],
    offset: &[i64; 3],
) -> [i64; 3] {
    let ([x, y, z], [a, b, c]) = (linear, *offset);
    [evaluate(x, exponent, p, a), evaluate(y, exponent, p, b), evaluate(z, exponent, p, c)]
}

/// `linear · p · 2^(exponent − 30) + offset` for p and offset in 2⁻³²; the result is in 2⁻³² and saturates. The products
/// are summed exactly, because they may be far larger than their sum.
#[inline(never)] // set-up: code size counts, speed does not
pub(crate) fn evaluate(linear: &[i32; 3], exponent: i32, p: &[i64; 3], offset: i64) -> i64 {
    let (mut sum, mut i) = (Accumulator::ZERO, 0);
    while let (Some(m), Some(c)) = (linear.get(i), p.get(i)) {
        sum = sum.plus(*m, *c);
        i = opaque_next(i);
    }
    add(offset, sum.scaled(exponent - 30))
}

/// Homogeneous coordinates of a point in 2⁻³²: in units of 2^(shift − 32), and the shift, which is 0 where no coordinate can
/// exceed 2⁶¹. None saturates.
pub(crate) fn homogeneous<const N: usize>(rows: &[Row; N], p: &[i64; 3]) -> ([i64; N], i32) {
    let reach = shift_to_fit(bits_of(p), 0);
    let shift = rows.iter().fold(0, |shift, row| max(shift, row.overflow(reach)));
    (rows.map(|row| evaluate(&row.linear, row.exponent - shift, p, scale(row.offset, -shift))), shift)
}

impl Row {
    pub(crate) const ZERO: Self = Self { linear: [0; 3], exponent: 0, offset: 0 };

    /// From coefficients `linear · 2^exponent`, each below 2⁶², and an offset in 2⁻³².
    pub(crate) const fn new(linear: &[i64; 3], exponent: i32, offset: i64) -> Self {
        let mut row = Self { offset, ..Self::ZERO };
        row.exponent = block_scaled(linear, exponent + 30, &mut row.linear);
        row
    }

    /// By how many bits the form, or one of its terms, may exceed 2⁶¹ (half of the saturation limit) over vectors of up to
    /// `reach` bits.
    pub(crate) fn overflow(&self, reach: i32) -> i32 {
        let bits = magnitude(&self.linear);
        // Three products.
        let linear = if bits == 0 { 0 } else { shift_to_fit(bits.into(), 28) + self.exponent + reach };
        linear.max(shift_to_fit(self.offset.unsigned_abs(), 0)) - 60
    }

    /// Evaluates the form at a point in 2⁻³²; the result is in 2⁻³² and saturates.
    pub(crate) fn apply(&self, p: &[i64; 3]) -> i64 {
        evaluate(&self.linear, self.exponent, p, self.offset)
    }

    /// Composes this form, scaled by 2^−`shift`, with `inner`: a row of the matrix product.
    pub(crate) fn compose(&self, inner: &RowBlock, shift: i32, into: &mut Self) {
        let own = self.exponent - shift;
        into.offset = evaluate(&self.linear, own, &inner.offset, scale(self.offset, -shift));
        let sums = row_times(&self.linear, &inner.linear);
        into.exponent = block_scaled(&sums, own + inner.exponent - 30, &mut into.linear);
    }

    /// `self · a + other · b` for factors of 30 bits and an exponent each.
    pub(crate) fn linear_combination(&self, a: (i64, i32), other: &Self, b: (i64, i32)) -> Self {
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
        Self::new(&[sum(0), sum(1), sum(2)], exponent, add(offset(self, a), offset(other, b)))
    }
}
