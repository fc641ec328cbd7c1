//! mps2-an385 and its like: a timer of 25 MHz. Under `-icount shift=6` an instruction takes 64 ns, so 5/8 instructions pass
//! in a tick.

use core::ptr::{with_exposed_provenance, with_exposed_provenance_mut};

/// Timer 0 of the board (Arm, *Cortex-M System Design Kit*, chapter 4, "APB timer"): 32 bits, counting down.
const CONTROL: usize = 0x4000_0000;
const VALUE: usize = 0x4000_0004;
const RELOAD: usize = 0x4000_0008;

pub(super) struct Counter(());

impl Counter {
    pub(super) fn new() -> Option<Self> {
        cortex_m::Peripherals::take()?; // the only one
        write(RELOAD, u32::MAX);
        write(CONTROL, 1);
        Some(Self(()))
    }

    /// A tick begins here.
    #[inline(always)]
    pub(super) fn start(&mut self) {
        write(VALUE, u32::MAX);
    }

    /// A part of the last tick is missing, less than an instruction. A full round of the timer, 2 684 354 559 instructions, looks
    /// like nothing.
    #[inline(always)]
    pub(super) fn instructions(&mut self) -> Option<u32> {
        // SAFETY: a register of the board on which this runs; reading changes nothing.
        let value = unsafe { with_exposed_provenance::<u32>(VALUE).read_volatile() };
        u32::try_from((u64::from(u32::MAX - value) * 5).div_ceil(8)).ok()
    }
}

#[inline(always)]
fn write(register: usize, value: u32) {
    // SAFETY: the registers above, of which no one else knows.
    unsafe { with_exposed_provenance_mut::<u32>(register).write_volatile(value) };
}

/// Instructions of a turn of [`turns`].
pub(super) const TURN: u32 = 2;

/// A loop of known length.
pub(super) fn turns(count: u32) {
    // Subtract, branch. On cores that can issue both at once it says so and makes up for it.
    cortex_m::asm::delay(count);
}
