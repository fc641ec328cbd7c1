//! Whole set-ups from arbitrary bytes. What is refused is refused for a reason that holds, by the documentation and exact integers;
//! what is accepted agrees with the f64 oracles within the documented bound.
//!
//! `tools/nopanic` proves that nothing here can panic. Parts of a set-up by themselves, such as matrices, quaternions and inverses, are
//! compared with the oracles by the tests of the library (`bounds`, `camera`, `hard_cases`).

mod camera;
mod projections;
pub(super) mod views;

use super::Bytes;

pub(super) fn check(data: &[u8]) {
    let mut b = Bytes::new(data);
    match b.byte() {
        0..=31 => views::check(&mut b),
        32..=79 => projections::check(&mut b),
        _ => camera::check(&mut b),
    }
}
