//! Shifts and sums that saturate, in 64 bits: coordinates far from the origin stay finite.

use super::accumulator::Accumulator;
use crate::math::cores::CORTEX_M0;
use crate::math::hints::opaque_next;

/// Translations stay within ±2⁶² (2³⁰ world units in 2⁻³²), so that two of them can be added.
pub(crate) const SATURATED: i64 = 1 << 62;

/// `a + b` for a translation b, |b| ≤ 2⁶², saturating at ±2⁶².
#[inline(never)] // set-up: code size counts
pub(crate) const fn add(a: i64, b: i64) -> i64 {
    let sum = a.wrapping_add(b);
    // −2⁶² … 2⁶² − 1: the two highest bits are equal. A sum that wraps has passed at least ±2⁶³ and at most ±(2⁶³ + 2⁶²).
    let high = (sum >> 32) as i32;
    if high ^ (high << 1) >= 0 {
        sum
    } else if a < 0 {
        -SATURATED // |b| ≤ 2⁶²: the sum has the sign of a
    } else {
        SATURATED
    }
}

/// `m · 2^exponent · t`, rounded to nearest, saturating at ±2⁶²; for |m| ≤ 2³⁰ and |t| ≤ 2⁶².
#[inline(never)] // set-up: code size counts
pub(crate) const fn mul_translation(m: i32, exponent: i32, t: i64) -> i64 {
    evaluate(&[m, 0, 0], exponent + 30, &[t, 0, 0], 0)
}

/// `linear · p · 2^(exponent − 30) + offset` for p and offset in 2⁻³²; the result is in 2⁻³² and saturates at ±2⁶². The products
/// are summed exactly, because they may be far larger than their sum.
#[inline(never)] // set-up: code size counts
pub(crate) const fn evaluate(linear: &[i32; 3], exponent: i32, p: &[i64; 3], offset: i64) -> i64 {
    let (mut sum, mut i) = (Accumulator::ZERO, 0);
    while i < 3 {
        sum = sum.plus(linear[i], p[i]);
        // On a Cortex-M0 the products are calls, which a rolled loop has once.
        i = if CORTEX_M0 { opaque_next(i) } else { i + 1 };
    }
    add(sum.scaled(exponent - 30), offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::num::scaled;
    use crate::math::random::mixed as random;

    #[test]
    fn sums_saturate() {
        let limit = i128::from(SATURATED);
        let edges = [i64::MIN, i64::MIN + 1, -SATURATED, -1, 0, 1, SATURATED, i64::MAX - 1, i64::MAX];
        let all = || {
            let near = edges.iter().flat_map(|&edge| [-1, 0, 1].map(|d| edge.saturating_add(d)));
            let mut state = 6;
            near.chain((0..500).map(move |_| random(&mut state) as i64))
        };
        for a in all() {
            for b in all().map(|b| b.clamp(-SATURATED, SATURATED)) {
                let want = (i128::from(a) + i128::from(b)).clamp(-limit, limit);
                assert_eq!(i128::from(add(a, b)), want, "{a} {b}");
            }
        }
    }

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
