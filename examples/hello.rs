//! The teapot on a microcontroller: draws the frames of `show` and prints a checksum of each.
//!
//! `cargo run --release --features qemu --example hello --target thumbv7m-none-eabi` runs it under QEMU;
//! without `--target` it prints the same lines on the host. `tests/device.rs` compares them.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod show;

use show::{Stage, FRAMES};

fn run(stage: &mut Stage) {
    #[cfg(target_os = "none")]
    use semihosting::println;
    for frame in 0..FRAMES {
        println!("{}", stage.draw(frame));
    }
}

#[cfg(not(target_os = "none"))]
fn main() {
    run(&mut Stage::new());
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use core::cell::RefCell;
    use cortex_m::interrupt::{free, Mutex};

    // Not on the stack: the linker says so if it does not fit, and what is left of the 64 K is the stack.
    static STAGE: Mutex<RefCell<Stage>> = Mutex::new(RefCell::new(Stage::new()));
    free(|token| run(&mut STAGE.borrow(token).borrow_mut()));
    semihosting::process::exit(0)
}
