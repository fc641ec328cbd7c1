//! Rows of matrices: linear forms with an exponent (block floating point).

use super::hints::keep_rolled;
use super::num::{
    add, bits_of, evaluate, magnitude, max, mul_translation, row_times, scale, scale_to_word, shift_to_fit,
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

/// Scales sums of products, each below 2⁶², to 30 bits with one exponent, which it returns. Rounded to nearest: each coefficient is within 2⁻³⁰
/// of the block's largest (2⁻³¹ just below a power of two).
#[inline(never)] // set-up: code size counts; slices keep the loops rolled
pub(crate) const fn block_scaled(sums: &[i64], exponent: i32, linear: &mut [i32]) -> i32 {
    let bits = bits_of(sums);
    let shift = shift_to_fit(bits, 30); // −30 … 32
    let mut i = 0;
    while i < sums.len() && i < linear.len() {
        keep_rolled();
        linear[i] = scale_to_word(sums[i], shift); // 30 bits, or 2³⁰ itself when rounding carries
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
#[inline(never)] // set-up: code size counts
pub(crate) fn transform_point(
    linear: &[[i32; 3]; 3],
    exponent: i32,
    p: &[i64; 3],
    offset: &[i64; 3],
) -> [i64; 3] {
    let ([x, y, z], [a, b, c]) = (linear, *offset);
    [evaluate(x, exponent, p, a), evaluate(y, exponent, p, b), evaluate(z, exponent, p, c)]
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
        let mut words = [0; 3];
        let exponent = block_scaled(linear, exponent + 30, &mut words);
        Self { linear: words, exponent, offset }
    }

    /// By how many bits the form, or one of its terms, may exceed 2⁶¹ (half of the saturation limit) over vectors of up to
    /// `reach` bits; 0 if by none.
    #[inline(always)]
    pub(crate) fn overflow(&self, reach: i32) -> i32 {
        // In the common case the magnitude makes no difference: coefficients have at most 31 bits, 3 more than 28.
        let common = self.exponent + reach <= 60 - 3;
        self.overflow_of(if common { 0 } else { magnitude(&self.linear) }, reach)
    }

    /// [`overflow`](Self::overflow), given the magnitude of the coefficients.
    #[inline(always)]
    fn overflow_of(&self, bits: u32, reach: i32) -> i32 {
        // Three products of `bits` and `reach` bits in 2^(exponent − 30) sum to at most bits + reach + exponent − 28 bits.
        let linear = if bits == 0 { 0 } else { shift_to_fit(bits.into(), 28) + self.exponent + reach };
        (linear.max(shift_to_fit(self.offset.unsigned_abs(), 0)) - 60).max(0)
    }

    /// Evaluates the form at a point in 2⁻³²; the result is in 2⁻³² and saturates.
    pub(crate) fn apply(&self, p: &[i64; 3]) -> i64 {
        evaluate(&self.linear, self.exponent, p, self.offset)
    }

    /// Composes this form, scaled by 2^−`shift`, with `inner`: a row of the matrix product.
    pub(crate) fn compose(&self, inner: &RowBlock, shift: i32, into: &mut Self) {
        let own = self.exponent - shift;
        // `shift` is 0 unless numbers are large: thin volumes, narrow windows, distant objects.
        let offset = if shift == 0 { self.offset } else { scale(self.offset, -shift) };
        into.offset = evaluate(&self.linear, own, &inner.offset, offset);
        let sums = row_times(&self.linear, &inner.linear);
        into.exponent = block_scaled(&sums, own + inner.exponent - 30, &mut into.linear);
    }

    /// `self · factor`, of 30 bits and an exponent.
    pub(crate) fn times(&self, (m, e): (i64, i32)) -> Self {
        let sums = self.linear.map(|c| i64::from(c) * m); // at most 2⁶⁰
        let offset = mul_translation(m as i32, e, self.offset); // |m| ≤ 2³⁰
        Self::new(&sums, self.exponent - 30 + e, offset)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed as random;

    /// A multiple of a row is its combination with a zero row.
    #[test]
    fn a_multiple_is_a_combination_with_nothing() {
        let mut state = 5;
        let mut next = |bits: u32| (random(&mut state) as i64) >> (64 - bits);
        for case in 0..10_000 {
            let linear = if case % 10 == 0 { [0; 3] } else { [0; 3].map(|_| next(31) as i32) };
            let row = Row { linear, exponent: next(6) as i32, offset: next(62) };
            let factor = if case % 7 == 0 { (0, 0) } else { (next(31), next(6) as i32 - 30) };
            assert_eq!(
                row.times(factor),
                row.linear_combination(factor, &Row::ZERO, (0, 0)),
                "{row:?} {factor:?}"
            );
        }
    }

    #[test]
    fn a_row_that_does_not_overflow_is_known_without_its_magnitude() {
        let (mut state, mut common) = (8, 0);
        for _ in 0..200_000 {
            let linear = [0; 3].map(|_| {
                [1 << 30, -(1 << 30), 0, random(&mut state) as i32 >> 2][random(&mut state) as usize % 4]
            });
            let offset = match random(&mut state) % 2 {
                0 => random(&mut state) as i64 >> (1 + random(&mut state) % 40),
                _ => {
                    ((1i64 << (57 + random(&mut state) % 5)) + random(&mut state) as i64 % 3)
                        * [1, -1][random(&mut state) as usize % 2]
                }
            };
            let row = Row { linear, exponent: (random(&mut state) % 61) as i32 - 30, offset };
            let reach = (random(&mut state) % 64) as i32;
            assert_eq!(row.overflow(reach), row.overflow_of(magnitude(&linear), reach), "{row:?} {reach}");
            common += usize::from(row.overflow(reach) == 0);
        }
        assert!((20_000..180_000).contains(&common), "{common}");
    }
}
