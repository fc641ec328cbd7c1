//! A panel whose controller has the commands of MIPI DCS, as most have, at the end of a bus that can fail.

use crate::registers::{OFFSET, REGISTERS};
use core::convert::Infallible;
use embedded_graphics_core::primitives::Rectangle;
use embedded_hal::{delay::DelayNs, digital::OutputPin};

const SLEEP_OUT: u8 = 0x11;
const COLUMNS: u8 = 0x2a;
const ROWS: u8 = 0x2b;
const WRITE_MEMORY: u8 = 0x2c;
/// From a reset, or from [`Panel::refresh`], to the next refresh at the earliest, in ms: the data sheets ask for 120.
const SLEEP: u32 = 121;
/// How long nothing may be sent after a refresh, in ms: the data sheets ask for 5.
pub const WAKING: u32 = 6;

/// Why something has not reached the panel.
pub type Problem = &'static str;

/// What the panel is connected by. It does not wait for ever: it gives up.
pub trait Bus {
    /// Sends the bytes of a command, and returns when the last bit is sent.
    fn write(&mut self, bytes: &[u8]) -> Result<(), Problem>;
    /// Waits for the pixels that DMA sends, if it does.
    fn finish(&mut self) -> Result<(), Problem>;
}

/// The bus, and pins: `select` is low while the panel is addressed, `command` while commands are sent, and `reset`
/// while the panel is reset.
pub struct Panel<B, Pin> {
    pub bus: B,
    pub select: Pin,
    pub command: Pin,
    pub reset: Pin,
}

impl<B: Bus, Pin: OutputPin<Error = Infallible>> Panel<B, Pin> {
    /// Resets the panel and sets it up: at the start, and after an error of the bus.
    pub fn start(&mut self, delay: &mut impl DelayNs) -> Result<(), Problem> {
        self.finish().or_else(|_| self.finish())?; // pixels on their way are given up
        let Ok(()) = self.reset.set_low();
        delay.delay_us(20);
        let Ok(()) = self.reset.set_high();
        delay.delay_ms(SLEEP);
        self.refresh()?;
        delay.delay_ms(SLEEP);
        Ok(())
    }

    /// Writes the registers, which nobody sees unless the panel had lost its state.
    pub fn refresh(&mut self) -> Result<(), Problem> {
        for (command, parameters) in REGISTERS {
            self.command(command, parameters)?;
        }
        self.command(SLEEP_OUT, &[])
    }

    /// Opens a window, and returns the bus for its pixels.
    pub fn window(&mut self, area: &Rectangle) -> Result<&mut B, Problem> {
        let (first, last) = (area.top_left + OFFSET, area.bottom_right().unwrap_or(area.top_left) + OFFSET);
        for (command, first, last) in [(COLUMNS, first.x, last.x), (ROWS, first.y, last.y)] {
            let [[a, b], [c, d]] = [first, last].map(|border| (border as u16).to_be_bytes()); // on the display
            self.command(command, &[a, b, c, d])?;
        }
        self.command(WRITE_MEMORY, &[])?;
        let Ok(()) = self.select.set_low();
        Ok(&mut self.bus)
    }

    /// Waits for the last pixel of a window.
    pub fn finish(&mut self) -> Result<(), Problem> {
        self.bus.finish()?;
        let Ok(()) = self.select.set_high();
        Ok(())
    }

    #[inline(never)] // or each of its eight callers gets a copy
    fn command(&mut self, command: u8, parameters: &[u8]) -> Result<(), Problem> {
        self.finish()?;
        let (Ok(()), Ok(())) = (self.command.set_low(), self.select.set_low());
        self.bus.write(&[command])?;
        let Ok(()) = self.command.set_high();
        self.bus.write(parameters)?;
        self.finish()
    }
}
