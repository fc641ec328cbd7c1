//! The emulated boards: a clock that counts instructions, and the end of the program. On the host the clock stands still.

#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "arm.rs"]
mod counter;
#[cfg(not(target_os = "none"))]
#[path = "host.rs"]
mod counter;
#[cfg(all(target_arch = "riscv32", target_os = "none"))]
#[path = "riscv.rs"]
mod counter;
#[cfg(target_os = "none")]
mod exit;

#[cfg(not(target_os = "none"))]
pub use counter::end;
#[cfg(target_os = "none")]
pub use exit::{end, end_with_stack};
#[cfg(target_os = "none")]
pub use semihosting::println;
#[cfg(not(target_os = "none"))]
pub use std::println;

/// Counts instructions, exactly.
pub struct Clock {
    counter: counter::Counter,
    /// The cost of starting and stopping the clock.
    own: u32,
}

impl Clock {
    /// `None` if the emulator's clock is not the expected one: a loop of known length tells.
    pub fn new() -> Option<Self> {
        let mut clock = Self { counter: counter::Counter::new()?, own: 0 };
        clock.own = clock.count(&mut || ())?;
        let (short, long) = (clock.turns(100)?, clock.turns(50_100)?);
        (long.abs_diff(short) == 50_000 * counter::TURN).then_some(clock)
    }

    /// Counts a loop of `count` turns; the other instructions do not depend on `count`.
    #[inline(never)]
    fn turns(&mut self, count: u32) -> Option<u32> {
        self.count(&mut || counter::turns(count))
    }

    /// The instructions that `work` takes; `None` beyond what the counter holds, two thousand million at least.
    #[inline(never)]
    pub fn count(&mut self, work: &mut dyn FnMut()) -> Option<u32> {
        self.counter.start();
        work();
        Some(self.counter.instructions()?.saturating_sub(self.own))
    }
}
