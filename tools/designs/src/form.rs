//! Linear forms of i16 vertices with coefficients of 30 bits: nothing is dropped before the one rounding.

use crate::num::{exp2, log2_above, nearest, sum_of};
use crate::Object;

/// The least exponent with which the row fits 32 bits over all vertices, and each coefficient 30.
pub(crate) fn exponent(row: [f64; 3], offset: f64) -> i32 {
    let largest = row.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let bound = (sum_of(row) * Object::REACH + offset.abs()).max(2.0 * largest * Object::REACH);
    log2_above(bound * (1.0 + exp2(-14))) - 31
}

/// `⌊row · v + offset + ½⌋`.
pub(crate) struct Form {
    /// The offset in 2⁻¹⁶.
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    row: [i32; 3],
    /// The offset in 2⁻³², the rounding half included.
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    offset: i64,
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    halves: Halves,
}

/// For a multiplier that keeps 32 bits: the coefficients in 2⁻¹⁵ as high·2¹⁵ + low.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
struct Halves {
    high: [i32; 3],
    low: [i32; 3],
    whole: i32,
    rest: i32,
}

impl Form {
    /// The form in units of 2^exponent.
    pub(crate) fn new(row: [f64; 3], offset: f64, exponent: i32) -> Self {
        Self::scaled(row, offset, exp2(-exponent))
    }

    pub(crate) fn scaled(row: [f64; 3], offset: f64, factor: f64) -> Self {
        let row = row.map(|c| nearest(c * factor * 32768.0) as i32);
        let offset = nearest(offset * factor * exp2(32)) + (1 << 31);
        #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
        return Self { row: row.map(|c| c << 1), offset };
        #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
        {
            let low = row.map(|c| (c << 17) >> 17);
            let high = [0, 1, 2].map(|i| (row[i] - low[i]) >> 15);
            let (whole, rest) = ((offset >> 32) as i32, (offset >> 17) as i32 & 0x7fff);
            Self { halves: Halves { high, low, whole, rest } }
        }
    }

    /// The value at a vertex, whose coordinates [`lifted`] has prepared.
    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3]) -> i32 {
        #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
        {
            let sum = |sum: i64, (&c, v): (&i32, i32)| sum.wrapping_add(i64::from(c) * i64::from(v));
            (self.row.iter().zip(v).fold(self.offset, sum) >> 32) as i32
        }
        #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
        {
            let Halves { high, low, whole, rest } = &self.halves;
            let dot = |start: i32, row: &[i32; 3]| {
                row.iter().zip(v).fold(start, |sum, (c, v)| sum.wrapping_add(c.wrapping_mul(v)))
            };
            dot(*whole, high).wrapping_add(dot(*rest, low) >> 15)
        }
    }
}

/// Prepares coordinates: where the multiplier gives 64 bits, they go to the top of 32, so that the form is the high word.
#[inline(always)]
pub(crate) fn lifted(v: [i16; 3]) -> [i32; 3] {
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    return v.map(|c| i32::from(c) << 16);
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    return v.map(i32::from);
}
