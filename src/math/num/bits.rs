//! Bit counts of numbers, and the shifts that follow from them.

use crate::math::cores::{CORTEX_M0, COUNTS_LEADING_ZEROS};
use crate::math::halfword::{
    leading_zeros_by_steps, normalised_by_bits, normalised_by_steps, significant_bits_by_steps,
};
use crate::math::hints::keep_rolled;

/// The number of zero bits above the highest one of `v`: 32 for 0.
#[inline(always)]
pub(crate) fn leading_zeros(v: u32) -> i32 {
    if CORTEX_M0 {
        return leading_zeros_by_steps(v);
    }
    v.leading_zeros() as i32
}

/// `v ≥ 1` shifted left to 2³⁰ … 2³¹ − 1, and the shift.
#[inline(always)]
pub(super) fn normalised(v: i32) -> (i32, u32) {
    if !COUNTS_LEADING_ZEROS {
        return normalised_by_steps(v);
    }
    let shift = v.leading_zeros().wrapping_sub(1) & 31; // v ≥ 1 has 1 … 31 leading zeros
    (v << shift, shift)
}

/// [`normalised`], fastest for numbers near 2³⁰.
#[inline(always)]
pub(super) fn normalised_near_2_30(v: i32) -> (i32, u32) {
    if !COUNTS_LEADING_ZEROS {
        return normalised_by_bits(v);
    }
    normalised(v)
}

/// The bitwise OR of the numbers' magnitudes: it has as many bits as the largest magnitude.
#[inline(never)] // set-up: code size counts
pub(crate) const fn bits_of(mut numbers: &[i64]) -> u64 {
    let mut bits = 0;
    while let Some((number, left)) = numbers.split_first() {
        keep_rolled();
        bits |= number.unsigned_abs();
        numbers = left;
    }
    bits
}

/// The bitwise OR of the coefficients' magnitudes: it has as many bits as the largest magnitude.
#[inline(never)] // set-up: code size counts
pub(crate) fn magnitude(linear: &[i32]) -> u32 {
    linear.iter().fold(0, |bits, m| {
        keep_rolled();
        bits | m.unsigned_abs()
    })
}

/// The right shift that brings the highest bit of `v` to bit `bits − 1`; negative for a left shift.
pub(crate) const fn shift_to_fit(v: u64, bits: i32) -> i32 {
    significant_bits(v) - bits
}

/// The number of bits of `v` up to its highest one: 0 for 0.
const fn significant_bits(v: u64) -> i32 {
    if CORTEX_M0 {
        return significant_bits_by_steps(v);
    }
    64 - v.leading_zeros() as i32
}

/// The larger of two numbers: `Ord::max` is not `const`.
pub(crate) const fn max(a: i32, b: i32) -> i32 {
    if a > b {
        a
    } else {
        b
    }
}

/// The smaller of two numbers.
pub(crate) const fn min(a: i32, b: i32) -> i32 {
    -max(-a, -b)
}
