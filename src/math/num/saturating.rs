//! Shifts and sums that saturate, in 64 bits: coordinates far from the origin stay finite.

use super::accumulator::Accumulator;

/// Translations stay within ±2⁶² (2³⁰ world units in 2⁻³²), so that two of them can be added.
pub(crate) const SATURATED: i64 = 1 << 62;

/// `a + b` for translations, saturating at ±2⁶².
#[inline(never)] // set-up: code size counts, speed does not
pub(crate) const fn add(a: i64, b: i64) -> i64 {
    match a.saturating_add(b) {
        sum if sum > SATURATED => SATURATED,
        sum if sum < -SATURATED => -SATURATED,
        sum => sum,
    }
}

/// `m · 2^exponent · t`, rounded to nearest, saturating at ±2⁶²; for |m| ≤ 2³⁰ and |t| ≤ 2⁶².
pub(crate) const fn mul_translation(m: i32, exponent: i32, t: i64) -> i64 {
    add(Accumulator::ZERO.plus(m, t).scaled(exponent), 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::num::scaled;
    use crate::math::random::mixed as random;

    #[test]
    fn translations_scale_rounded_and_saturated() {
        let mut state = 4;
        for _ in 0..200_000 {
            let m = (random(&mut state) as i32) >> 1;
            let t = (random(&mut state) as i64) >> (1 + random(&mut state) % 50);
            let exponent = (random(&mut state) % 134) as i32 - 100;
            let limit = i128::from(SATURATED);
            let want = scaled(i128::from(m) * i128::from(t), exponent).clamp(-limit, limit);
            assert_eq!(i128::from(mul_translation(m, exponent, t)), want, "{m} {exponent} {t}");
        }
    }
}
