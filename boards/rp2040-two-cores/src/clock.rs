//! A count of the core's clock cycles, to time a frame: 32 bits that wrap, which differences survive. By SysTick, which every
//! Cortex-M has: it counts 24 bits down, and its exception counts how often it has started again.

use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use cortex_m::peripheral::{syst::SystClkSource, SYST};

const LAST: u32 = (1 << 24) - 1;
static ROUNDS: AtomicU32 = AtomicU32::new(0);

pub struct Clock;

impl Clock {
    pub fn start(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(LAST);
        timer.clear_current();
        timer.enable_interrupt();
        timer.enable_counter();
        Self
    }

    pub fn cycles(&self) -> u32 {
        loop {
            let rounds = ROUNDS.load(Relaxed);
            let left = SYST::get_current();
            // Otherwise a round began in between.
            if ROUNDS.load(Relaxed) == rounds {
                return (rounds << 24) | (LAST - left); // `left` has 24 bits
            }
        }
    }
}

#[cortex_m_rt::exception]
fn SysTick() {
    // The only writer; a Cortex-M0 has no other atomic operation than load and store.
    ROUNDS.store(ROUNDS.load(Relaxed).wrapping_add(1), Relaxed);
}
