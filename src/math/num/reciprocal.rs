//! The reciprocal, from a table and a series.

use super::bits::{normalised, normalised_near_2_30};

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

/// The reciprocal of a positive integer v: `1/v ≈ mantissa · 2^(shift − 61)`, with the error of the function that made it.
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

/// [`reciprocal`] for `v ≥ 1`.
#[inline(always)]
pub(crate) fn reciprocal_of_positive(v: i32) -> Reciprocal {
    reciprocal_of_normalised(normalised(v))
}

/// [`reciprocal_of_positive`] as a function, where code size matters more than speed.
#[inline(never)]
pub(crate) fn reciprocal_called(v: i32) -> Reciprocal {
    reciprocal_of_positive(v)
}

/// [`reciprocal`] for `v ≥ 1`; fastest for v near 2³⁰, the common case.
#[inline(always)]
pub(crate) fn reciprocal_of_large(v: i32) -> Reciprocal {
    reciprocal_of_normalised(normalised_near_2_30(v))
}

/// The reciprocal of m in 2⁻³⁰, 2³⁰ … 2³¹ − 1, with the shift that normalised it.
#[inline(always)]
pub(super) fn reciprocal_of_normalised((m, shift): (i32, u32)) -> Reciprocal {
    let index = (m >> 22) as usize & 0xff;
    // The mask keeps the index inside the table; `get` says so without a panic path.
    let r = 256 + i32::from(RECIPROCAL.get(index).copied().unwrap_or(0)); // in 2⁻⁹
    let e = m.wrapping_mul(r); // 2³⁹·(m·r − 1): |e| < 2³⁰·⁶, and 2³⁹ ≡ 0 mod 2³²
    let e1 = e >> 16; // in 2⁻²³, |e1| < 2¹⁵
    let e2 = e1 - ((e1 * e1) >> 23); // e − e², in 2⁻²³
    let s = (e - ((e1 * e2) >> 7)) >> 9; // e − e² + e³, in 2⁻³⁰, |s| < 2²²

    // |s·r| < 2³¹. The mantissa is one less, so that it stays below 2³¹ where v is a power of two.
    Reciprocal { mantissa: (r << 22) + !((s * r) >> 8), shift }
}
