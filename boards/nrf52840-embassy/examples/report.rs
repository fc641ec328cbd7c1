//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use defmt_rtt as _;
use pinhole_bench::log_report;

#[cortex_m_rt::entry]
fn main() -> ! {
    embassy_nrf::init(embassy_nrf::config::Config::default());
    log_report!("nRF52840, code in flash", "M4", 64)
}
