//! Integer arithmetic: a file for each kind of operation. Every shift and width has its bound beside it.

mod accumulator;
mod bits;
mod division;
mod product;
mod reciprocal;
mod saturating;
mod scaling;
mod square_root;

pub(crate) use super::cores::CORTEX_M0;
pub(crate) use accumulator::Accumulator;
pub(crate) use bits::{bits_of, leading_zeros, magnitude, max, min, shift_to_fit};
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) use division::divide_by_subtraction;
pub(crate) use division::{divide, divide_floor, divide_word, fraction, proper_fraction};
pub(crate) use product::{dot, mul_called, mul_high, mul_wide, row_times, transposed};
pub(crate) use reciprocal::{
    reciprocal, reciprocal_called, reciprocal_of_large, reciprocal_of_positive, Reciprocal,
};
pub(crate) use saturating::{add, evaluate, mul_translation, SATURATED};
pub(crate) use scaling::{scale, scale_long_to_word, scale_to_word, scale_word};
pub(crate) use square_root::{sqrt, sqrt_word};

#[cfg(test)]
/// `n · 2^exponent`, rounded to nearest (ties up).
fn scaled(n: i128, exponent: i32) -> i128 {
    match exponent {
        0.. => n << exponent,
        _ => (n + (1 << (-exponent - 1))) >> -exponent,
    }
}
