//! The emulated board: a clock that counts instructions, and the end of the program. On the host the clock stands still.

#[cfg(target_os = "none")]
pub use emulated::{end, end_with_stack, Clock};
#[cfg(not(target_os = "none"))]
pub use host::{end, Clock};
#[cfg(target_os = "none")]
pub use semihosting::println;
#[cfg(not(target_os = "none"))]
pub use std::println;

#[cfg(target_os = "none")]
mod emulated {
    use cortex_m::peripheral::{syst::SystClkSource, SYST};
    use semihosting::sys::arm_compat::sys_writec;

    /// SysTick, 25 MHz. Under `-icount shift=6` an instruction takes 64 ns, so 5/8 instructions pass in a tick.
    pub struct Clock {
        timer: SYST,
        /// What starting and stopping it costs.
        own: u32,
    }

    const RELOAD: u32 = 0x00ff_ffff;

    impl Clock {
        /// `None` if the emulator's clock is another one: a loop of known length tells.
        pub fn new() -> Option<Self> {
            let mut timer = cortex_m::Peripherals::take()?.SYST;
            timer.set_clock_source(SystClkSource::Core);
            timer.set_reload(RELOAD);
            timer.clear_current();
            timer.enable_counter();
            let mut clock = Self { timer, own: 0 };
            clock.own = clock.count(&mut || ())?;
            // Two instructions a turn.
            let short = clock.count(&mut || cortex_m::asm::delay(100))?;
            let long = clock.count(&mut || cortex_m::asm::delay(50_100))?;
            (long.abs_diff(short).abs_diff(100_000) <= 1).then_some(clock)
        }

        /// The instructions that `work` takes; `None` beyond ten million, where the timer has run round.
        #[inline(never)]
        pub fn count(&mut self, work: &mut dyn FnMut()) -> Option<u32> {
            self.timer.clear_current();
            while SYST::get_current() == 0 {}
            self.timer.has_wrapped(); // forget
            let from = SYST::get_current();
            work();
            let to = SYST::get_current();
            let ticks = from.wrapping_sub(to) & RELOAD;
            (!self.timer.has_wrapped()).then_some((ticks * 5 / 8).saturating_sub(self.own))
        }
    }

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
        end(false)
    }
}

#[cfg(not(target_os = "none"))]
mod host {
    pub struct Clock;

    impl Clock {
        pub fn new() -> Option<Self> {
            Some(Self)
        }

        pub fn count(&mut self, work: &mut dyn FnMut()) -> Option<u32> {
            work();
            Some(0)
        }
    }

    pub fn end(well: bool) -> ! {
        std::process::exit(i32::from(!well))
    }
}
