//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use defmt_rtt as _;
use embassy_rp::{clocks::ClockConfig, config::Config};
use pinhole_bench::log_report;

#[cortex_m_rt::entry]
fn main() -> ! {
    let clocks = defmt::unwrap!(ClockConfig::system_freq(200_000_000).ok());
    embassy_rp::init(Config::new(clocks));
    log_report!("RP2040, code in flash", "M0+", 200)
}
