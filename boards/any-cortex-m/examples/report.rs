//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed. Yours to change: the three constants, and what sets your chip's clock.
#![no_std]
#![no_main]

#[cfg_attr(target_arch = "riscv32", path = "../../../src/book/measuring/mcycle.rs")]
#[cfg_attr(target_arch = "arm", path = "../../../src/book/measuring/systick.rs")]
mod clock;
#[path = "../src/stop.rs"]
mod stop;

use clock::Clock;
#[cfg(target_arch = "arm")]
use cortex_m::singleton;
use defmt_rtt as _;
use pinhole_bench::{log_report, report::Memory};
#[cfg(target_arch = "riscv32")]
use riscv::singleton;
use stop::stop;

const CHIP: &str = "my chip, code in flash";
/// M0, M0+, M3, M4, M33 or RV32.
const CORE: &str = "M4";
const MEGAHERTZ: u32 = 16;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let Some(memory) = singleton!(: Memory = Memory::NEW) else { stop("the memory is in use") };
    #[cfg(target_arch = "arm")]
    let Some(core) = cortex_m::Peripherals::take() else {
        stop("the core's peripherals are in use")
    };
    #[cfg(target_arch = "arm")]
    let clock = Clock::start(core.SYST);
    #[cfg(target_arch = "riscv32")]
    let clock = Clock::start();

    let drawn = log_report!(CHIP, CORE, MEGAHERTZ, memory, u32::MAX, clock.cycles());
    if drawn.is_none() {
        stop("a scene has no camera or no light");
    }
    loop {
        core::hint::spin_loop();
    }
}
