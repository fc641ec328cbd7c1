//! Unit quaternions.

use super::num::{scale, shift_to_fit, sqrt};
use super::unit::unit_component;

/// The unit quaternion with these components, in 2⁻³⁰, each within 2.5·2⁻³⁰; `None` if all are zero.
pub(crate) fn unit(parts: [i64; 4]) -> Option<[i32; 4]> {
    let largest = parts.iter().map(|c| c.unsigned_abs()).max().filter(|&largest| largest != 0)?;
    // To 30 bits, so that four squares stay below 2⁶³.
    let parts = parts.map(|c| scale(c, -shift_to_fit(largest, 30)));
    let square = parts.iter().map(|c| c.unsigned_abs().pow(2)).sum();
    let length = sqrt(square); // 2²⁹ … 2³¹
    Some(parts.map(|c| unit_component(c as i32, length))) // 30 bits, or 2³⁰
}
