//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

#[path = "../src/clocks.rs"]
mod clocks;

use defmt_rtt as _;
use pinhole_bench::log_report;

#[cortex_m_rt::entry]
fn main() -> ! {
    embassy_stm32::init(clocks::config());
    log_report!("STM32F411xE", "M4", 100)
}
