//! Prints lines `design,instructions,checksum` of the vertex loop over the torus.
#![cfg_attr(target_os = "none", no_std, no_main)]

use designs::count::count;
#[cfg(target_os = "none")]
use semihosting::println;

fn run() -> i32 {
    let good = count(&mut |c| println!("{},{},{:08x}", c.id, c.instructions, c.checksum));
    i32::from(good.is_none())
}

#[cfg(all(target_arch = "arm", target_os = "none"))]
#[cortex_m_rt::entry]
fn main() -> ! {
    semihosting::process::exit(run())
}

#[cfg(all(target_arch = "riscv32", target_os = "none"))]
#[riscv_rt::entry]
fn main() -> ! {
    semihosting::process::exit(run())
}

#[cfg(not(target_os = "none"))]
fn main() {
    std::process::exit(run());
}
