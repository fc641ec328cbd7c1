//! Firmware that logs by defmt, over semihosting: every frame with its statistics, and dropped frames with the
//! reason. In this folder,
//!
//! ```text
//! ../../tools/cross cargo run --release --target thumbv7m-none-eabi
//! ```
//!
//! runs it under QEMU and prints what defmt sends: numbers instead of words, for `defmt-print -e ELF` to read (`cargo install
//! defmt-print`). `cargo test` does all that, and holds the lines against the host's statistics of the same frames;
//! `cargo run` prints them without a device.
//!
//! **The linker script.** defmt needs `-Tdefmt.x` beside cortex-m-rt's `-Tlink.x`, and firmware without defmt must not have
//! it. `build.rs` adds it for this package alone; `-Tlink.x` comes from the repository's `.cargo/config.toml`. A project
//! outside this repository passes both.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod film;
#[cfg(target_os = "none")]
mod types;

use film::{Film, FRAMES};

#[cfg(not(target_os = "none"))]
fn main() {
    let mut film = Film::new();
    for number in 0..FRAMES {
        match film.draw(number) {
            Ok((statistics, bands)) => println!("INFO frame {number} in {bands} bands: {statistics:?}"),
            Err(error) => println!("WARN frame {number} dropped: {error:?}"),
        }
    }
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use defmt_semihosting as _;

    types::log();
    let film = cortex_m::singleton!(: Film = Film::new()).expect("the only one");
    for number in 0..FRAMES {
        match film.draw(number) {
            Ok((statistics, bands)) => defmt::info!("frame {} in {} bands: {}", number, bands, statistics),
            Err(error) => defmt::warn!("frame {} dropped: {}", number, error),
        }
    }
    semihosting::process::exit(0)
}
