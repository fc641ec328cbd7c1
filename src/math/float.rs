//! Conversion of f64 matrices, for hosts: exact for all numbers that the integers can represent.

use super::num::{add, scale};
use super::row::Row;

/// The mantissa and exponent of a finite float, `mantissa · 2^exponent`: exact, at most 53 bits; `None` for NaN and infinities.
pub(crate) fn mantissa_and_exponent(v: f64) -> Option<(i64, i32)> {
    if !v.is_finite() {
        return None;
    }
    let bits = v.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    // Subnormal numbers lack the leading one and share the exponent of field 1.
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    Some((if v < 0.0 { -mantissa } else { mantissa }, exponent))
}

/// Converts numbers to 61-bit integers with one exponent, which the largest number determines; `None` if one is not finite.
pub(crate) fn common_exponent<const N: usize>(numbers: [f64; N]) -> Option<([i64; N], i32)> {
    let mut all = [(0, 0); N];
    for (out, v) in all.iter_mut().zip(numbers) {
        *out = mantissa_and_exponent(v)?;
    }
    let exponent = all.iter().filter(|(m, _)| *m != 0).map(|&(_, e)| e).max().unwrap_or(0);
    // 53 bits shifted left by at most 8 make 61: the common exponent is the largest number's, less 8.
    Some((all.map(|(m, e)| scale(m, (e - exponent + 8).max(-63))), exponent - 8))
}

/// The nearest integer to `v · 2^fraction`, saturated at ±2⁶²; `None` if v is not finite.
pub(crate) fn to_fixed(v: f64, fraction: i32) -> Option<i64> {
    let (m, e) = mantissa_and_exponent(v)?;
    Some(add(scale(m, (e + fraction).clamp(-63, 63)), 0))
}

/// A row from its four coefficients, scaled by 2^`shift`; `None` if one is not finite.
pub(crate) fn row_from_f64([x, y, z, constant]: &[f64; 4], shift: i32) -> Option<Row> {
    let (linear, exponent) = common_exponent([*x, *y, *z])?;
    Some(Row::new(&linear, exponent + shift, to_fixed(*constant, 32 + shift)?))
}

/// `m · 2^exponent`: exact for 53 bits, beyond them rounded to nearest; 0 or ±∞ outside f64's
/// range.
pub(crate) fn ldexp(m: i64, exponent: i32) -> f64 {
    // Multiplied by powers of two of at most 2^±1000, which f64 represents exactly.
    let (mut value, mut rest) = (m as f64, exponent.clamp(-3000, 3000));
    while rest != 0 {
        let step = rest.clamp(-1000, 1000);
        value *= f64::from_bits(((1023 + step) as u64) << 52);
        rest -= step;
    }
    value
}

/// The row's four coefficients, scaled by 2^`shift`.
pub(crate) fn coefficients(row: &Row, shift: i32) -> [f64; 4] {
    let [x, y, z] = row.linear.map(|m| ldexp(m.into(), row.exponent - 30 + shift));
    [x, y, z, ldexp(row.offset, shift - 32)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mantissa_and_exponent_restore_every_float() {
        for v in [0.0, 1.0, -1.5, 1e-310, f64::MIN_POSITIVE, f64::MAX, -3.25e-200, 12_345.678] {
            let (m, e) = mantissa_and_exponent(v).unwrap();
            assert_eq!(ldexp(m, e), v);
        }
        assert_eq!(mantissa_and_exponent(f64::NAN), None);
        assert_eq!(mantissa_and_exponent(f64::INFINITY), None);
        assert_eq!(ldexp(1, 4000), f64::INFINITY);
        assert_eq!(ldexp(1, -4000), 0.0);
    }

    #[test]
    fn numbers_of_similar_size_get_a_common_exponent_exactly() {
        let numbers = [1.0, -0.1, 1e-3, 0.0];
        let (m, e) = common_exponent(numbers).unwrap();
        assert_eq!(m.map(|m| ldexp(m, e))[..2], numbers[..2]);
        // 53 bits shifted right by ten lose two.
        assert!((ldexp(m[2], e) - 1e-3).abs() <= ldexp(1, e));
        assert!(m.iter().all(|m| m.unsigned_abs() < 1 << 61));
    }
}
