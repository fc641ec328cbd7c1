//! A show on an SPI display: firmware for an emulated board with an SSD0323 OLED, and the program that takes its pictures.
//!
//! ```text
//! cargo run --release --features qemu --example oled --target thumbv7m-none-eabi
//! ```
//!
//! runs the firmware under QEMU and writes what its display shows to `target/oled`. Without `--target` the host draws the
//! same pictures and makes `docs/oled.png` of them. `tests/device` compares the two, pixel by pixel.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(all(unix, not(target_os = "none")))]
mod emulator;
#[cfg(target_os = "none")]
mod firmware;
#[cfg(not(target_os = "none"))]
mod host;
#[cfg(target_os = "none")]
mod panel;
#[cfg(not(target_os = "none"))]
mod picture;
mod show;

#[cfg(not(target_os = "none"))]
fn main() -> std::process::ExitCode {
    pinhole_apps_support::command::run(host::run)
}
