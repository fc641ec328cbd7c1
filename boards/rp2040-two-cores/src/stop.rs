//! What the firmware does when it cannot go on. Neither way formats text: messages of `unwrap`, `expect` and panics would link
//! `core::fmt`, several kilobytes.

/// Logs the problem, and waits for a reset.
pub fn stop(problem: &'static str) -> ! {
    defmt::error!("{=str}", problem);
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
