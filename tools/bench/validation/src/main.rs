//! Elliptic-curve operations on P-256, each counted once; prints their instructions. Only for an M4: its instructions are.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod p256;

#[cfg(target_os = "none")]
bench::firmware!({
    let mut clock = bench::board::Clock::new()?;
    p256::count(&mut clock)
});

#[cfg(not(target_os = "none"))]
fn main() {}
