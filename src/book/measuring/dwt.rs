//! A 32-bit counter of the core's clock cycles, by the DWT unit of a Cortex-M3, M4, M7 or M33. It wraps: subtract two readings
//! by `wrapping_sub`.

use cortex_m::peripheral::{DCB, DWT};

pub struct Clock;

impl Clock {
    /// Starts the counter; `None` on a chip without one.
    pub fn start(debug: &mut DCB, unit: &mut DWT) -> Option<Self> {
        debug.enable_trace(); // also without a debugger
        unit.enable_cycle_counter();
        DWT::has_cycle_counter().then_some(Self)
    }

    pub fn cycles(&self) -> u32 {
        DWT::cycle_count()
    }
}
