//! Matrix coefficients as quotients of exact integers.

use crate::math::num::{fraction, scale, shift_to_fit, SATURATED};
use crate::math::{Row, Scalar};

/// `n / d` as `mantissa · 2^exponent` with a mantissa of 30 bits (or 2³⁰ itself), rounded to nearest: relative error 2⁻³⁰.
/// Requires `0 < d < 2⁶³`.
#[inline(never)] // set-up: code size counts
pub(in crate::camera) const fn ratio(n: i64, d: u64) -> (i64, i32) {
    if n == 0 {
        return (0, 0);
    }
    // Both scaled to 61 bits, so that the quotient is between ½ and 2, as `fraction` requires.
    let (up_n, up_d) = (-shift_to_fit(n.unsigned_abs(), 61), -shift_to_fit(d, 61));
    let q = fraction(scale(n, up_n).unsigned_abs(), scale(d as i64, up_d) as u64, 31);
    // ½ … 2 in 2⁻³¹ is 2³⁰ … 2³²: rounded to 30 bits.
    let down = if q >> 31 == 0 { 1 } else { 2 };
    let q = scale(q as i64, -down);
    (if n < 0 { -q } else { q }, up_d - up_n - 31 + down)
}

/// `n / d` in 2⁻³²; `None` if it is beyond ±2³⁰.
#[inline(never)] // set-up: code size counts
pub(super) const fn offset(n: i64, d: u64) -> Option<i64> {
    let (mantissa, exponent) = ratio(n, d);
    let value = scale(mantissa, exponent + 32);
    match value.unsigned_abs() < SATURATED as u64 {
        true => Some(value),
        false => None,
    }
}

/// A row with a coefficient for one axis, x, y or z, and a constant; the other coefficients are 0.
#[inline(never)] // set-up: code size counts
pub(super) const fn row(axis: usize, (mantissa, exponent): (i64, i32), offset: i64) -> Row {
    let linear = match axis {
        0 => [mantissa, 0, 0],
        1 => [0, mantissa, 0],
        _ => [0, 0, mantissa],
    };
    Row::new(&linear, exponent, offset)
}

/// `high − low` in 2⁻¹⁶; `None` if it is not positive.
pub(super) const fn extent(low: Scalar, high: Scalar) -> Option<u64> {
    let extent = high.to_bits() as i64 - low.to_bits() as i64; // 33 bits
    match extent > 0 {
        true => Some(extent as u64),
        false => None,
    }
}

/// The factor 1.
pub(super) const ONE: (i64, i32) = (1 << 30, -30);
