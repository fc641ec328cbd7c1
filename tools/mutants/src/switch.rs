//! Part of the library while mutants are in it: says which mutant is active in this process.

extern crate std;

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
use std::io::Write;

/// The active mutant, or one of the two numbers below, which no mutant has.
static ACTIVE: AtomicU32 = AtomicU32::new(UNREAD);
const UNREAD: u32 = u32::MAX;
/// No mutant is active, and the numbers of those reached are written to a file.
const RECORDING: u32 = u32::MAX - 1;
static REACHED: [AtomicBool; 1 << 14] = [const { AtomicBool::new(false) }; 1 << 14];

/// Whether mutant `number` is active, which the environment's `MUTANT` says; none is while the compiler computes a constant.
pub(crate) const fn mutant(number: u32) -> bool {
    const fn compiling(_: u32) -> bool {
        false
    }
    core::intrinsics::const_eval_select((number,), compiling, is_active)
}

#[inline]
fn is_active(number: u32) -> bool {
    let active = ACTIVE.load(Relaxed);
    active == number || (active >= RECORDING && look_up(number))
}

#[cold]
fn look_up(number: u32) -> bool {
    if ACTIVE.load(Relaxed) == UNREAD {
        let named = std::env::var("MUTANT").map(|name| name.parse().expect("MUTANT is a number"));
        ACTIVE.store(named.unwrap_or(RECORDING), Relaxed);
    }
    let active = ACTIVE.load(Relaxed);
    if active == RECORDING && !REACHED[number as usize].swap(true, Relaxed) {
        if let Some(path) = std::env::var_os("MUTANTS_REACHED") {
            let mut file = std::fs::OpenOptions::new().create(true).append(true).open(path).expect("MUTANTS_REACHED");
            file.write_all(std::format!("{number}\n").as_bytes()).expect("MUTANTS_REACHED");
        }
    }
    active == number
}
