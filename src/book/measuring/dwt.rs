//! A count of the core's clock cycles, to time a frame: 32 bits that wrap, which differences survive. By the unit DWT of a
//! Cortex-M3, M4, M7 or M33.

use cortex_m::peripheral::{DCB, DWT};

pub struct Clock;

impl Clock {
    /// `None` if the chip's maker has left the counter out.
    pub fn start(debug: &mut DCB, unit: &mut DWT) -> Option<Self> {
        debug.enable_trace(); // also without a debugger
        unit.enable_cycle_counter();
        DWT::has_cycle_counter().then_some(Self)
    }

    pub fn cycles(&self) -> u32 {
        DWT::cycle_count()
    }
}
