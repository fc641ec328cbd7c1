//! The slope of a line as a fixed-point number, with which pixels of lines are stepped without an error term.
//!
//! This file has no fast path of its own, so it has no plain twin, gain or test: see `line_fill.rs` and `line_pixels.rs`, which
//! step by it.

use crate::math::num::{mul_high, reciprocal};
use crate::raster::LineSetup;

/// Just below ½, in 2⁻³².
///
/// After i major steps a line has made ⌊(2mi + L − 1)/2L⌋ minor steps, for its minor extent m and its major extent L. The sum
/// of i slopes and this constant is (2mi + L − 1)/2L plus 1/2L − 2⁻³², minus i times the error of the slope. Both have the same
/// floor as long as their difference is at least 0 (then the floor is not too low) and below 1/2L (then it is not too high,
/// because (2mi + L − 1)/2L is a multiple of 1/2L).
pub(super) const HALF: u32 = (1 << 31) - 1;

/// The largest L with 48·L + 1 ≤ 2³²/2L: a slope is too small by less than 48 · 2⁻³².
pub(super) const LONGEST: i32 = 6688;

/// m/L in 2⁻³², too small by 0 to less than 48 units; 0 if m is 0. `0 ≤ m ≤ L`, `0 < L < 2¹⁶`.
#[inline(always)]
pub(super) fn slope(&LineSetup { rise, length, .. }: &LineSetup) -> u32 {
    let r = reciprocal(length);
    // m·2^shift ≤ L·2^shift < 2³¹, and the mantissa is 2⁶¹/(L·2^shift) within 2⁻²⁸: the high word is m/L in 2⁻²⁹, within
    // 2 and rounded down. So 3 less is too small by 0 to 6 units, and below 2²⁹.
    let high = mul_high(rise << r.shift, r.mantissa) - 3;
    (high.max(0) as u32) << 3
}
