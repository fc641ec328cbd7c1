//! What every image has, too: a start and a display. The others are measured against it.
#![no_std]
#![no_main]

use core::hint::black_box;
use linked as _;

/// Where it starts.
#[allow(unsafe_code)] // a name that the linker knows
#[no_mangle]
extern "C" fn Reset() -> ! {
    loop {
        black_box(());
    }
}
