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

/// The end of a program on an emulated board.
#[cfg(target_os = "none")]
mod exit {
    use semihosting::sys::arm_compat::sys_writec;

    /// The emulator's exit code is that of the program.
    pub fn end(well: bool) -> ! {
        semihosting::process::exit(i32::from(!well))
    }

    /// Prints how deep the stack was since it was painted, in eight hexadecimal digits, and ends. Without the
    /// library's formatting: it would be in every image, and hide what one of them takes of it.
    #[inline(never)]
    pub fn end_with_stack(well: bool) -> ! {
        let deepest = crate::stack::deepest() as u32;
        for shift in (0..8).rev() {
            sys_writec(b"0123456789abcdef"[(deepest >> (4 * shift) & 15) as usize]);
        }
        sys_writec(b'\n');
        end(well)
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        if cfg!(feature = "emulated") {
            end(false)
        }
        loop {
            core::hint::spin_loop(); // a report, whose log says why
        }
    }
}
