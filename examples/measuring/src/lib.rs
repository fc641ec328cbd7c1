//! The code of the book's chapter "Measuring on your board", compiled for the cores that it is for. CI builds it:
//!
//! ```text
//! tools/cross cargo build --package measuring --target thumbv6m-none-eabi --target thumbv7m-none-eabi …
//! ```
#![no_std]
#![cfg(target_os = "none")]

// Which cores have the unit DWT, the compiler does not say: an M0's target has no atomic exchange.
#[cfg(all(target_arch = "arm", target_has_atomic = "32"))]
#[path = "../../../src/book/measuring/dwt.rs"]
pub mod dwt;
#[path = "../../../src/book/measuring/log.rs"]
pub mod log;
#[cfg(target_arch = "riscv32")]
#[path = "../../../src/book/measuring/mcycle.rs"]
pub mod mcycle;
#[path = "../../../src/book/measuring/meter.rs"]
pub mod meter;
#[cfg(target_arch = "arm")]
#[path = "../../../src/book/measuring/systick.rs"]
pub mod systick;
