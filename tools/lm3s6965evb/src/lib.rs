//! The board lm3s6965evb, as qemu-system-arm emulates it: the SPI bus and the D/C pin of its display, a serial line, and how
//! deep its stack was.
//!
//! It knows what the emulator needs. Real silicon would also want its clock, its pins' other functions and a baud rate set.
#![no_std]

mod register;
mod serial;
mod spi;
/// How deep the stack was.
#[cfg(target_os = "none")]
pub mod stack;

pub use serial::Serial;
pub use spi::{DataCommand, Spi};

use core::cell::Cell;
use critical_section::Mutex;
use register::Register;

/// The peripherals of the board, one of each.
pub struct Board {
    /// The bus that the display is alone on, selected.
    pub spi: Spi,
    /// The display's D/C line: high for data.
    pub data_command: DataCommand,
    /// UART0.
    pub serial: Serial,
}

impl Board {
    /// Sets the board up. `None` when it was taken before, and on a host. (It cannot tell this microcontroller from
    /// another one.)
    pub fn take() -> Option<Self> {
        static TAKEN: Mutex<Cell<bool>> = Mutex::new(Cell::new(false));
        let here = cfg!(all(target_arch = "arm", target_os = "none"));
        if !here || critical_section::with(|token| TAKEN.borrow(token).replace(true)) {
            return None;
        }
        Register::RunClock1.set(1 << 4 | 1 << 0); // SSI0, UART0
        Register::RunClock2.set(1 << 3 | 1 << 2 | 1 << 0); // ports D, C, A
        Some(Self { spi: Spi::new(), data_command: DataCommand::new(), serial: Serial::new() })
    }
}
