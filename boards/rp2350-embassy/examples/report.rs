//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use defmt_rtt as _;
use pinhole_bench::log_report;

#[cortex_m_rt::entry]
fn main() -> ! {
    embassy_rp::init(embassy_rp::config::Config::default());
    log_report!("RP2350, code in flash", "M33", 150)
}
