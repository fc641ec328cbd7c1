//! Coefficients as quotients of exact integers.

use crate::math::num::{excess, fraction, scale, SATURATED};
use crate::math::{Row, Scalar};

/// `n / d` as `mantissa · 2^exponent` with a mantissa of 30 bits (or 2³⁰ itself), rounded to nearest:
/// within 2⁻³⁰ of itself. Wants `d > 0`.
pub(in crate::camera) fn ratio(n: i64, d: u64) -> (i64, i32) {
    let magnitude = n.unsigned_abs();
    if magnitude == 0 {
        return (0, 0);
    }
    // Both to 62 bits: 62-bit over 62-bit is between ½ and 2, as `fraction` wants it.
    let (up_n, up_d) = (-excess(magnitude, 61), -excess(d, 61));
    let shifted = |v: u64, up: i32| if up >= 0 { v << up } else { v >> -up };
    let q = fraction(shifted(magnitude, up_n), shifted(d, up_d), 31);
    // ½ … 2 in 2⁻³¹ is 2³⁰ … 2³²: rounded to 30 bits.
    let down = if q >> 31 == 0 { 1 } else { 2 };
    let q = scale(q as i64, -down);
    (if n < 0 { -q } else { q }, up_d - up_n - 31 + down)
}

/// `n / d` in 2⁻³², or `None` where it leaves ±2³⁰.
pub(super) fn offset(n: i64, d: u64) -> Option<i64> {
    let (mantissa, exponent) = ratio(n, d);
    let value = scale(mantissa, exponent + 32);
    (value.abs() < SATURATED).then_some(value)
}

/// One coefficient as a whole row.
pub(super) fn row(axis: usize, (mantissa, exponent): (i64, i32), offset: i64) -> Row {
    let mut linear = [0; 3];
    if let Some(coefficient) = linear.get_mut(axis) {
        *coefficient = mantissa;
    }
    Row::new(linear, exponent, offset)
}

/// `high − low` in 2⁻¹⁶ when positive.
pub(super) fn extent(low: Scalar, high: Scalar) -> Option<u64> {
    let extent = i64::from(high.to_bits()) - i64::from(low.to_bits()); // 33 bits
    (extent > 0).then_some(extent.unsigned_abs())
}

/// The factor 1.
pub(super) const ONE: (i64, i32) = (1 << 30, -30);

impl Row {
    /// `self · factor`.
    pub(super) fn times(&self, factor: (i64, i32)) -> Self {
        self.combined(factor, &Self::ZERO, (0, 0))
    }
}
