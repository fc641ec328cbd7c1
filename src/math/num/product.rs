//! Exact products of 32-bit numbers, and sums of three of them.

use crate::math::cores::CORTEX_M0;
use crate::math::halfword::{called_mul_wide, mul_wide_by_halves, row_times_by_halves};

/// `a · b`, exact.
#[inline(always)]
pub(crate) const fn mul_wide(a: i32, b: i32) -> i64 {
    if CORTEX_M0 {
        return mul_wide_by_halves(a, b);
    }
    a as i64 * b as i64
}

/// `a · b`, exact, for set-up: on a Cortex-M0 a call, so that code size does not grow with the number of products.
#[inline(always)]
pub(crate) const fn mul_called(a: i32, b: i32) -> i64 {
    if CORTEX_M0 {
        return called_mul_wide(a, b);
    }
    a as i64 * b as i64
}

/// `⌊a · b / 2³²⌋`.
#[inline(always)]
pub(crate) const fn mul_high(a: i32, b: i32) -> i32 {
    (mul_wide(a, b) >> 32) as i32 // |a·b| ≤ 2⁶²: the high word fits
}

/// `a · b`, exact in 64 bits for coefficients of at most 2³⁰: sums of three products, below 2⁶².
#[inline(never)] // set-up: code size counts
pub(crate) const fn dot(a: &[i32; 3], b: &[i32; 3]) -> i64 {
    let ([a, b, c], [x, y, z]) = (*a, *b);
    mul_called(a, x) + mul_called(b, y) + mul_called(c, z)
}

/// The transpose of a matrix.
pub(crate) const fn transposed([x, y, z]: &[[i32; 3]; 3]) -> [[i32; 3]; 3] {
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

/// Row `v` times matrix `m`, coefficients of at most 2³⁰: sums of three products, below 2⁶².
#[inline(never)] // set-up: code size counts
pub(crate) const fn row_times(v: &[i32; 3], m: &[[i32; 3]; 3]) -> [i64; 3] {
    if CORTEX_M0 {
        return row_times_by_halves(v, m);
    }
    let ([a, b, c], [x, y, z]) = (*v, m);
    let (a, b, c) = (a as i64, b as i64, c as i64);
    [
        a * x[0] as i64 + b * y[0] as i64 + c * z[0] as i64,
        a * x[1] as i64 + b * y[1] as i64 + c * z[1] as i64,
        a * x[2] as i64 + b * y[2] as i64 + c * z[2] as i64,
    ]
}
