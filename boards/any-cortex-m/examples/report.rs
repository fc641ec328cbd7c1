//! Draws six scenes into memory and logs a report, which `cargo run -p pinhole-report` in pinhole's repository reads: see
//! `docs/hardware.md` there. No display is needed. Yours to change: the three constants, and what sets your chip's clock.
#![no_std]
#![no_main]

use defmt_rtt as _;
use pinhole_bench::log_report;

const CHIP: &str = "my chip, code in flash";
/// M0, M0+, M3, M4, M33 or RV32.
const CORE: &str = "M4";
const MEGAHERTZ: u32 = 16;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    log_report!(CHIP, CORE, MEGAHERTZ)
}
