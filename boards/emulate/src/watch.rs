//! Follows the events of a board: what its display shows, whether the controller would take it, and the time of each frame.

use crate::boards::{Board, Pictures};
use crate::events::{Event, What};
use crate::timing::Timing;
use support::panel::Controller;

/// A board from power on to its last frame.
pub(crate) struct Watch<'a> {
    board: &'a Board,
    pictures: Pictures,
    controller: Controller,
    timing: Timing,
    /// The end of the last byte on the bus.
    last_byte: Option<u64>,
    waited: u64,
    frames: Vec<Frame>,
}

/// A frame that the display has got completely.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Frame {
    /// When its last pixel arrived.
    pub(crate) time: u64,
    /// Nanoseconds that the core has waited for the bus, since power on.
    pub(crate) waited: u64,
    /// Bytes since the frame before.
    pub(crate) bytes: usize,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(board: &'a Board, pictures: Pictures) -> Self {
        let controller = Controller::new();
        let controller = if board.display.bgr { controller.with_bgr() } else { controller };
        let (timing, last_byte, waited, frames) = (Timing::new(), None, 0, Vec::new());
        Self { board, pictures, controller, timing, last_byte, waited, frames }
    }

    pub(crate) fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Takes an event that is not of the log. An error says what no display would show, or what differs.
    pub(crate) fn event(&mut self, event: Event) -> Result<(), String> {
        match event.what {
            What::Byte { byte, data, selected } => self.byte(byte, data, selected, event.time),
            What::Pin { number, high } if number == self.board.chip.reset() => {
                if self.timing.reset_line(high, event.time)? {
                    self.controller.reset();
                }
                Ok(())
            }
            What::Waited(time) => {
                self.waited += time;
                Ok(())
            }
            What::Pin { .. } | What::Log(_) | What::Time => Ok(()),
        }
    }

    fn byte(&mut self, byte: u8, data: bool, selected: bool, time: u64) -> Result<(), String> {
        if !selected {
            return Err(format!("byte {byte:#04x} while CS is high"));
        }
        // An emulator rounds times to a nanosecond.
        let shortest = 8 * self.board.display.bit - 1;
        if let Some(took) =
            self.last_byte.replace(time).map(|last| time - last).filter(|took| *took < shortest)
        {
            return Err(format!("a byte in {took} ns: the display needs {} ns", shortest + 1));
        }
        if !data {
            self.timing.command(byte, time)?;
            if byte == 0x2c && self.controller.inverted() != self.board.display.inverted {
                return Err("pixels before the inversion is as the glass needs it".into());
            }
        }
        self.controller.receive(byte, data);
        self.refusals()?;
        let last_pixel = (self.board.display.width - 1, self.board.display.height - 1);
        match self.controller.completed().filter(|_| data) {
            Some(((_, right), (_, bottom))) if (right, bottom) == last_pixel => self.frame(time),
            _ => Ok(()),
        }
    }

    /// What the controller would not have understood.
    fn refusals(&self) -> Result<(), String> {
        let controller = &self.controller;
        if let Some(error) = controller.errors.first() {
            Err(error.clone())
        } else if controller.partly_filled > 0 {
            Err("a window with fewer pixels than it has room for".into())
        } else if controller.overfilled > 0 {
            Err("a window with more pixels than it has room for".into())
        } else if controller.cut_off > 0 {
            Err("a command or a pixel is cut off by the next command".into())
        } else {
            Ok(())
        }
    }

    /// The last pixel of a frame has arrived.
    fn frame(&mut self, time: u64) -> Result<(), String> {
        let display = &self.board.display;
        let number = self.frames.len() as u32 % self.board.frames;
        let (width, height) = (usize::from(display.width), usize::from(display.height));
        let (shown, wanted) =
            (self.controller.picture(display.held, width, height), (self.pictures)(number)?);
        if shown.len() != wanted.len() {
            return Err(format!(
                "frame {number}: {} pixels, and the host draws {}",
                shown.len(),
                wanted.len()
            ));
        }
        let mut differing =
            shown.iter().zip(&wanted).enumerate().filter(|(_, (shown, wanted))| shown != wanted);
        if let Some((first, (shown, wanted))) = differing.next() {
            return Err(format!(
                "frame {number} differs in {} pixels, the first in column {}, row {}: {shown:#06x} in place of {wanted:#06x}",
                1 + differing.count(),
                first % width,
                first / width
            ));
        }
        let (bytes, _) = self.controller.count();
        self.frames.push(Frame { time, waited: self.waited, bytes });
        Ok(())
    }
}
