//! The teapot on a microcontroller: draws the frames of `show` and prints a checksum of each.
//!
//! `cargo run --release --features qemu --example hello --target thumbv7m-none-eabi` runs it under QEMU;
//! without `--target` it prints the same lines on the host. `tests/device` compares them.
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

/// Runs on a core, and ends the emulator.
#[cfg(target_os = "none")]
#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    use core::cell::RefCell;
    #[cfg(target_arch = "arm")]
    use cortex_m as _; // its critical sections
    use critical_section::Mutex;
    #[cfg(target_arch = "riscv32")]
    use riscv as _;

    // In a static, so that the linker reports if it does not fit. The rest of the 64 KB is the stack.
    static STAGE: Mutex<RefCell<Stage>> = Mutex::new(RefCell::new(Stage::new()));
    critical_section::with(|token| run(&mut STAGE.borrow_ref_mut(token)));
    semihosting::process::exit(0)
}
