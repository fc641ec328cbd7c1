//! A sum of products, wider than 64 bits.

use super::bits::min;
use super::product::mul_called;
use super::scaling::scale;
use crate::math::cores::CORTEX_M0;

/// The exact sum of up to three products of a coefficient (at most 2³⁰ in absolute value) and a translation (at most 2⁶²), as
/// high·2³² + low.
#[derive(Clone, Copy)]
pub(crate) struct Accumulator {
    /// At most 3·(2⁶⁰ + 2³⁰) in absolute value.
    high: i64,
    /// At most 3·2⁶¹ in absolute value.
    low: i64,
}

impl Accumulator {
    pub(crate) const ZERO: Self = Self { high: 0, low: 0 };

    #[inline(always)]
    pub(crate) const fn plus(self, m: i32, t: i64) -> Self {
        if CORTEX_M0 && m == 0 {
            return self; // a product is a call
        }
        // t in two signed words: |upper| ≤ 2³⁰ + 1, |lower| ≤ 2³¹.
        let lower = t as i32;
        let upper = (t >> 32) as i32 + (lower as u32 >> 31) as i32;
        Self { high: self.high + mul_called(m, upper), low: self.low + mul_called(m, lower) }
    }

    /// The sum with the carry of `low` moved to `high`. Called after each product, it makes room for coefficients of 32 bits.
    #[inline(always)]
    pub(crate) const fn carried(self) -> Self {
        Self { high: self.high + (self.low >> 32), low: self.low & 0xffff_ffff }
    }

    /// The sum times 2^exponent, rounded to nearest. Where the exact value is beyond ±(2⁶³ − 2³²), the result is not exact, but
    /// also beyond that bound.
    #[inline(always)]
    pub(crate) const fn scaled(self, exponent: i32) -> i64 {
        let (high, low) = (self.high + (self.low >> 32), self.low as u32);
        let down = min(exponent, 0);
        // Shifted right by more than 32, the high word alone gives the rounding bit; at 32 the low word gives it.
        let low = match down {
            0 => low,
            _ => {
                let floor = low.unbounded_shr((-1 - down) as u32); // of twice the low word
                floor - (floor >> 1) // half of it, rounded up
            }
        };
        let sum = scale(high, 32 + down).saturating_add(low as i64);
        if exponent > 0 {
            scale(sum, exponent)
        } else {
            sum
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::num::scaled;
    use crate::math::random::mixed as random;

    #[test]
    fn products_that_cancel_each_other_are_summed_exactly() {
        let mut state = 5;
        for _ in 0..200_000 {
            let m = [0; 3].map(|_| (random(&mut state) as i32) >> 1);
            let [x, y, z] = [0; 3].map(|_| (random(&mut state) as i64) >> (1 + random(&mut state) % 20));
            // In half of the cases the first two products cancel, but for the last bits.
            let (m, y) = match random(&mut state) % 2 {
                0 => ([m[0], -m[0], m[2]], (x ^ y & 0xff)),
                _ => (m, y),
            };
            let exponent = (random(&mut state) % 80) as i32 - 60;
            let t = [x, y, z];
            let sum = (0..3).fold(Accumulator::ZERO, |sum, i| sum.plus(m[i], t[i]));
            let exact = (0..3).map(|i| i128::from(m[i]) * i128::from(t[i])).sum();
            let limit = (1 << 63) - (1 << 32);
            let (got, want) = (i128::from(sum.scaled(exponent)), scaled(exact, exponent));
            assert_eq!(got.clamp(-limit, limit), want.clamp(-limit, limit), "{m:?} {exponent} {t:?}");
        }
    }
}
