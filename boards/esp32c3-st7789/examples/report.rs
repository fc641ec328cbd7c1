//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use defmt_rtt as _;
use esp_hal::{clock::CpuClock, time::Instant, Config};
use pinhole_bench::log_report;

// What the boot loader wants to know of the image.
#[allow(unsafe_code)]
mod description {
    esp_bootloader_esp_idf::esp_app_desc!();
}

const MEGAHERTZ: u32 = 160;

#[esp_hal::main]
fn main() -> ! {
    esp_hal::init(Config::default().with_cpu_clock(CpuClock::max()));
    log_report!("ESP32-C3, code in flash", "RV32", MEGAHERTZ, u32::MAX, cycles())
}

/// By the timer of the system, which counts microseconds: the core has no `mcycle`. It wraps.
fn cycles() -> u32 {
    (Instant::now().duration_since_epoch().as_micros() as u32).wrapping_mul(MEGAHERTZ)
}
