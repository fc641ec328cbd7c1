//! Assembles `boot.s`, with the compiler that the firmware is built with.
#![no_std]
#![no_main]

core::arch::global_asm!(include_str!("../boot.s"), options(raw));

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
