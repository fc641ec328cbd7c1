//! Levels of colour channels as fixed-point numbers of 32 bits.

use super::Flat;
use crate::color::Color;
use crate::math::num::mul_wide;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// The number of fractional bits of a level in 32 bits: all bits that the largest level does not need. A right shift by this
/// number gives the integer part.
pub(super) const fn fraction_bits(max: u8) -> u32 {
    24 + (max | 1).leading_zeros()
}

/// The largest level, shifted left so that its highest bit is bit 7.
pub(super) const fn aligned_max(max: u8) -> u8 {
    max << (max | 1).leading_zeros()
}

/// A function of each channel and its highest level; a grey has one channel, the first.
#[inline(always)]
pub(super) fn each<C: Color, T, U: Default>([r, g, b]: [T; 3], of: impl Fn(T, u8) -> U) -> [U; 3] {
    let [x, y, z] = C::FORMAT.max();
    match C::FORMAT.is_gray() {
        true => [of(r, x), U::default(), U::default()],
        false => [of(r, x), of(g, y), of(b, z)],
    }
}

/// Red, green and blue times 2⁸; of a grey target, the luma of Rec. 601 times 2⁸ first.
#[inline(always)]
pub(super) fn scaled<C: Color>([r, g, b]: [u32; 3]) -> [u32; 3] {
    match C::FORMAT.is_gray() {
        true => [77 * r + 150 * g + 29 * b, 0, 0],
        false => [r << 8, g << 8, b << 8],
    }
}

/// The channels of `C` as levels with [`fraction_bits`] − 8 fractional bits, below 2²⁴, rounded to nearest.
#[inline]
pub(super) fn levels<C: Color>(color: Flat) -> [i32; 3] {
    let channels = scaled::<C>(color.0.map(u32::from)); // ≤ 255·2¹⁶
    each::<C, _, _>(channels, |channel, max| level(channel, aligned_max(max)))
}

/// The colour of the target nearest to `share`/255 of `color` plus `other_share`/255 of `other`, each channel saturating at full; halves are
/// rounded up. Shares are 0 … 255.
#[inline(always)]
pub(super) fn mixture<C: Color>(color: Rgb888, share: u32, other: Rgb888, other_share: u32) -> C {
    let ([r, g, b], [s, t, u]) = (channels(color), channels(other));
    let sum = |own: u32, other: u32| (own * share + other * other_share).min(255 * 255);
    nearest([sum(r, s), sum(g, t), sum(b, u)])
}

fn channels(color: Rgb888) -> [u32; 3] {
    [color.r(), color.g(), color.b()].map(u32::from)
}

/// The colour of the target nearest to channels in 1/255 of a step of `Rgb888`, at most 255·255; halves are rounded up.
#[inline(always)]
fn nearest<C: Color>(channels: [u32; 3]) -> C {
    const UNIT: u32 = 256 * 255 * 255;
    // A channel is at most 255·255, here 2⁸ times as much, times 255: less than 2³² with the half.
    let nearest = |channel: u32, max: u8| (channel * u32::from(max) + UNIT / 2) / UNIT;
    let levels = each::<C, _, _>(scaled::<C>(channels), nearest);
    C::from_channels(levels.map(|level| level as u8)) // ≤ MAX
}

/// `value · max/255`, rounded to nearest, for values up to 255·2¹⁶.
fn level(value: u32, max: u8) -> i32 {
    let sum = value * u32::from(max) + 127; // < 2³²

    // ⌊sum/255⌋ = ⌊sum · ⌈2³⁹/255⌉ / 2³⁹⌋, without a division: a Cortex-M0 has none. (Warren, Hacker's
    // Delight, 2nd ed., section 10–9.)
    ((u64::from(sum) * 0x8080_8081) >> 39) as i32
}

/// The weighted mean of values 0 … `full`, with weights in 2⁻³⁰, rounded to nearest.
#[inline(always)] // out of line, S8 takes 1 % more on a Cortex-M0
pub(super) fn weighted_mean(values: [i32; 3], weights: [i32; 3], full: i32) -> i32 {
    // Weights are −6 … 2³⁰ + 6 and sum to 2³⁰; full < 2²⁴.
    let sum: i64 = values.iter().zip(weights).map(|(&value, weight)| mul_wide(value, weight)).sum();
    ((sum + (1 << 29)) >> 30).clamp(0, full.into()) as i32
}

/// A level from [`levels`] with 8 fractional bits more, [`fraction_bits`] in all: the integer part takes the upper bits.
#[inline(always)]
pub(super) fn align(level: i32) -> u32 {
    (level as u32) << 8 // < 2²⁴ and not negative
}

/// Adds `by`, in 2⁻²⁴ level, to the level of each channel.
#[inline(always)]
pub(super) fn add_bias<C: Color>(levels: [u32; 3], by: u32) -> [u32; 3] {
    each::<C, _, _>(levels, |level, max| level.wrapping_add(by << (fraction_bits(max) - 24)))
    // by < 2²⁴
}

/// The integer parts of levels.
#[inline(always)]
pub(super) fn integer_parts<C: Color>(levels: [u32; 3]) -> [u8; 3] {
    each::<C, _, _>(levels, |level, max| (level >> fraction_bits(max)) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_rounded_to_nearest() {
        for max in [1, 3, 15, 31, 63, 255u8] {
            for value in 0..=255 << 16 {
                // 255 is odd: no ties.
                let wanted = (u64::from(value) * u64::from(max) * 2 + 255) / 510;
                assert_eq!(i64::from(level(value, max)), wanted as i64, "{value} of {max}");
            }
            assert_eq!(level(255 << 16, max), i32::from(max) << 16); // white is white
        }
    }
}
