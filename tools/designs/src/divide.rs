//! Division by w: by a reciprocal of limited precision, or exactly.

use crate::num::{mul_high, mul_wide};

/// A divisor w > 0 of numbers |x| < w.
pub(crate) trait Divide {
    type By: Copy;
    /// The divisor in the form that [`high`](Self::high) takes, and n.
    fn by(w: i32) -> (Self::By, u32);
    /// `x/w · 2^(29 − n)`, rounded down.
    fn high(x: i32, by: Self::By) -> i32;
    /// The quotient before it is rounded down.
    fn before(x: i32, by: Self::By) -> f64;
}

/// 1/w as `mantissa · 2^(n − 61)`, its mantissa of 31 bits from w's, `m`, in 2³⁰ … 2³¹ − 1.
pub(crate) trait Reciprocal {
    fn mantissa(m: i32) -> i32;
}

/// 1/m in 2⁻¹⁶ of 2⁻³⁰, rounded: 2¹⁵ … 2¹⁶, both ends included.
#[inline(always)]
pub(crate) fn sixteen_bits<R: Reciprocal>(m: i32) -> i32 {
    ((R::mantissa(m) as u32 + (1 << 14)) >> 15) as i32
}

impl<R: Reciprocal> Divide for R {
    type By = i32;
    #[inline(always)]
    fn by(w: i32) -> (i32, u32) {
        let (m, n) = normalised(w);
        (R::mantissa(m), n)
    }
    #[inline(always)]
    fn high(x: i32, mantissa: i32) -> i32 {
        mul_high(x, mantissa)
    }
    fn before(x: i32, mantissa: i32) -> f64 {
        mul_wide(x, mantissa) as f64 / 4_294_967_296.0
    }
}

/// The smallest w that [`normalised`] takes.
pub(crate) const LEAST: i32 = 1 << 15;

/// w at the top of 31 bits, and by how much it was shifted. A core that cannot count leading zeros shifts one by one: the
/// farthest vertices of an object need no shift, those at half their distance one, and the compiler's way of counting takes
/// some fifty instructions.
#[inline(always)]
pub(crate) fn normalised(w: i32) -> (i32, u32) {
    if cfg!(any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32")))) {
        let (mut m, mut n) = (w, 0);
        while m < 1 << 30 {
            m <<= 1;
            n += 1;
        }
        (m, n & 31)
    } else {
        let n = w.leading_zeros().wrapping_sub(1) & 31;
        (w << n, n)
    }
}

/// 9 bits of 1/m for 256 intervals of m, the leading one left out: relative error 2⁻⁸·⁴.
const TABLE: [u8; 256] = {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        table[i] = (((1usize << 19) / (513 + 2 * i)).div_ceil(2) - 256) as u8; // 2⁹/(1 + (i + ½)/256), rounded
        i += 1;
    }
    table
};

/// The reciprocal by the table, in 2⁻⁹.
#[inline(always)]
fn nine_bits(m: i32) -> i32 {
    256 + i32::from(TABLE[(m >> 22) as usize & 0xff])
}

/// The table alone.
pub(crate) struct Table;
/// The table and a Newton step.
pub(crate) struct OneStep;
/// The table and two Newton steps.
pub(crate) struct TwoSteps;
/// A 32-bit division, and a Newton step.
pub(crate) struct Divided;
/// 257 entries of 16 bits, and a straight line between two of them.
pub(crate) struct Interpolated;

impl Reciprocal for Table {
    #[inline(always)]
    fn mantissa(m: i32) -> i32 {
        nine_bits(m) << 22
    }
}

impl Reciprocal for OneStep {
    #[inline(always)]
    fn mantissa(m: i32) -> i32 {
        let r = nine_bits(m);
        let e = m.wrapping_mul(r).wrapping_neg(); // 1 − m·r in 2⁻³⁹: the bits above 32 cancel
        (r << 22) + (((e >> 9) * r) >> 8) // r·(1 + e); |e| < 2³⁰·⁶
    }
}

impl Reciprocal for TwoSteps {
    #[inline(always)]
    fn mantissa(m: i32) -> i32 {
        let r = nine_bits(m);
        let e = m.wrapping_mul(r).wrapping_neg();
        // r·(1 + e)·(1 + e²): both steps at once. (Muller et al., Handbook of Floating-Point Arithmetic, 2nd ed., 4.7.)
        let short = e >> 16; // in 2⁻²³
        let square = (short * short) >> 7; // in 2⁻³⁹, below 2²³
        let cube = (short * (square >> 16)) >> 7;
        (r << 22) + ((((e + square + cube) >> 9) * r) >> 8)
    }
}

impl Reciprocal for Divided {
    #[inline(always)]
    fn mantissa(m: i32) -> i32 {
        let r = u32::MAX.checked_div(m as u32 >> 14).unwrap_or(0) as i32; // in 2⁻¹⁶: 2¹⁵ … 2¹⁶ − 1
        let e = m.wrapping_mul(r).wrapping_neg(); // 1 − m·r in 2⁻⁴⁶, −2³⁰ … 2³¹
        (r << 15) + (((e >> 16) * r) >> 15)
    }
}

const KNOTS: [u16; 257] = {
    let mut knots = [0; 257];
    let mut i = 0;
    while i <= 256 {
        // 2¹⁷/(1 + i/256) − 2¹⁶, rounded; the first would be 2¹⁶, and is one less.
        let knot = ((1u64 << 26) / (256 + i as u64)).div_ceil(2) - (1 << 16);
        knots[i] = if knot > 0xffff { 0xffff } else { knot as u16 };
        i += 1;
    }
    knots
};

impl Reciprocal for Interpolated {
    #[inline(always)]
    fn mantissa(m: i32) -> i32 {
        let at = (m >> 22) as usize & 0xff;
        let (left, right) = (i32::from(KNOTS[at]), i32::from(KNOTS[at + 1]));
        let part = (m >> 10) & 0xfff;
        // In 2⁻¹⁷ with its leading bit: 17 bits; a few more from the line.
        ((1 << 16 | left) << 14) - (((left - right) * part) << 2)
    }
}

/// A 64-bit division for each coordinate.
pub(crate) struct Exact;

impl Divide for Exact {
    type By = i32;
    #[inline(always)]
    fn by(w: i32) -> (i32, u32) {
        (w, 0)
    }
    #[inline(always)]
    fn high(x: i32, w: i32) -> i32 {
        (i64::from(x) << 29).checked_div(w.into()).unwrap_or(0) as i32
    }
    fn before(x: i32, w: i32) -> f64 {
        f64::from(Self::high(x, w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest relative error met, as a power of two.
    fn error<R: Reciprocal>() -> f64 {
        let ends = [1 << 30, (1 << 30) + 1, i32::MAX];
        let all = ends.into_iter().chain((1 << 30..i32::MAX - 1000).step_by(977));
        let off = |m: i32| (f64::from(R::mantissa(m)) * f64::from(m) / 2f64.powi(61) - 1.0).abs();
        all.map(off).fold(0.0, f64::max).log2()
    }

    #[test]
    fn reciprocals_have_their_bits() {
        for (name, error, bound) in [
            ("table", error::<Table>(), -8.4),
            ("one step", error::<OneStep>(), -16.8),
            ("two steps", error::<TwoSteps>(), -28.0),
            ("divided", error::<Divided>(), -28.0),
            ("interpolated", error::<Interpolated>(), -16.0),
        ] {
            assert!(error <= bound && bound <= error + 1.0, "{name}: 2^{error}");
        }
    }

    #[test]
    fn w_is_normalised() {
        for k in 15..31 {
            for w in [1 << k, (1 << k) + 1, i32::MAX >> (30 - k)] {
                let (m, n) = normalised(w);
                assert!(m >> 30 == 1 && m >> n == w);
            }
        }
    }
}
