//! Normalised vectors, by block scaling: as accurate for tiny vectors as for huge ones.

use super::hints::opaque_next;
use super::num::{bits_of, fraction, mul_called, scale, shift_to_fit, sqrt};

/// Scales the three numbers by one power of two so that the largest has 31 bits: rounded to nearest, but
/// never beyond `i32`. Zero stays zero.
#[inline(never)] // set-up: code size counts
const fn block_scaled(v: &[i64; 3]) -> [i32; 3] {
    let shift = -shift_to_fit(bits_of(v), 31); // 0 may be shifted by any number
    let (mut scaled, mut i) = ([0; 3], 0);
    while i < 3 {
        scaled[i] = clamp_to_i32(scale(v[i], shift));
        i = opaque_next(i);
    }
    scaled
}

/// 2³¹ as the largest `i32`; all smaller numbers unchanged.
const fn clamp_to_i32(v: i64) -> i32 {
    (v - (v == 1 << 31) as i64) as i32
}

/// `v / |v|` in 2⁻³⁰, each component within 1.5·2⁻³⁰: ½ for each of its own block scaling, the
/// rounding of the length, and that of the quotient. Zero for the zero vector.
#[inline(never)] // set-up: code size counts
pub(crate) const fn normalise(v: &[i64; 3]) -> [i32; 3] {
    let [x, y, z] = block_scaled(v);
    let square = mul_called(x, x) as u64 + mul_called(y, y) as u64 + mul_called(z, z) as u64;
    let length = sqrt(square); // of ≤ 3·2⁶²: 2³⁰ … 2³¹·⁸, or 0
    [unit_component(x, length), unit_component(y, length), unit_component(z, length)]
}

/// Whether `unit` is zero, which [`normalise`] returns for the zero vector.
pub(crate) const fn is_zero(unit: &[i32; 3]) -> bool {
    unit[0] | unit[1] | unit[2] == 0
}

/// `c / length` in 2⁻³⁰, rounded to nearest: |c| ≤ length up to rounding, so 31 bits and a rounding bit,
/// ≤ 2³¹ before, ≤ 2³⁰ after. No length gives 0.
#[inline(never)] // set-up: code size counts
pub(crate) const fn unit_component(c: i32, length: u32) -> i32 {
    if length == 0 {
        return 0;
    }
    let q = (fraction(c.unsigned_abs() as u64, length as u64, 31) + 1) >> 1;
    let (q, sign) = (if q > 1 << 30 { 1 << 30 } else { q as i32 }, c >> 31);
    (q ^ sign) - sign
}

/// `a × b` up to a positive factor, from block-scaled factors: exact for components of 31 bits.
/// Zero where either is zero.
pub(crate) const fn cross(a: &[i64; 3], b: &[i64; 3]) -> [i64; 3] {
    cross_exact(&block_scaled(a), &block_scaled(b))
}

/// `a × b` for unit vectors in 2⁻³⁰, again in 2⁻³⁰: rounded to nearest.
#[inline(never)] // set-up: code size counts
pub(crate) const fn cross_units(a: &[i32; 3], b: &[i32; 3]) -> [i32; 3] {
    let [x, y, z] = cross_exact(a, b); // units: ≤ 2⁶¹ before, at most 2³⁰ after
    [scale(x, -30) as i32, scale(y, -30) as i32, scale(z, -30) as i32]
}

/// `a × b`: below 2⁶² for coefficients of at most 2³⁰, below 2⁶³ where no two are −2³¹ and 2³¹.
#[inline(never)] // set-up: code size counts
pub(crate) const fn cross_exact([a, b, c]: &[i32; 3], [x, y, z]: &[i32; 3]) -> [i64; 3] {
    const fn difference(a: i32, b: i32, c: i32, d: i32) -> i64 {
        mul_called(a, b) - mul_called(c, d)
    }
    [difference(*b, *z, *c, *y), difference(*c, *x, *a, *z), difference(*a, *y, *b, *x)]
}
