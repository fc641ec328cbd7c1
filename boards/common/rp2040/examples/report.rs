//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

use defmt_rtt as _;
use pinhole_bench::log_report;
use rp2040_hal::{clocks::init_clocks_and_plls, pac::Peripherals, Watchdog};

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[rp2040_hal::entry]
fn main() -> ! {
    let mut p = defmt::unwrap!(Peripherals::take());
    let mut watchdog = Watchdog::new(p.WATCHDOG);
    let crystal = 12_000_000;
    let clocks =
        init_clocks_and_plls(crystal, p.XOSC, p.CLOCKS, p.PLL_SYS, p.PLL_USB, &mut p.RESETS, &mut watchdog);
    defmt::unwrap!(clocks.ok());
    log_report!("RP2040, code in flash", "M0+", 125)
}
