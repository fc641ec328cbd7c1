//! Firmware that logs a value of each public type whose `defmt::Format` is written by hand, over semihosting. In this folder,
//!
//! ```text
//! ../../tools/cross cargo run --release --target thumbv7m-none-eabi
//! ```
//!
//! runs it under QEMU and prints what defmt sends: numbers instead of words, for `defmt-print -e ELF` to read (`cargo install
//! defmt-print`). `cargo test` does all that, and compares the lines with what is computed by hand.
//!
//! **The linker script.** defmt needs `-Tdefmt.x` beside cortex-m-rt's `-Tlink.x`, and firmware without defmt must not have
//! it. `build.rs` adds it for this package alone; `-Tlink.x` comes from the repository's `.cargo/config.toml`. A project
//! outside this repository passes both.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod types;

#[cfg(not(target_os = "none"))]
fn main() {
    println!("log: runs on a device: add --target thumbv7m-none-eabi");
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use cortex_m as _; // its critical sections
    use defmt_semihosting as _;

    types::log();
    semihosting::process::exit(0)
}
