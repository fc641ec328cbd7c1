//! Your model turns on an ST7789, by embassy: it is drawn into one strip while DMA sends the other. A rotary encoder turns it too, a press
//! stops it, and nothing is sent while nothing changes. Each frame logs its time, the bytes sent and what was drawn. What depends on the
//! chip and its pins is here and in `chip.rs`.
#![no_std]
#![no_main]

#[path = "../../common/rp/src/chip.rs"]
mod chip;
#[path = "../../common/embassy/src/executors.rs"]
mod executors;
#[path = "../../common/embassy/src/input.rs"]
mod input;
#[path = "../../common/all/src/panel.rs"]
mod panel;
#[path = "../../common/embassy/src/picture.rs"]
mod picture;
#[path = "../../common/st7789/src/registers.rs"]
mod registers;
#[path = "../../common/all/src/stack.rs"]
mod stack;
#[path = "../../common/all/src/stop.rs"]
mod stop;
#[path = "../../common/embassy/src/tasks.rs"]
mod tasks;

use defmt_rtt as _; // logs go through the probe; without one they are dropped
use embassy_rp::config::Config;

#[cortex_m_rt::entry]
fn main() -> ! {
    executors::run()
}

/// 150 MHz.
fn config() -> Config {
    Config::default()
}
