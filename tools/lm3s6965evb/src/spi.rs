//! SSI0 and the pins of the display on it.

use crate::register::Register;
use core::convert::Infallible;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, SpiBus};

/// SSI0: bytes, most significant bit first, mode 3.
pub struct Spi(());

/// Status: room to send, something received, busy.
const NOT_FULL: u32 = 1 << 1;
const RECEIVED: u32 = 1 << 2;
const BUSY: u32 = 1 << 4;

impl Spi {
    pub(crate) fn new() -> Self {
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
    pub(crate) fn new() -> Self {
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
