//! Follows the events of a board: what its display shows, whether the controller would take it, and the time of each frame.

use crate::boards::{Board, Pictures, Sends};
use crate::events::{Event, What};
use crate::timing::Timing;
use support::panel::Controller;

/// A board from power on to its last frame.
pub(crate) struct Watch<'a> {
    board: &'a Board,
    pictures: Pictures,
    controller: Controller,
    timing: Timing,
    waited: u64,
    frames: Vec<Frame>,
    /// Frames that the firmware has given up.
    lost: u32,
    /// Whether the bus has broken since the last complete frame: data on its way may be cut off.
    broken: bool,
    /// The last picture that was shown, and the pictures that may be next, with their steps of the turn: see [`Sends::Changes`].
    last: Vec<u32>,
    next: Vec<(u32, Vec<u32>)>,
    /// Whether the step before the last one may be next, too: an encoder turns the model.
    steps_back: bool,
}

/// A frame that has arrived at the display completely.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Frame {
    /// When its last pixel arrived.
    pub(crate) time: u64,
    /// Nanoseconds that the core has waited for the bus, since power on.
    pub(crate) waited: u64,
    /// Bytes since the frame before.
    pub(crate) bytes: usize,
    /// The step of the turn.
    pub(crate) step: u32,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(board: &'a Board, pictures: Pictures) -> Self {
        let controller = Controller::new();
        let controller = if board.display.bgr { controller.with_bgr() } else { controller };
        Self {
            board,
            pictures,
            controller,
            timing: Timing::new(),
            waited: 0,
            frames: Vec::new(),
            lost: 0,
            broken: false,
            last: Vec::new(),
            next: Vec::new(),
            steps_back: false,
        }
    }

    /// From now on a frame may also show the step of the turn before the last one.
    pub(crate) fn allow_steps_back(&mut self) {
        self.steps_back = true;
    }

    pub(crate) fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The firmware logs that it has given up a frame.
    pub(crate) fn lose_frame(&mut self) {
        self.lost += 1;
    }

    /// Takes an event that is not one of the log. An error says what a real display would not have shown, or which pixels differ.
    pub(crate) fn event(&mut self, event: Event) -> Result<(), String> {
        match event.what {
            What::Byte { byte, data, selected } => self.byte(byte, data, selected, event.time),
            What::Pin { number, high } if number == self.board.chip.reset() => {
                if self.timing.reset_line(high, event.time)? {
                    self.controller.reset();
                }
                Ok(())
            }
            What::Clock(byte) => {
                let shortest = 8 * self.board.display.bit;
                if byte < shortest {
                    return Err(format!("a byte in {byte} ns: the display needs {shortest} ns"));
                }
                Ok(())
            }
            What::Waited(time) => {
                self.waited += time;
                Ok(())
            }
            What::Broken => {
                self.broken = true;
                Ok(())
            }
            What::Pin { .. } | What::Log(_) | What::Time => Ok(()),
        }
    }

    fn byte(&mut self, byte: u8, data: bool, selected: bool, time: u64) -> Result<(), String> {
        if !selected {
            return Err(format!("byte {byte:#04x} while CS is high"));
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
            Some(_) if self.board.sends == Sends::Changes && !self.frames.is_empty() => self.changes(time),
            Some(((_, right), (_, bottom))) if (right, bottom) == last_pixel => self.frame(time),
            _ => Ok(()),
        }
    }

    /// Reports what the controller would not have understood.
    fn refusals(&mut self) -> Result<(), String> {
        let controller = &mut self.controller;
        if self.broken {
            (controller.partly_filled, controller.cut_off) = (0, 0);
        }
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
        let number = (self.frames.len() as u32 + self.lost) % self.board.frames;
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
        self.shown(time, number, wanted)
    }

    /// A rectangle of a frame has arrived.
    fn changes(&mut self, time: u64) -> Result<(), String> {
        let display = &self.board.display;
        let width = usize::from(display.width);
        let shown = self.controller.picture(display.held, width, display.height.into());
        // The first pixel that is neither as before nor as in a picture that may be next.
        let other = |next: &[u32]| {
            let mut pixels = shown.iter().zip(self.last.iter().zip(next));
            pixels.position(|(shown, (last, next))| shown != last && shown != next)
        };
        let [(step, expected), ..] = &self.next[..] else { return Err("no picture is expected".into()) };
        if let Some(at) = other(expected) {
            if self.next[1..].iter().all(|(_, next)| other(next).is_some()) {
                return Err(format!(
                    "before frame {step}, column {}, row {} is {:#06x}, in place of {:#06x} as before, or {:#06x}",
                    at % width,
                    at / width,
                    shown[at],
                    self.last[at],
                    expected[at]
                ));
            }
        }
        match self.next.iter().find(|(_, next)| *next == shown) {
            Some(&(step, _)) => self.shown(time, step, shown),
            None => Ok(()),
        }
    }

    /// The display shows the next picture.
    fn shown(&mut self, time: u64, step: u32, picture: Vec<u32>) -> Result<(), String> {
        let (bytes, _) = self.controller.count();
        self.broken = false;
        self.frames.push(Frame { time, waited: self.waited, bytes, step });
        if self.board.sends == Sends::Changes {
            self.last = picture;
            self.next.clear();
            let turn = self.board.frames;
            let steps = [(step + 1) % turn, (step + turn - 1) % turn];
            for step in &steps[..if self.steps_back { 2 } else { 1 }] {
                self.next.push((*step, (self.pictures)(*step)?));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boards::{Chip, Display};
    use support::panel::Held;

    /// A display of 2 × 2 pixels, which shows one picture.
    const BOARD: Board = Board {
        name: "test",
        chip: Chip::Rp2040 { spi: 0, clock: 0, data: 1, select: 2, command: 3, reset: 4 },
        display: Display { width: 2, height: 2, held: Held::Upright, bgr: false, inverted: true, bit: 16 },
        frames: 1,
        sends: Sends::All,
        pictures: |_| Err("no model".into()),
    };
    const PIXELS: [u8; 8] = [0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc, 0xde, 0xf0];
    const MS: u64 = 1_000_000;

    /// The bytes of a driver, with the time since its last byte.
    struct Driver {
        watch: Watch<'static>,
        time: u64,
        /// Commands that it forgets.
        forgets: &'static [u8],
    }

    impl Driver {
        fn new(forgets: &'static [u8]) -> Self {
            let picture = vec![0x1234, 0x5678, 0x9abc, 0xdef0];
            let watch = Watch::new(&BOARD, Box::new(move |_| Ok(picture.clone())));
            Self { watch, time: 0, forgets }
        }

        fn send(&mut self, wait: u64, command: u8, parameters: &[u8]) -> Result<(), String> {
            if self.forgets.contains(&command) {
                return Ok(());
            }
            self.time += wait;
            self.byte(command, false, true)?;
            parameters.iter().try_for_each(|&byte| self.byte(byte, true, true))
        }

        fn byte(&mut self, byte: u8, data: bool, selected: bool) -> Result<(), String> {
            self.time += 128;
            self.watch.event(Event { time: self.time, what: What::Byte { byte, data, selected } })
        }

        fn pin(&mut self, wait: u64, number: u8, high: bool) -> Result<(), String> {
            self.time += wait;
            self.watch.event(Event { time: self.time, what: What::Pin { number, high } })
        }

        /// Up to the window of the whole display.
        fn start(&mut self) -> Result<(), String> {
            self.send(120 * MS, 0x11, &[])?;
            self.send(5 * MS, 0x36, &[0])?;
            self.send(0, 0x21, &[])?;
            self.send(0, 0x3a, &[0x55])?;
            self.send(0, 0x29, &[])?;
            self.window(1)
        }

        fn window(&mut self, last_row: u8) -> Result<(), String> {
            self.send(0, 0x2a, &[0, 0, 0, 1])?;
            self.send(0, 0x2b, &[0, 0, 0, last_row])
        }
    }

    #[test]
    fn a_frame_ends_with_the_last_pixel() {
        let mut driver = Driver::new(&[]);
        driver.start().expect("a start");
        driver.send(0, 0x2c, &PIXELS[..7]).expect("pixels");
        assert_eq!(driver.watch.frames(), []);
        driver.byte(PIXELS[7], true, true).expect("the last one");
        let bytes = 1 + 2 + 1 + 2 + 1 + 5 + 5 + 1 + 8;
        assert_eq!(driver.watch.frames(), [Frame { time: driver.time, waited: 0, bytes, step: 0 }]);

        driver.watch.event(Event { time: 0, what: What::Waited(7) }).expect("it may wait");
        driver.send(0, 0x2c, &PIXELS).expect("the same window again");
        assert_eq!(driver.watch.frames()[1], Frame { time: driver.time, waited: 7, bytes: 9, step: 0 });
    }

    #[test]
    fn what_no_display_would_take_is_an_error() {
        let error = |driver: &mut Driver, act: &dyn Fn(&mut Driver) -> Result<(), String>| {
            act(driver).expect_err("an error")
        };
        let after_start = |act: &dyn Fn(&mut Driver) -> Result<(), String>| {
            let mut driver = Driver::new(&[]);
            driver.start().expect("a start");
            error(&mut driver, act)
        };
        assert_eq!(after_start(&|driver| driver.byte(0x2c, false, false)), "byte 0x2c while CS is high");
        let fewer = "a window with fewer pixels than it has room for";
        assert_eq!(
            after_start(&|driver| {
                driver.send(0, 0x2c, &PIXELS[..6])?;
                driver.window(1)
            }),
            fewer
        );
        let more = "a window with more pixels than it has room for";
        assert_eq!(
            after_start(&|driver| {
                driver.window(0)?;
                driver.send(0, 0x2c, &PIXELS)
            }),
            more
        );
        let cut_off = "a command or a pixel is cut off by the next command";
        assert_eq!(
            after_start(&|driver| {
                driver.send(0, 0x2a, &[0, 0, 0])?;
                driver.send(0, 0x2c, &[])
            }),
            cut_off
        );
        let differs = "frame 0 differs in 4 pixels, the first in column 0, row 0: 0x3412 in place of 0x1234";
        let swapped = [0x34, 0x12, 0x78, 0x56, 0xbc, 0x9a, 0xf0, 0xde];
        assert_eq!(after_start(&|driver| driver.send(0, 0x2c, &swapped)), differs);
        let unknown = "unknown command 0xff";
        assert_eq!(after_start(&|driver| driver.send(0, 0xff, &[])), unknown);
        let clock = |byte| Event { time: 0, what: What::Clock(byte) };
        let fast = after_start(&|driver| driver.watch.event(clock(127)));
        assert_eq!(fast, "a byte in 127 ns: the display needs 128 ns");
        let pulse = "a reset pulse of 9999 ns: the controller needs 10000 ns";
        assert_eq!(
            after_start(&|driver| {
                driver.pin(0, 4, false)?;
                driver.pin(9999, 4, true)
            }),
            pulse
        );
        // A reset in between: all has to be set up again.
        let asleep = "pixels before the inversion is as the glass needs it";
        assert_eq!(
            after_start(&|driver| {
                driver.pin(0, 4, false)?;
                driver.pin(10_000, 4, true)?;
                driver.send(5 * MS, 0x2c, &PIXELS)
            }),
            asleep
        );
        // Another pin is nothing to the display.
        let mut driver = Driver::new(&[]);
        driver.watch.event(clock(128)).expect("slow enough");
        driver
            .start()
            .and_then(|()| driver.pin(0, 5, false))
            .and_then(|()| driver.pin(1, 5, true))
            .expect("no reset");
    }

    #[test]
    fn each_command_of_the_start_is_needed() {
        let asleep = "pixels before the display is awake and on";
        let inversion = "pixels before the inversion is as the glass needs it";
        for (forgotten, problem) in [
            (&[0x11], asleep),
            (&[0x29], asleep),
            (&[0x21], inversion),
            (&[0x3a], "pixels before their format"),
        ] {
            let mut driver = Driver::new(forgotten);
            let error = driver.start().and_then(|()| driver.send(0, 0x2c, &PIXELS)).expect_err("an error");
            assert_eq!(error, problem, "{forgotten:x?}");
        }
    }

    /// Frames that send what has changed: first 0x1234 … 0xdef0, then the same with a last pixel of 0x1111.
    #[test]
    fn a_frame_of_changes_ends_when_the_display_shows_it() {
        const CHANGING: Board = Board { sends: Sends::Changes, frames: 2, ..BOARD };
        let pictures = |frame| Ok(vec![0x1234, 0x5678, 0x9abc, [0xdef0, 0x1111][frame as usize]]);
        let start = || {
            let mut driver = Driver::new(&[]);
            driver.watch = Watch::new(&CHANGING, Box::new(pictures));
            driver.start().expect("a start");
            driver.send(0, 0x2c, &PIXELS).expect("the first frame");
            assert_eq!(driver.watch.frames().len(), 1);
            driver
        };
        let row = |driver: &mut Driver, pixels: [u8; 4]| {
            driver.send(0, 0x2b, &[0, 1, 0, 1])?;
            driver.send(0, 0x2c, &pixels)
        };
        let mut driver = start();
        row(&mut driver, [0x9a, 0xbc, 0xde, 0xf0]).expect("the row as before");
        assert_eq!(driver.watch.frames().len(), 1);
        row(&mut driver, [0x9a, 0xbc, 0x11, 0x11]).expect("the row as it should be");
        assert_eq!(driver.watch.frames().len(), 2);
        row(&mut driver, [0x9a, 0xbc, 0xde, 0xf0]).expect("the first picture again");
        assert_eq!(driver.watch.frames().len(), 3);

        let error = row(&mut start(), [0x9a, 0xbd, 0x11, 0x11]).expect_err("another pixel");
        let expected = "before frame 1, column 0, row 1 is 0x9abd, in place of 0x9abc as before, or 0x9abc";
        assert_eq!(error, expected);
    }
}
