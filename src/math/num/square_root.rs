//! The integer square root.

use crate::math::hints::keep_rolled;

/// The integer square root, rounded to nearest, digit by digit: 32 steps, no division. (Warren, Hacker's Delight, 2nd ed.,
/// section 11–1.)
#[inline(never)] // set-up: code size counts, speed does not
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

/// The integer square root of 32 bits, rounded to nearest, digit by digit: 16 steps, for a vertex. √(2³² − 1) rounds to 2¹⁶.
#[inline(never)] // a vertex calls it once
pub(crate) const fn sqrt_word(v: u32) -> u32 {
    let (mut rest, mut root, mut bit) = (v, 0u32, 1u32 << 30);
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
    // rest = v − root² ≤ 2·root; root + ½ is passed when rest > root.
    root + (rest > root) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed as random;

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
    fn square_roots_of_words_round_to_nearest() {
        let mut state = 3;
        for k in 0..32 {
            for edge in [u32::MAX, 1 << 31, random(&mut state) as u32, random(&mut state) as u32, 0] {
                let v = edge >> k;
                let (r, v4) = (u64::from(sqrt_word(v)), u64::from(v) * 4);
                assert!(v4 < (2 * r + 1).pow(2) && (r == 0 || v4 >= (2 * r - 1).pow(2)), "{v} {r}");
            }
        }
    }
}
