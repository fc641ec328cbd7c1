//! Divisions: no library call, no panic.

use super::bits::{leading_zeros, max, shift_to_fit};
use super::product::mul_wide;
use super::reciprocal::{reciprocal, reciprocal_of_normalised};
use crate::math::cores::CORTEX_M0;
use crate::math::hints::keep_rolled;

/// `⌊n · 2^bits / d⌋` by long division: no library call, no panic. Requires `n < 2·d`, `0 < d < 2⁶²`
/// and `bits ≤ 62`; a zero divisor gives all ones.
#[inline(never)] // set-up: code size counts
pub(crate) const fn fraction(n: u64, d: u64, bits: u32) -> u64 {
    let (mut rest, mut quotient, mut left) = (n, 0, bits + 1);
    while left != 0 {
        keep_rolled();
        let (less, smaller) = rest.overflowing_sub(d);
        if !smaller {
            rest = less;
        }
        quotient = quotient << 1 | !smaller as u64;
        rest <<= 1; // rest < d < 2⁶²
        left -= 1;
    }
    quotient
}

/// `⌊n · 2³¹ / d⌋` for `n < d`, by a reciprocal and a few corrections: without a loop over the quotient's bits.
#[inline(never)] // rare path: code size counts
pub(crate) fn proper_fraction(n: u32, d: u32) -> i32 {
    // The upper 31 bits: the reciprocal's argument is 2³⁰ … 2³¹ − 1.
    let zeros = leading_zeros(d) & 31;
    let upper = |v: u32| (v << zeros >> 1) as i32;
    let r = reciprocal_of_normalised((upper(d), 0));
    // `r` is 2⁶¹ over those bits within 2⁻²⁹ of itself, which is 4 units of the quotient; the bits dropped from n and d are 2 each,
    // and the shift is 1. So the quotient is off by at most 7.
    // Below 2³¹ + 7: may wrap, and is corrected.
    let mut quotient = (mul_wide(upper(n), r.mantissa) >> 30) as i32;
    // Both products are below 2⁶³ + 2³⁶; |rest| < 8·2³².
    let mut rest = (u64::from(n) << 31).wrapping_sub(u64::from(d) * u64::from(quotient as u32)) as i64;
    while rest < 0 {
        keep_rolled();
        (rest, quotient) = (rest + i64::from(d), quotient.wrapping_sub(1));
    }
    while rest >= i64::from(d) {
        keep_rolled();
        (rest, quotient) = (rest - i64::from(d), quotient.wrapping_add(1));
    }
    quotient
}

/// `⌊n / d⌋` and the remainder for `n < 2⁶²`, `0 < d < 2³¹`, by long division.
#[inline(never)] // set-up: code size counts
pub(crate) const fn divide(n: u64, d: u32) -> (u64, u32) {
    // How many bits longer `n` is than `d`: `n` is less than twice `d << bits`, as `fraction` requires.
    let bits = max(shift_to_fit(n, 0) - shift_to_fit(d as u64, 0), 0) as u32;
    let quotient = fraction(n, (d as u64) << bits, bits);
    (quotient, (n as u32).wrapping_sub((quotient as u32).wrapping_mul(d))) // below d: 31 bits tell
}

/// [`divide`] for 32 bits, by one instruction where one divides; d is not 0.
#[inline(always)]
pub(crate) fn divide_word(n: u32, d: u32) -> (u32, u32) {
    if CORTEX_M0 {
        let (quotient, remainder) = divide(n.into(), d);
        return (quotient as u32, remainder);
    }
    let d = d.max(1); // so that the compiler knows that it divides
    (n / d, n % d)
}

/// `⌊n / d⌋` and the remainder 0 … d − 1, for 0 < d ≤ 2²².
#[inline(always)]
pub(crate) fn divide_floor(n: i32, d: i32) -> (i32, i32) {
    if CORTEX_M0 {
        return divide_by_reciprocal(n, d);
    }
    let d = d.max(1); // so that the compiler knows that it divides
    let (quotient, remainder) = (n / d, n % d);
    match remainder < 0 {
        true => (quotient - 1, remainder + d),
        false => (quotient, remainder),
    }
}

/// [`divide_floor`] by a reciprocal: where no instruction divides.
///
/// The reciprocal has a relative error of 2⁻²⁹ and n has 31 bits, so the quotient is off by at most 4 before it is rounded
/// down, and the remainder before its correction lies within ±6·d.
#[inline(never)]
fn divide_by_reciprocal(n: i32, d: i32) -> (i32, i32) {
    let r = reciprocal(d); // 1/d = mantissa · 2^(shift − 61), shift of 8 … 30
    let quotient = (mul_wide(n, r.mantissa) >> ((61 - r.shift) & 63)) as i32;
    let (correction, remainder) = divide_by_subtraction(n.wrapping_sub(quotient.wrapping_mul(d)), d);
    (quotient.wrapping_add(correction), remainder)
}

/// The quotient ⌊n / d⌋ and the remainder, by repeated subtraction. For small quotients: it takes one step per unit of the
/// quotient.
#[inline(always)]
pub(crate) fn divide_by_subtraction(n: i32, d: i32) -> (i32, i32) {
    let (mut quotient, mut remainder) = (0, n);
    while remainder < 0 {
        keep_rolled();
        (quotient, remainder) = (quotient - 1, remainder.wrapping_add(d));
    }
    while remainder >= d {
        keep_rolled();
        (quotient, remainder) = (quotient + 1, remainder.wrapping_sub(d));
    }
    (quotient, remainder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed as random;

    #[test]
    fn long_division_is_division() {
        let mut state = 3;
        for k in 0..62 {
            for _ in 0..200 {
                let n = random(&mut state) >> 2 >> k;
                let d = (random(&mut state) >> 33 >> (k / 2)).max(1) as u32;
                assert_eq!(divide(n, d), (n / u64::from(d), (n % u64::from(d)) as u32));
                let d = (random(&mut state) >> 3).max(2);
                let n = n % (2 * d);
                assert_eq!(u128::from(fraction(n, d, 40)), (u128::from(n) << 40) / u128::from(d));
                let d = (d as u32 >> (k / 2)).max(1);
                for n in [n as u32 % d, d - 1, d / 2, 0] {
                    let exact = (u64::from(n) << 31) / u64::from(d);
                    assert_eq!(proper_fraction(n, d) as u64, exact, "{n} / {d}");
                }
            }
        }
    }

    #[test]
    fn floors_are_exact() {
        let mut state = 13;
        for i in 0..200_000 {
            let n = random(&mut state) as i32 >> (i % 31);
            let d = ((random(&mut state) >> 42) as i32 >> (i / 31 % 22)) + 1;
            let exact = (n.div_euclid(d), n.rem_euclid(d));
            assert_eq!([divide_floor(n, d), divide_by_reciprocal(n, d)], [exact; 2], "{n} / {d}");
            if n.abs() < 40 * d {
                assert_eq!(divide_by_subtraction(n, d), exact, "{n} / {d}");
            }
        }
    }
}
