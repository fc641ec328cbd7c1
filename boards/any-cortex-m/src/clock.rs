//! A 32-bit counter of the core's clock cycles, by SysTick, which almost every Cortex-M has. The timer counts down 24 bits, and its
//! exception counts the times it starts again. The count wraps: subtract two readings by `wrapping_sub`.

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
            // If the number of rounds has changed, the timer started again between the two readings: read both again.
            if ROUNDS.load(Relaxed) == rounds {
                return (rounds << 24) | (LAST - left); // `left` has 24 bits
            }
        }
    }
}

#[cortex_m_rt::exception]
fn SysTick() {
    // Load and store suffice, as nothing else writes `ROUNDS`; a Cortex-M0 has no other atomic operation.
    ROUNDS.store(ROUNDS.load(Relaxed).wrapping_add(1), Relaxed);
}
