//! A sum of products, wider than 64 bits.

use super::bits::{max, min};
use super::scaling::scale;

/// The exact sum of up to three products of a coefficient (at most 2³⁰ in absolute value) and a translation (at most 2⁶²), as
/// high·2³² + low.
#[derive(Clone, Copy)]
pub(crate) struct Accumulator {
    /// At most 3·2⁶⁰ in absolute value, and carries.
    high: i64,
    low: u32,
}

impl Accumulator {
    pub(crate) const ZERO: Self = Self { high: 0, low: 0 };

    #[inline(always)]
    pub(crate) const fn plus(self, m: i32, t: i64) -> Self {
        let m = m as i64;
        // t in two words: m·upper ≤ 2⁶⁰, m·lower < 2⁶².
        let low = self.low as i64 + m * (t as u32 as i64);
        Self { high: self.high + m * (t >> 32) + (low >> 32), low: low as u32 }
    }

    /// The sum times 2^exponent, rounded to nearest. Where the exact value is beyond ±(2⁶³ − 2³²), the result is not exact, but
    /// also beyond that bound.
    #[inline(always)]
    pub(crate) const fn scaled(self, exponent: i32) -> i64 {
        let (down, up) = (min(exponent, 0), max(exponent, 0));
        // Shifted right by more than 32, the high word alone gives the rounding bit; at 32 the low word gives it.
        scale(scale(self.high, 32 + down).saturating_add(scale(self.low as i64, down)), up)
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
            // Half of them cancel: m·x against m·x, but for the last bits.
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
