//! A 32-bit counter of the core's clock cycles: the low word of `mcycle`. It wraps: subtract two readings by `wrapping_sub`.

pub struct Clock;

impl Clock {
    pub fn start() -> Self {
        Self
    }

    pub fn cycles(&self) -> u32 {
        riscv::register::mcycle::read() as u32
    }
}
