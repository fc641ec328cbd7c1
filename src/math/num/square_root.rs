//! The integer square root.

use crate::math::hints::keep_rolled;

/// The integer square root, rounded to nearest, digit by digit: 32 steps, no division. (Warren, Hacker's Delight, 2nd ed.,
/// section 11–1.)
#[inline(never)] // set-up: code size counts
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
