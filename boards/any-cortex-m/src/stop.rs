//! What the firmware does when it cannot go on. Neither way formats text: messages of `unwrap`, `expect` and panics would link
//! `core::fmt`, several kilobytes.

/// Rounds of some 3 cycles before the reset, in which a probe reads the log: 0.24 s at 100 MHz.
#[cfg(target_arch = "arm")]
const DELAY: u32 = 8_000_000;

/// Logs the problem, and resets the chip.
pub fn stop(problem: &'static str) -> ! {
    defmt::error!("{=str}", problem);
    #[cfg(target_arch = "arm")]
    {
        cortex_m::asm::delay(DELAY);
        cortex_m::peripheral::SCB::sys_reset()
    }
    // RISC-V has no reset of its own: put your chip's here, after a time in which a probe reads the log. Until then it is left to the
    // watchdog, which is fed no more.
    #[cfg(target_arch = "riscv32")]
    loop {
        core::hint::spin_loop();
    }
}

/// Logs where a panic happened. pinhole itself does not panic.
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{=u32}", place.file(), place.line());
    }
    stop("panic")
}
