//! The board lm3s6965evb, as qemu-system-arm emulates it: the SPI bus and the D/C pin of its display, a serial line, and how
//! deep its stack was.
//!
//! It knows what the emulator needs. Real silicon would also want its clock, its pins' other functions and a baud rate set.
#![no_std]

mod register;
/// How deep the stack was.
#[cfg(target_os = "none")]
pub mod stack;

use core::cell::Cell;
use core::convert::Infallible;
use core::fmt;
use critical_section::Mutex;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, SpiBus};
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

/// SSI0: bytes, most significant bit first, mode 3.
pub struct Spi(());

/// Status: room to send, something received, busy.
const NOT_FULL: u32 = 1 << 1;
const RECEIVED: u32 = 1 << 2;
const BUSY: u32 = 1 << 4;

impl Spi {
    fn new() -> Self {
        // The pin that selects the display, which is alone on the bus: high.
        Register::PortDDirection.set(1);
        Register::PortDDigital.set(1);
        Register::PortDPin0.write(1);
        Register::SsiControl1.write(0); // off, and the master
        Register::SsiPrescale.write(2);
        Register::SsiControl0.write(0xC7); // mode 3, 8 bits
        Register::SsiControl1.write(2); // on
        Self(())
    }

    fn exchange(&mut self, byte: u8) -> u8 {
        Register::SsiStatus.until_set(NOT_FULL);
        Register::SsiData.write(byte.into());
        Register::SsiStatus.until_set(RECEIVED);
        Register::SsiData.read() as u8
    }
}

impl spi::ErrorType for Spi {
    type Error = Infallible;
}

impl SpiBus for Spi {
    fn read(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        words.iter_mut().for_each(|word| *word = self.exchange(0));
        Ok(())
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        for &word in words {
            self.exchange(word);
        }
        Ok(())
    }

    fn transfer(&mut self, read: &mut [u8], write: &[u8]) -> Result<(), Infallible> {
        for i in 0..read.len().max(write.len()) {
            let received = self.exchange(write.get(i).copied().unwrap_or(0));
            if let Some(word) = read.get_mut(i) {
                *word = received;
            }
        }
        Ok(())
    }

    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        words.iter_mut().for_each(|word| *word = self.exchange(*word));
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Register::SsiStatus.until_clear(BUSY);
        Ok(())
    }
}

/// Pin 7 of port C: the display's D/C line.
pub struct DataCommand(());

impl DataCommand {
    fn new() -> Self {
        Register::PortCDirection.set(1 << 7);
        Register::PortCDigital.set(1 << 7);
        Self(())
    }
}

impl digital::ErrorType for DataCommand {
    type Error = Infallible;
}

impl OutputPin for DataCommand {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Register::PortCPin7.write(0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Register::PortCPin7.write(1 << 7);
        Ok(())
    }
}

/// UART0, byte by byte; text by `write!`.
pub struct Serial(());

/// Flags: nothing received, no room to send.
const EMPTY: u32 = 1 << 4;
const FULL: u32 = 1 << 5;

impl Serial {
    fn new() -> Self {
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
