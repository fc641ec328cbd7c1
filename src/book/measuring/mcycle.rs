//! A count of the core's clock cycles, to time a frame: the counter `mcycle`, whose 32 low bits wrap, which differences survive.

pub struct Clock;

impl Clock {
    pub fn start() -> Self {
        Self
    }

    pub fn cycles(&self) -> u32 {
        riscv::register::mcycle::read() as u32
    }
}
