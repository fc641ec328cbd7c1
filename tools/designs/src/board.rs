//! The emulated board: a clock that counts instructions. On the host it stands still.

#[cfg(all(target_arch = "arm", target_os = "none"))]
pub use arm::Clock;
#[cfg(not(target_os = "none"))]
pub use host::Clock;
#[cfg(all(target_arch = "riscv32", target_os = "none"))]
pub use riscv32::Clock;

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod arm {
    use cortex_m::peripheral::{syst::SystClkSource, SYST};

    /// SysTick, 25 MHz. Under `-icount shift=6` an instruction takes 64 ns, so 5/8 instructions pass in a tick.
    pub struct Clock {
        timer: SYST,
        /// The ticks that starting and stopping take.
        own: u32,
    }

    const RELOAD: u32 = 0x00ff_ffff;

    impl Clock {
        /// `None` if the emulator's clock runs at another rate, which a loop of known length shows.
        pub fn new() -> Option<Self> {
            let mut timer = cortex_m::Peripherals::take()?.SYST;
            timer.set_clock_source(SystClkSource::Core);
            timer.set_reload(RELOAD);
            timer.clear_current();
            timer.enable_counter();
            let mut clock = Self { timer, own: 0 };
            clock.own = clock.count(&mut || ())?;
            // Two instructions for each turn of the loop.
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
}

#[cfg(all(target_arch = "riscv32", target_os = "none"))]
mod riscv32 {
    use riscv::register::minstret;

    /// The core's own counter of instructions, under `-icount shift=0`.
    pub struct Clock {
        /// The instructions that starting and stopping take.
        own: u32,
    }

    impl Clock {
        /// `None` if the counter counts something else, which loops of known lengths show.
        pub fn new() -> Option<Self> {
            let mut clock = Self { own: 0 };
            clock.own = clock.count(&mut || ())?;
            // Two instructions for each two cycles that are asked for.
            let short = clock.count(&mut || riscv::asm::delay(100))?;
            let long = clock.count(&mut || riscv::asm::delay(50_100))?;
            (long.abs_diff(short).abs_diff(50_000) <= 1).then_some(clock)
        }

        #[inline(never)]
        pub fn count(&mut self, work: &mut dyn FnMut()) -> Option<u32> {
            let from = minstret::read();
            work();
            let to = minstret::read();
            Some((to.wrapping_sub(from) as u32).saturating_sub(self.own))
        }
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
}
