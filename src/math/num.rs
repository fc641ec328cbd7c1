//! Integer building blocks. Every shift and width has its bound beside it.
//!
//! A Cortex-M0 multiplies 32 × 32 bits to the low 32 only, and the compiler's 64-bit product is a
//! library call there. The products used per vertex and per edge are therefore also written from
//! 16-bit pieces; both forms are exact, so all cores compute the same bits.

pub(crate) use super::hints::{keep_rolled, opaque_next as after};

/// `a · b`, exact.
#[inline(always)]
pub(crate) const fn mul_wide(a: i32, b: i32) -> i64 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    return mul_wide_by_halves(a, b);
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    return a as i64 * b as i64;
}

/// `⌊a · b / 2³²⌋`.
#[inline(always)]
pub(crate) const fn mul_high(a: i32, b: i32) -> i32 {
    (mul_wide(a, b) >> 32) as i32 // |a·b| ≤ 2⁶²: the high word fits
}

/// [`mul_wide`] from four 16-bit products, for cores whose multiplier keeps 32 bits.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline]
const fn mul_wide_by_halves(a: i32, b: i32) -> i64 {
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

/// `1/m` for the 256 intervals of m ∈ [1, 2), in 2⁻⁹, less the leading 256: the largest
/// `|1 − m·r|` over each interval is the smallest that nine bits allow, 2⁻⁸·⁴⁵ at worst.
#[rustfmt::skip]
const RECIPROCAL: [u8; 256] = [
    255, 253, 251, 249, 247, 245, 243, 241, 240, 238, 236, 234, 232, 230, 229, 227,
    225, 223, 221, 220, 218, 216, 215, 213, 211, 210, 208, 206, 205, 203, 201, 200,
    198, 197, 195, 194, 192, 191, 189, 188, 186, 185, 183, 182, 180, 179, 177, 176,
    174, 173, 172, 170, 169, 167, 166, 165, 163, 162, 161, 159, 158, 157, 156, 154,
    153, 152, 150, 149, 148, 147, 145, 144, 143, 142, 141, 139, 138, 137, 136, 135,
    134, 132, 131, 130, 129, 128, 127, 126, 124, 123, 122, 121, 120, 119, 118, 117,
    116, 115, 114, 113, 112, 111, 110, 109, 108, 107, 106, 105, 104, 103, 102, 101,
    100, 99, 98, 97, 96, 95, 94, 93, 92, 91, 90, 89, 88, 88, 87, 86,
    85, 84, 83, 82, 81, 81, 80, 79, 78, 77, 76, 75, 75, 74, 73, 72,
    71, 70, 70, 69, 68, 67, 66, 66, 65, 64, 63, 63, 62, 61, 60, 59,
    59, 58, 57, 56, 56, 55, 54, 53, 53, 52, 51, 51, 50, 49, 48, 48,
    47, 46, 46, 45, 44, 44, 43, 42, 42, 41, 40, 40, 39, 38, 38, 37,
    36, 36, 35, 34, 34, 33, 32, 32, 31, 30, 30, 29, 29, 28, 27, 27,
    26, 26, 25, 24, 24, 23, 23, 22, 21, 21, 20, 20, 19, 18, 18, 17,
    17, 16, 16, 15, 15, 14, 13, 13, 12, 12, 11, 11, 10, 10, 9, 9,
    8, 7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0,
];

/// A Cortex-M0: without division, wide products and a count of leading zeros, and with eight registers. Not a
/// Cortex-M23 (ARMv8-M Baseline), which divides and has atomics but no wide products: the same bits, slower.
pub(crate) const CORTEX_M0: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// A positive number's reciprocal: `1/v = mantissa · 2^(shift − 61)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reciprocal {
    /// 2³⁰ … 2³¹ − 1.
    pub(crate) mantissa: i32,
    /// The left shift that normalises `v` to 2³⁰ … 2³¹ − 1: 0 … 30.
    pub(crate) shift: u32,
}

/// The reciprocal of `v`; the relative error is at most 2⁻²⁹ (asserted in this file's tests).
/// `v < 1` counts as 1.
///
/// A table gives r with `e = m·r − 1`, |e| < 2⁻⁸·⁴⁵, and `1/m = r·(1 − e + e² − e³ + …)`; the
/// terms to e³ leave e⁴ < 2⁻³³. `e` itself comes exactly out of one 32-bit product because its
/// leading bits cancel. (Series for the reciprocal: Muller et al., Handbook of Floating-Point
/// Arithmetic, 2nd ed., section 4.7.)
#[inline(always)]
pub(crate) fn reciprocal(v: i32) -> Reciprocal {
    reciprocal_of_positive(v.max(1))
}

/// [`reciprocal`] where `v ≥ 1` is known.
#[inline(always)]
pub(crate) fn reciprocal_of_positive(v: i32) -> Reciprocal {
    reciprocal_of_normalised(normalised(v))
}

/// How many bits of a number are zero from the uppermost on.
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline(always)]
pub(crate) fn leading_zeros(v: u32) -> i32 {
    v.leading_zeros() as i32
}

/// The same where no instruction counts them, and the compiler would call.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
pub(crate) use self::leading_zeros_by_steps as leading_zeros;

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline(always)]
pub(crate) fn leading_zeros_by_steps(v: u32) -> i32 {
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

/// [`reciprocal`] where `v ≥ 1` is known, and most often near 2³⁰: quickest there.
#[inline(always)]
pub(crate) fn reciprocal_of_large(v: i32) -> Reciprocal {
    reciprocal_of_normalised(normalised_by_ones(v))
}

/// `m`: 2³⁰ … 2³¹ − 1, in 2⁻³⁰.
#[inline(always)]
fn reciprocal_of_normalised((m, shift): (i32, u32)) -> Reciprocal {
    let index = (m >> 22) as usize & 0xff;
    // The mask keeps the index inside the table; `get` says so without a panic path.
    let r = 256 + i32::from(RECIPROCAL.get(index).copied().unwrap_or(0)); // in 2⁻⁹
    let e = m.wrapping_mul(r); // 2³⁹·(m·r − 1): |e| < 2³⁰·⁶, and 2³⁹ ≡ 0 mod 2³²
    let e1 = e >> 16; // in 2⁻²³, |e1| < 2¹⁵
    let e2 = e1 - ((e1 * e1) >> 23); // e − e², in 2⁻²³
    let s = (e - ((e1 * e2) >> 7)) >> 9; // e − e² + e³, in 2⁻³⁰, |s| < 2²²
                                         // |s·r| < 2³¹; one less, lest 1 become 2³¹.
    Reciprocal { mantissa: (r << 22) + !((s * r) >> 8), shift }
}

/// `v ≥ 1` shifted left to 2³⁰ … 2³¹ − 1, and the shift.
#[cfg(not(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32")))]
#[inline(always)]
fn normalised(v: i32) -> (i32, u32) {
    let shift = v.leading_zeros().wrapping_sub(1) & 31; // v ≥ 1 has 1 … 31 leading zeros
    (v << shift, shift)
}

/// [`normalised`] for those near 2³⁰.
#[cfg(not(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32")))]
#[inline(always)]
fn normalised_by_ones(v: i32) -> (i32, u32) {
    normalised(v)
}

/// The same where no instruction counts leading zeros.
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
use self::normalised_by_steps as normalised;

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
#[inline(always)]
fn normalised_by_steps(mut v: i32) -> (i32, u32) {
    let mut shift = 0;
    while v < 1 << 23 {
        keep_rolled();
        (v, shift) = (v << 8, shift + 8);
    }
    // Twice it: the end is a sign.
    let mut twice = v << 1;
    while twice >= 0 {
        keep_rolled();
        (twice, shift) = (twice << 1, shift + 1);
    }
    ((twice as u32 >> 1) as i32, shift)
}

#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), target_arch = "riscv32"))]
#[inline(always)]
fn normalised_by_ones(mut v: i32) -> (i32, u32) {
    let mut shift = 0;
    while v < 1 << 30 {
        keep_rolled();
        (v, shift) = (v << 1, shift + 1);
    }
    (v, shift)
}

/// The integer square root, rounded to nearest.
///
/// Digit by digit: 32 steps, no division. (Warren, Hacker's Delight, 2nd ed., section 11–1.)
#[inline(never)] // set-up: small is better
pub(crate) const fn sqrt(v: u64) -> u32 {
    let (mut rest, mut root, mut bit) = (v, 0u64, 1u64 << 62);
    while bit != 0 {
        keep_rolled();
        if rest >= root + bit {
            rest -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
        bit >>= 2;
    }
    // rest = v − root²; root + ½ is passed when rest > root. The root of 2⁶⁴ − 1 would round to
    // 2³², so the last step saturates.
    let root = root as u32; // root < 2³²
    root.saturating_add((rest > root as u64) as u32)
}

/// `⌊n · 2^bits / d⌋` by long division: no library call, no panic. Wants `n < 2·d`, `0 < d < 2⁶²`
/// and `bits ≤ 62`; a zero divisor gives all ones.
#[inline(never)] // set-up: small is better
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

/// `⌊n / d⌋` and the remainder for `n < 2⁶²`, `0 < d < 2³¹`, by long division.
#[inline(never)] // set-up: small is better
pub(crate) fn divide(n: u64, d: u32) -> (u64, u32) {
    // Their difference in bits; `n` is less than twice `d` shifted by it.
    let bits = max(shift_to_fit(n, 0) - shift_to_fit(d.into(), 0), 0) as u32;
    let quotient = fraction(n, u64::from(d) << bits, bits);
    (quotient, (n as u32).wrapping_sub((quotient as u32).wrapping_mul(d))) // below d: 31 bits tell
}

/// `v · 2^shift`, saturating to the left at ±(2⁶³ − 1), rounded to nearest (ties up) to the right.
#[inline(never)] // set-up: small is better
pub(crate) const fn scale(v: i64, shift: i32) -> i64 {
    if shift >= 0 {
        let room = v.unsigned_abs().leading_zeros() as i32 - 1; // bits left of |v| below bit 63: of 0, all 63
        let shift = min(shift, 63);
        if shift <= room {
            v << shift
        } else {
            ((v >> 63) ^ i64::MAX) | 1 // the sign's: the odd one of two's complement is the limit
        }
    } else if shift > -64 {
        let floor = v >> (-shift - 1); // shifted by 0 … 62
        (floor >> 1) + (floor & 1)
    } else {
        0
    }
}

/// `a · b`, exact in 64 bits for coefficients of at most 2³⁰: sums of three products, below 2⁶².
#[inline(never)] // set-up: small is better
pub(crate) const fn dot(a: &[i32; 3], b: &[i32; 3]) -> i64 {
    let ([a, b, c], [x, y, z]) = (*a, *b);
    a as i64 * x as i64 + b as i64 * y as i64 + c as i64 * z as i64
}

/// The rows as columns.
pub(crate) const fn transposed([x, y, z]: &[[i32; 3]; 3]) -> [[i32; 3]; 3] {
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

/// Row `v` times matrix `m`, coefficients of at most 2³⁰: sums of three products, below 2⁶².
#[inline(never)] // set-up: small is better
pub(crate) const fn row_times(v: &[i32; 3], m: &[[i32; 3]; 3]) -> [i64; 3] {
    let ([a, b, c], [x, y, z]) = (*v, m);
    let (a, b, c) = (a as i64, b as i64, c as i64);
    [
        a * x[0] as i64 + b * y[0] as i64 + c * z[0] as i64,
        a * x[1] as i64 + b * y[1] as i64 + c * z[1] as i64,
        a * x[2] as i64 + b * y[2] as i64 + c * z[2] as i64,
    ]
}

/// Translations stay within ±2⁶² (2³⁰ world units in 2⁻³²), so that two of them can be added.
pub(crate) const SATURATED: i64 = 1 << 62;

/// `a + b` for translations, saturating at ±2⁶².
#[inline(never)] // set-up: small is better
pub(crate) const fn add(a: i64, b: i64) -> i64 {
    match a.saturating_add(b) {
        sum if sum > SATURATED => SATURATED,
        sum if sum < -SATURATED => -SATURATED,
        sum => sum,
    }
}

/// `m · 2^exponent · t`, rounded to nearest, saturating at ±2⁶². Wants |m| ≤ 2³⁰ and |t| ≤ 2⁶².
pub(crate) const fn mul_translation(m: i32, exponent: i32, t: i64) -> i64 {
    add(Product::ZERO.plus(m, t).scaled(exponent), 0)
}

/// A sum of up to three products of a coefficient (at most 2³⁰ in absolute value) and a translation (2⁶²), exactly:
/// high·2³² + low.
#[derive(Clone, Copy)]
pub(crate) struct Product {
    /// At most 3·2⁶⁰ in absolute value, and carries.
    high: i64,
    low: u32,
}

impl Product {
    pub(crate) const ZERO: Self = Self { high: 0, low: 0 };

    #[inline(always)]
    pub(crate) const fn plus(self, m: i32, t: i64) -> Self {
        let m = m as i64;
        // t in two words: m·upper ≤ 2⁶⁰, m·lower < 2⁶².
        let low = self.low as i64 + m * (t as u32 as i64);
        Self { high: self.high + m * (t >> 32) + (low >> 32), low: low as u32 }
    }

    /// Times 2^exponent, rounded to nearest; beyond ±(2⁶³ − 2³²) anything that far.
    #[inline(always)]
    pub(crate) const fn scaled(self, exponent: i32) -> i64 {
        let (down, up) = (min(exponent, 0), max(exponent, 0));
        // Shifted right by 32 or more, the high word rounds by itself; the low one has the rounding bit where
        // the shift is exactly 32, and is nothing beyond.
        scale(scale(self.high, 32 + down).saturating_add(scale(self.low as i64, down)), up)
    }
}

/// The bits that any of the numbers has: as many as the largest.
#[inline(never)] // set-up: small is better
pub(crate) const fn bits_of(mut numbers: &[i64]) -> u64 {
    let mut bits = 0;
    while let Some((number, left)) = numbers.split_first() {
        keep_rolled();
        bits |= number.unsigned_abs();
        numbers = left;
    }
    bits
}

/// The same for coefficients.
#[inline(never)] // set-up: small is better
pub(crate) fn magnitude(linear: &[i32]) -> u32 {
    linear.iter().fold(0, |bits, m| {
        keep_rolled();
        bits | m.unsigned_abs()
    })
}

/// The larger one: `Ord` is not for constants.
pub(crate) const fn max(a: i32, b: i32) -> i32 {
    if a > b {
        a
    } else {
        b
    }
}

/// The smaller one.
pub(crate) const fn min(a: i32, b: i32) -> i32 {
    -max(-a, -b)
}

/// How far to shift `v` right so that it keeps at most `bits` bits: negative to the left.
pub(crate) const fn shift_to_fit(v: u64, bits: i32) -> i32 {
    64 - v.leading_zeros() as i32 - bits
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(state: &mut u64) -> u64 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    #[test]
    fn zeros_are_counted_by_steps_too() {
        let mut state = 3;
        let powers = (0..32).flat_map(|n| [(1u32 << n) - 1, 1 << n, (1 << n) + 1]);
        let others = (0..100_000).map(|_| random(&mut state)).map(|r| r as u32 >> (r >> 59));
        for v in powers.chain([u32::MAX]).chain(others) {
            assert_eq!(leading_zeros_by_steps(v), v.leading_zeros() as i32, "{v}");
            if let Ok(v @ 1..) = i32::try_from(v) {
                assert_eq!(normalised_by_steps(v), normalised(v), "{v}");
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

    /// The bound in the documentation of [`reciprocal`] is at most twice the largest error met.
    #[test]
    fn e8_reciprocal_is_within_2_to_the_minus_29() {
        let mut worst = 0f64;
        let mut check = |v: i32| {
            let r = reciprocal(v);
            assert!(r.mantissa >= 1 << 30, "{v}: {r:?}");
            let got = f64::from(r.mantissa) * (f64::from(r.shift) - 61.0).exp2();
            worst = worst.max((got * f64::from(v) - 1.0).abs());
        };
        for k in 0..31 {
            for d in [-1, 0, 1] {
                check((1i32 << k).wrapping_add(d).max(1));
            }
        }
        check(i32::MAX);
        for v in (1 << 30..i32::MAX - 1000).step_by(977) {
            check(v);
        }
        let bound = (-29f64).exp2();
        assert!(worst <= bound && bound <= 2.0 * worst, "2^{}", worst.log2());
    }

    #[test]
    fn square_roots_round_to_nearest() {
        let mut state = 2;
        for k in 0..64 {
            for _ in 0..1000 {
                let v = random(&mut state) >> k;
                let r = u128::from(sqrt(v));
                let v4 = u128::from(v) * 4;
                assert!(r == u128::from(u32::MAX) || v4 < (2 * r + 1).pow(2));
                assert!(r == 0 || v4 >= (2 * r - 1).pow(2), "{v} {r}");
            }
        }
        assert_eq!(sqrt(u64::MAX), u32::MAX);
    }

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
            }
        }
    }

    /// `n · 2^exponent`, rounded to nearest (ties up).
    fn scaled(n: i128, exponent: i32) -> i128 {
        match exponent {
            0.. => n << exponent,
            _ => (n + (1 << (-exponent - 1))) >> -exponent,
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
            let sum = (0..3).fold(Product::ZERO, |sum, i| sum.plus(m[i], t[i]));
            let exact = (0..3).map(|i| i128::from(m[i]) * i128::from(t[i])).sum();
            let limit = (1 << 63) - (1 << 32);
            let (got, want) = (i128::from(sum.scaled(exponent)), scaled(exact, exponent));
            assert_eq!(got.clamp(-limit, limit), want.clamp(-limit, limit), "{m:?} {exponent} {t:?}");
        }
    }
}
