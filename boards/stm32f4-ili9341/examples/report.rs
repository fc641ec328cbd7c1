//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use cortex_m::peripheral::{Peripherals as Core, DWT};
use defmt_rtt as _;
use pinhole_bench::log_report;
use stm32f4xx_hal::{pac::Peripherals, prelude::*, rcc::Config};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut core = defmt::unwrap!(Core::take());
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    let peripherals = defmt::unwrap!(Peripherals::take());
    peripherals.RCC.freeze(Config::hse(25.MHz()).sysclk(100.MHz()));
    log_report!("STM32F411xE", "M4", 100, u32::MAX, DWT::cycle_count())
}
