//! UART0.

use crate::register::Register;
use core::fmt;

/// UART0, byte by byte; text by `write!`.
pub struct Serial(());

/// Flags: nothing received, no room to send.
const EMPTY: u32 = 1 << 4;
const FULL: u32 = 1 << 5;

impl Serial {
    pub(crate) fn new() -> Self {
        Register::UartLine.write(3 << 5); // 8 bits
        Register::UartControl.write(1 << 9 | 1 << 8 | 1); // receive, send, on
        Self(())
    }

    /// The next byte that is received; waits for it.
    pub fn read(&mut self) -> u8 {
        Register::UartFlags.until_clear(EMPTY);
        Register::UartData.read() as u8
    }

    /// Sends a byte as soon as there is room.
    pub fn write(&mut self, byte: u8) {
        Register::UartFlags.until_clear(FULL);
        Register::UartData.write(byte.into());
    }
}

impl fmt::Write for Serial {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.bytes().for_each(|byte| self.write(byte));
        Ok(())
    }
}
