//! What the firmware does when it cannot go on. Neither way formats text: messages of `unwrap`, `expect` and panics would link
//! `core::fmt`, several kilobytes.

/// Rounds of 3 cycles before the reset, in which a probe reads the log: 0.19 s.
const DELAY: u32 = 8_000_000;

/// Logs the problem, and resets the chip with all of its cores.
pub fn stop(problem: &'static str) -> ! {
    defmt::error!("{=str}", problem);
    cortex_m::asm::delay(DELAY);
    rp2040_hal::reset()
}

/// Logs where a panic happened. pinhole itself does not panic.
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{=u32}", place.file(), place.line());
    }
    stop("panic")
}
