//! RISC-V counts the instructions itself.

use core::arch::asm;
use riscv::register::minstret;

pub(super) struct Counter {
    from: u32,
}

impl Counter {
    pub(super) fn new() -> Option<Self> {
        Some(Self { from: 0 })
    }

    #[inline(always)]
    pub(super) fn start(&mut self) {
        self.from = minstret::read() as u32;
    }

    /// Less than 2³².
    #[inline(always)]
    pub(super) fn instructions(&mut self) -> Option<u32> {
        Some((minstret::read() as u32).wrapping_sub(self.from))
    }
}

/// Instructions of a turn of [`turns`].
pub(super) const TURN: u32 = 2;

/// A loop of known length.
pub(super) fn turns(count: u32) {
    // SAFETY: it changes the register that it is given, and nothing else.
    unsafe {
        asm!("2:", "addi {0}, {0}, -1", "bnez {0}, 2b", inout(reg) count + 1 => _, options(nomem, nostack));
    }
}
