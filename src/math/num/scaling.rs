//! Multiplication by powers of two, rounded to nearest.

use super::bits::min;

/// `v · 2^shift`, saturating to the left at ±(2⁶³ − 1), rounded to nearest (ties up) to the right.
#[inline(never)] // set-up: code size counts, speed does not
pub(crate) const fn scale(v: i64, shift: i32) -> i64 {
    if shift >= 0 {
        let room = v.unsigned_abs().leading_zeros() as i32 - 1; // zero bits of |v| below bit 63; 63 of them for 0
        let shift = min(shift, 63);
        if shift <= room {
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
