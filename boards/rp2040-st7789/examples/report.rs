//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed.
#![no_std]
#![no_main]

#[path = "../../common/rp2040/src/stop.rs"]
mod stop;

use cortex_m::peripheral::{syst::SystClkSource, SYST};
use cortex_m::singleton;
use defmt_rtt as _;
use pinhole_bench::{log_report, report::Memory};
use rp2040_hal as hal;
use rp2040_hal::{pac, Watchdog};
use stop::stop;

/// The second stage of booting, for the flash on a Pico.
#[allow(unsafe_code)]
#[link_section = ".boot2"]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Of the crystal.
const CRYSTAL: u32 = 12_000_000;
/// The timer of the core counts down from it.
const LAST: u32 = (1 << 24) - 1;

#[hal::entry]
fn main() -> ! {
    let Some(memory) = singleton!(: Memory = Memory::NEW) else { stop("the memory is in use") };
    let (Some(mut p), Some(core)) = (pac::Peripherals::take(), pac::CorePeripherals::take()) else {
        stop("the peripherals are in use")
    };
    let mut watchdog = Watchdog::new(p.WATCHDOG);
    let resets = &mut p.RESETS;
    let clocks = hal::clocks::init_clocks_and_plls(
        CRYSTAL,
        p.XOSC,
        p.CLOCKS,
        p.PLL_SYS,
        p.PLL_USB,
        resets,
        &mut watchdog,
    );
    if clocks.is_err() {
        stop("the clocks do not start");
    }
    let mut timer = core.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(LAST);
    timer.clear_current();
    timer.enable_counter();

    let drawn = log_report!("RP2040, code in flash", "M0+", 125, memory, LAST, LAST - SYST::get_current());
    if drawn.is_none() {
        stop("a scene has no camera or no light");
    }
    loop {
        core::hint::spin_loop();
    }
}
