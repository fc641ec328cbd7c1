//! Twins for cores whose multiplier keeps 32 bits of a product, or that do not count leading zeros: Cortex-M0 and RV32IMC.
//!
//! [`cores`](super::cores) chooses between each twin and its plain function. Both are exact, so every core computes the same
//! bits; the tests below compare them on the host.

use super::form::{dot_product, truncated};
use super::hints::{keep_rolled, opaque_next};

/// `a · b`, exact, from four 16-bit products. Twin: [`mul_wide`](super::num::mul_wide), the compiler's 64-bit product.
#[inline]
pub(super) const fn mul_wide_by_halves(a: i32, b: i32) -> i64 {
    let (ah, al) = (a >> 16, a & 0xffff);
    let (bh, bl) = (b >> 16, b & 0xffff);
    // al·bl < 2³²; the cross products lie in ±2³¹ and their high halves are added apart, so that
    // no sum leaves 32 bits: |ah·bh| ≤ 2³⁰, the two carried halves and the carry are < 2¹⁷.
    let low = (al as u32).wrapping_mul(bl as u32);
    let cross1 = ah.wrapping_mul(bl);
    let cross2 = al.wrapping_mul(bh);
    let middle = (low >> 16) + (cross1 as u32 & 0xffff) + (cross2 as u32 & 0xffff);
    let high = ah * bh + (cross1 >> 16) + (cross2 >> 16) + (middle >> 16) as i32;
    ((high as i64) << 32) | ((middle << 16) | (low & 0xffff)) as i64
}

/// [`mul_wide_by_halves`], called. A 64-bit product in the library's function takes 37 instructions, this takes 24.
#[inline(never)] // set-up: code size counts
pub(super) const fn called_mul_wide(a: i32, b: i32) -> i64 {
    mul_wide_by_halves(a, b)
}

/// Row `v` times matrix `m`, of which many coefficients are 0: these cost no product. Twin:
/// [`row_times`](super::num::row_times).
#[inline(never)] // set-up: code size counts
pub(super) const fn row_times_by_halves(v: &[i32; 3], m: &[[i32; 3]; 3]) -> [i64; 3] {
    let (mut sums, mut i) = ([0; 3], 0);
    while i < 3 {
        let (factor, row, mut j) = (v[i], &m[i], 0);
        while j < 3 && factor != 0 {
            if row[j] != 0 {
                sums[j] += called_mul_wide(factor, row[j]);
            }
            j = opaque_next(j);
        }
        i = opaque_next(i);
    }
    sums
}

/// The number of bits of `v` up to its highest one: 0 for 0. Twin: [`shift_to_fit`](super::num::shift_to_fit) to 0 bits.
#[inline(never)] // set-up: code size counts
pub(super) const fn significant_bits_by_steps(v: u64) -> i32 {
    let (mut word, mut bits) = match (v >> 32) as u32 {
        0 => (v as u32, 0),
        high => (high, 32),
    };
    if word >> 16 != 0 {
        (word, bits) = (word >> 16, bits + 16);
    }
    if word >> 8 != 0 {
        (word, bits) = (word >> 8, bits + 8);
    }
    if word >> 4 != 0 {
        (word, bits) = (word >> 4, bits + 4);
    }
    while word != 0 {
        keep_rolled();
        (word, bits) = (word >> 1, bits + 1);
    }
    bits
}

/// The count of leading zeros, where no instruction counts them and the compiler would call a library function.
/// Twin: [`leading_zeros`](super::num::leading_zeros).
#[inline(always)]
pub(super) fn leading_zeros_by_steps(v: u32) -> i32 {
    if v == 0 {
        return 32;
    }
    let (mut v, mut zeros) = (v, 0);
    for bits in [16, 8, 4] {
        if v >> (32 - bits) == 0 {
            keep_rolled();
            (v, zeros) = (v << bits, zeros + bits);
        }
    }
    while v >> 31 == 0 {
        keep_rolled();
        (v, zeros) = (v << 1, zeros + 1);
    }
    zeros
}

/// `v ≥ 1` shifted left to 2³⁰ … 2³¹ − 1, and the shift: by bytes, then by bits.
#[inline(always)]
pub(super) fn normalised_by_steps(mut v: i32) -> (i32, u32) {
    let mut shift = 0;
    while v < 1 << 23 {
        keep_rolled();
        (v, shift) = (v << 8, shift + 8);
    }
    // Doubled, so that the loop ends when the sign bit is set.
    let mut twice = v << 1;
    while twice >= 0 {
        keep_rolled();
        (twice, shift) = (twice << 1, shift + 1);
    }
    ((twice as u32 >> 1) as i32, shift)
}

/// [`normalised_by_steps`], fastest for numbers near 2³⁰: one bit at a time.
#[inline(always)]
pub(super) fn normalised_by_bits(mut v: i32) -> (i32, u32) {
    let mut shift = 0;
    while v < 1 << 30 {
        keep_rolled();
        (v, shift) = (v << 1, shift + 1);
    }
    (v, shift)
}

/// A linear form for 16-bit coordinates on a Cortex-M0, whose products have 32 bits, and on RV32, where a 64-bit sum takes four
/// instructions. Twin: [`WideForm`](super::form::WideForm).
///
/// Coefficients are split as `high·2¹⁵ + low`, both signed 16-bit, so that each product and the sum of the three low products
/// fit 32 bits. Nothing is dropped before the one rounding, so the result has the bits of the wide form.
#[allow(dead_code)] // where `cores` does not choose it, only tests use it
#[derive(Clone, Copy, Debug)]
#[repr(C)] // in the order in which they are loaded
pub(crate) struct HalfwordForm {
    low: [i32; 3],
    high: [i32; 3],
    /// The fraction of the offset in 2⁻¹⁵, and its integer part.
    rest: i32,
    offset: i32,
}

#[allow(dead_code)] // where `cores` does not choose it, only tests use it
impl HalfwordForm {
    /// The factor that justifies coordinates: 16-bit ones to the top of 16 bits, by a shift that is 16 smaller, 0 … 15.
    pub(crate) const fn justify(shift: u32, narrow: bool) -> i32 {
        1 << (if narrow { shift & 15 } else { shift & 31 })
    }

    pub(crate) const ZERO: Self = Self { low: [0; 3], high: [0; 3], rest: 0, offset: 0 };

    pub(crate) fn new(linear: [i32; 3], offset: i64) -> Self {
        let offset = truncated(offset);
        let low = linear.map(|m| (m << 17) >> 17); // −2¹⁴ … 2¹⁴ − 1
        let high = linear.map(|m| (m + (1 << 14)) >> 15); // 16 bits: |m| < 2³⁰ − 2¹⁵
        Self { high, low, offset: (offset >> 32) as i32, rest: (offset >> 17) as i32 & 0x7fff }
    }

    /// The coefficients, and the offset in units, rounded to nearest.
    pub(crate) fn numbers(&self) -> ([i32; 3], i32) {
        let ([a, b, c], [x, y, z]) = (self.high, self.low);
        ([(a << 15) + x, (b << 15) + y, (c << 15) + z], self.offset)
    }

    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], narrow: bool) -> i32 {
        if !narrow {
            return self.at_wide(v);
        }
        let [x, y, z] = v;
        let dot = |[a, b, c]: [i32; 3]| (a * x).wrapping_add(b * y).wrapping_add(c * z); // products ≤ 2³⁰

        // Three low products of at most 2²⁹ each, and 15 bits: below 2³¹.
        ((dot(self.low) + self.rest) >> 15).wrapping_add(dot(self.high)).wrapping_add(self.offset)
    }

    /// Evaluates the form at 32-bit coordinates by 64-bit products. Inlined on RV32, whose registers hold the joined
    /// coefficients through the vertex loop; called on a Cortex-M0, whose products are library calls.
    #[cfg_attr(target_arch = "riscv32", inline(always))]
    #[cfg_attr(not(target_arch = "riscv32"), inline(never))]
    fn at_wide(&self, v: [i32; 3]) -> i32 {
        let [a, b, c] = self.high;
        let [d, e, f] = self.low;
        let doubled = [(a << 16) + (d << 1), (b << 16) + (e << 1), (c << 16) + (f << 1)];
        dot_product(doubled, i64::from(self.offset) << 32 | i64::from(self.rest) << 17, v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::form::WideForm;
    use crate::math::random::{mixed as random, Random};

    /// The plain twin of both, by the count of leading zeros.
    fn normalised_plainly(v: i32) -> (i32, u32) {
        (v << (v.leading_zeros() - 1), v.leading_zeros() - 1)
    }

    #[test]
    fn zeros_are_counted_by_steps_too() {
        let mut state = 3;
        let powers = (0..32).flat_map(|n| [(1u32 << n) - 1, 1 << n, (1 << n) + 1]);
        let others = (0..100_000).map(|_| random(&mut state)).map(|r| r as u32 >> (r >> 59));
        for v in powers.chain([u32::MAX]).chain(others) {
            assert_eq!(leading_zeros_by_steps(v), v.leading_zeros() as i32, "{v}");
            for wide in [u64::from(v), u64::from(v) << 32, u64::from(v) << 17 | 1] {
                assert_eq!(significant_bits_by_steps(wide), 64 - wide.leading_zeros() as i32, "{wide}");
            }
            if let Ok(v @ 1..) = i32::try_from(v) {
                assert_eq!(normalised_by_steps(v), normalised_plainly(v), "{v}");
                assert_eq!(normalised_by_bits(v), normalised_plainly(v), "{v}");
            }
        }
    }

    #[test]
    fn the_product_from_halves_is_exact() {
        let mut state = 1;
        let edges = [0, 1, -1, 0xffff, 0x10000, -0x10000, i32::MAX, i32::MIN, 0x8000, -0x8000];
        for a in edges {
            for b in edges {
                assert_eq!(mul_wide_by_halves(a, b), i64::from(a) * i64::from(b));
            }
        }
        for _ in 0..100_000 {
            let r = random(&mut state);
            let (a, b) = ((r >> 32) as i32, r as i32);
            assert_eq!(mul_wide_by_halves(a, b), i64::from(a) * i64::from(b));
        }
    }

    #[test]
    fn a_row_times_a_matrix_by_halves_is_exact() {
        let mut state = 2;
        for _ in 0..100_000 {
            let mut coefficient = || match random(&mut state) % 4 {
                0 => 0,
                1 => [1 << 30, -(1 << 30), 1, -1][random(&mut state) as usize % 4],
                _ => (random(&mut state) as i32) >> 2,
            };
            let (v, m) =
                ([0; 3].map(|_| coefficient()), [[0; 3]; 3].map(|row| row.map(|_: i32| coefficient())));
            let sum = |j: usize| (0..3).map(|i| i64::from(v[i]) * i64::from(m[i][j])).sum::<i64>();
            assert_eq!(row_times_by_halves(&v, &m), [sum(0), sum(1), sum(2)]);
            assert_eq!(crate::math::num::row_times(&v, &m), [sum(0), sum(1), sum(2)]);
        }
    }

    #[test]
    fn both_forms_give_the_same_bits() {
        let mut random = Random(7);
        let mut random = || random.below(1 << 31) as i32;
        let limit = (1 << 30) - (1 << 15) - 1;
        for i in 0..200_000 {
            let m = [0; 3].map(|_| match random() % 8 {
                0 => limit,
                1 => -limit,
                2 => random() >> 20,
                _ => (random() - (1 << 30)).clamp(-limit, limit),
            });
            let v = [0; 3].map(|_| match random() % 8 {
                0 => i32::MIN,
                1 => 0x7fff << 16,
                _ => (random() << 1) & !0xffff,
            });
            let offset = (i64::from(random()) - (1 << 30)) << (random() % 30) | i64::from(random());
            let (long, split) = (WideForm::new(m, offset), HalfwordForm::new(m, offset));
            assert_eq!(long.numbers(), split.numbers(), "{i}: {m:?} {offset}");
            assert_eq!(long.at(v, true), split.at(v.map(|c| c >> 16), true), "{i}: {m:?} {v:?} {offset}");
            let v = v.map(|c| c ^ random() >> 16);
            assert_eq!(long.at(v, false), split.at(v, false), "{i}: {m:?} {v:?} {offset}");
        }
    }
}
