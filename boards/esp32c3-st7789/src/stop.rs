//! What the firmware does when it cannot go on. Neither way formats text: messages of `unwrap`, `expect` and panics would link
//! `core::fmt`, several kilobytes.

use esp_hal::delay::Delay;

/// Logs the problem, and resets the chip after a time in which a probe reads the log.
pub fn stop(problem: &'static str) -> ! {
    defmt::error!("{=str}", problem);
    Delay::new().delay_millis(300);
    esp_hal::system::software_reset()
}

/// Logs where a panic happened. pinhole itself does not panic.
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{=u32}", place.file(), place.line());
    }
    stop("panic")
}
