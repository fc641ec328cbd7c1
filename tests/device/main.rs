//! Firmware draws the same pictures as the host, on every core, and links no float routine.
//!
//! Builds `examples/oled` and `examples/hello.rs` for five targets by `tools/cross` and runs them under QEMU: the first on
//! an emulated board with a display, whose picture is taken after every frame; the second prints checksums. Without the
//! tools the tests say so and pass, except with `CI` set.
#![allow(clippy::duplicate_mod)] // both have the teapot

mod cross;
#[cfg(unix)]
#[path = "../../examples/oled/emulator.rs"]
mod emulator;
mod first;
mod floats;
mod hello;
#[cfg(unix)]
mod oled;
mod oled_driver;
#[path = "../../examples/oled/picture.rs"]
mod picture;
#[path = "../../examples/oled/show/mod.rs"]
mod show;
mod wire;

use cross::Firmware;

/// QEMU is spoken to over a Unix socket.
#[cfg(not(unix))]
#[test]
fn the_display_is_not_tested_on_this_host() {
    use std::io::Write;
    // Not by eprintln, which the test harness shows only when a test fails.
    write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: what the firmware's display shows\n").expect("stderr");
}

fn no_floats(target: &'static str) {
    let Some(firmware) = Firmware::for_target(target) else { return };
    for example in ["hello", "oled"] {
        assert_eq!(firmware.float_routines(example), [""; 0], "{example}");
    }
}

// The other targets have an FPU, or their own names for routines: their absence would say nothing.
#[test]
fn thumbv6m_links_no_float_routine() {
    no_floats("thumbv6m-none-eabi");
}

#[test]
fn thumbv7m_links_no_float_routine() {
    no_floats("thumbv7m-none-eabi");
}
