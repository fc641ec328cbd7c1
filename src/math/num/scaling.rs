//! Multiplication by powers of two, rounded to nearest.

use super::bits::min;
use crate::math::cores::COUNTS_LEADING_ZEROS;

/// `v · 2^shift`, saturating to the left at ±(2⁶³ − 1), rounded to nearest (ties up) to the right.
#[inline(never)] // set-up: code size counts
pub(crate) const fn scale(v: i64, shift: i32) -> i64 {
    if shift >= 0 {
        let shift = min(shift, 63);
        if loses_no_bit(v, shift) {
            v << shift
        } else {
            ((v >> 63) ^ i64::MAX) | 1 // ±(2⁶³ − 1) by the sign
        }
    } else if shift > -64 {
        let floor = v >> (-shift - 1); // shifted by 0 … 62
        (floor >> 1) + (floor & 1)
    } else {
        0
    }
}

/// Whether |v|·2^shift < 2⁶³. Where an instruction counts leading zeros, that is faster than to shift up and down.
#[inline(always)]
const fn loses_no_bit(v: i64, shift: i32) -> bool {
    if COUNTS_LEADING_ZEROS {
        return shift < v.unsigned_abs().leading_zeros() as i32; // of |v|, with the sign bit; 64 of them for 0
    }
    let up = v << shift;
    up >> shift == v && up != i64::MIN
}

/// `v / 2^down`, rounded to nearest (ties up), for |v| < 2^(30 + down) and −30 ≤ down ≤ 32: [`scale`] by −`down`, where the
/// result has 32 bits.
#[inline(always)]
pub(crate) const fn scale_to_word(v: i64, down: i32) -> i32 {
    if down < 1 {
        return (v as i32).wrapping_shl(-down as u32); // below 2³⁰
    }
    // ⌊v / 2^n⌋ for n = down − 1, 0 … 31: below 2³¹, so its upper word is not needed.
    let n = down as u32 - 1;
    let floor = (v as u32).wrapping_shr(n) | ((v >> 32) as u32).wrapping_shl(1).wrapping_shl(31 - n);
    halved(floor as i32)
}

/// [`scale_to_word`] for any `down` from −30 on, for |v| < 2^(30 + down): any `v` where `down` is above 32.
#[inline(always)]
pub(crate) const fn scale_long_to_word(v: i64, down: i32) -> i32 {
    if down > 32 {
        return scale_word((v >> 32) as i32, down - 32); // a floor of a floor, then rounded
    }
    scale_to_word(v, down)
}

/// `m / 2^down`, rounded to nearest (ties up), for any `down` from 1 on.
#[inline(always)]
pub(crate) const fn scale_word(m: i32, down: i32) -> i32 {
    halved(m >> min(down - 1, 31)) // from 2⁻³² on all are below ½
}

/// `v / 2`, rounded to nearest (ties up).
#[inline(always)]
const fn halved(v: i32) -> i32 {
    (v >> 1) + (v & 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::num::scaled;
    use crate::math::random::mixed as random;

    /// The numbers near ±2^k, and random ones of all sizes.
    fn numbers() -> impl Iterator<Item = i64> {
        let near =
            |k: u32| (-2..=2).flat_map(move |d| [(1i64 << k).wrapping_add(d), (-1i64 << k).wrapping_add(d)]);
        let mut state = 9;
        let random = (0..20_000).map(move |_| {
            let r = random(&mut state);
            r as i64 >> (random(&mut state) % 64)
        });
        (0..64).flat_map(near).chain(random)
    }

    #[test]
    fn shifts_round_and_saturate() {
        let limit = (1 << 63) - 1;
        for v in numbers() {
            for shift in -70..=70 {
                let want = scaled(i128::from(v), shift.clamp(-66, 63)).clamp(-limit, limit);
                assert_eq!(i128::from(scale(v, shift)), want, "{v} {shift}");
            }
        }
    }

    #[test]
    fn shifts_to_a_word_are_shifts() {
        for v in numbers() {
            let bits = 64 - v.unsigned_abs().leading_zeros() as i32;
            for down in (bits - 30).max(-30)..=32 {
                assert_eq!(i64::from(scale_to_word(v, down)), scale(v, -down), "{v} {down}");
            }
            for down in (bits - 30).max(-30)..=100 {
                assert_eq!(i64::from(scale_long_to_word(v, down)), scale(v, -down), "{v} {down}");
            }
            for down in 1..=70 {
                assert_eq!(
                    i64::from(scale_word(v as i32, down)),
                    scale((v as i32).into(), -down),
                    "{v} {down}"
                );
            }
        }
    }
}
