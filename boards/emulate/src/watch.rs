//! Follows the events of a board: what its display shows, whether the controller would take it, and the time of each frame.

use crate::boards::{Board, Display, Pictures};
use crate::events::{Event, What};
use crate::timing::Timing;
use std::collections::VecDeque;
use support::panel::Controller;

/// A board from power on to its last frame.
pub(crate) struct Watch<'a> {
    board: &'a Board,
    pictures: Pictures,
    controller: Controller,
    timing: Timing,
    waited: u64,
    frames: Vec<Frame>,
    /// Frames that the firmware has given up before one was shown.
    lost: u32,
    /// When the bus has broken or the panel has lost its state, until the next frame that is whole: data on its way may be cut off, and
    /// frames before it are lost.
    broken: Option<u64>,
    /// Whether anything of the current frame was refused since then.
    spoilt: bool,
    /// The byte with which the panel loses its state, as after a reset; and bytes so far.
    forgets_at: Option<u64>,
    received: u64,
    /// The last picture that was shown, and the pictures that may be next, with their steps of the turn. Until the next picture is shown, each
    /// pixel is that of the last one or of one that may be next.
    last: Vec<u32>,
    next: Vec<(u32, Vec<u32>)>,
    /// All pictures, of which any may be next after the bus has broken.
    turn: Vec<Vec<u32>>,
    /// Whether the step before the last one may be next, too: an encoder turns the model.
    steps_back: bool,
    scan: Scan,
    /// The pictures of all frames, if they are wanted.
    kept: Option<Vec<Vec<u32>>>,
}

/// What a panel reads.
#[derive(Default)]
struct Scan {
    /// The line that it reads, and when it began to.
    line: u64,
    begun: u64,
    /// The rows that were read last.
    picture: Vec<u32>,
    /// The pictures that were shown last.
    whole: VecDeque<Vec<u32>>,
    refreshes: u32,
    torn: u32,
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
        Self {
            board,
            pictures,
            controller: powered_on(board),
            timing: Timing::new(),
            waited: 0,
            frames: Vec::new(),
            lost: 0,
            broken: None,
            spoilt: false,
            forgets_at: None,
            received: 0,
            last: Vec::new(),
            next: Vec::new(),
            turn: Vec::new(),
            steps_back: false,
            scan: Scan::default(),
            kept: None,
        }
    }

    /// From now on a frame may also show the step of the turn before the last one.
    pub(crate) fn allow_steps_back(&mut self) {
        self.steps_back = true;
    }

    /// With this byte the panel loses its state.
    pub(crate) fn forget_at(&mut self, byte: u32) {
        self.forgets_at = Some(byte.into());
    }

    /// When the bus has broken or the panel has lost its state, if no whole frame was shown since.
    pub(crate) fn broken(&self) -> Option<u64> {
        self.broken
    }

    /// Keeps the pictures of all frames from now on.
    pub(crate) fn keep_pictures(&mut self) {
        self.kept = Some(Vec::new());
    }

    /// The pictures of the [`frames`](Self::frames), if they are kept.
    pub(crate) fn kept(&self) -> &[Vec<u32>] {
        self.kept.as_deref().unwrap_or_default()
    }

    pub(crate) fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The firmware logs that it has given up a frame.
    pub(crate) fn lose_frame(&mut self) {
        self.lost += 1;
    }

    /// How many refreshes the panel has had since the first frame, and how many of them showed rows of two frames.
    pub(crate) fn refreshes(&self) -> (u32, u32) {
        (self.scan.refreshes, self.scan.torn)
    }

    /// Lets the panel read its memory up to a time, before which nothing has changed since the last call.
    fn scan(&mut self, time: u64) {
        let Display { width, height, held, ref refresh, .. } = self.board.display;
        let (scan, width) = (&mut self.scan, usize::from(width));
        loop {
            let clocks = u64::from(self.controller.line_clocks());
            let end = scan.begun + refresh.line.unwrap_or(clocks * 1_000_000 / 615);
            if end > time {
                return;
            }
            let line = scan.line;
            scan.line = (line + 1) % refresh.lines;
            scan.begun = end;
            let row = line.checked_sub(refresh.pause).filter(|row| *row < height.into());
            scan.picture
                .extend(row.into_iter().flat_map(|row| self.controller.row(held, width, row as usize)));
            if scan.line > 0 {
                continue;
            }
            let shown = std::mem::take(&mut scan.picture);
            if scan.whole.is_empty() || self.broken.is_some() {
                continue;
            }
            scan.refreshes += 1;
            let mut whole = scan.whole.iter().chain(self.next.iter().map(|(_, next)| next));
            scan.torn += u32::from(whole.all(|picture| *picture != shown));
        }
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
                self.broken = Some(event.time);
                Ok(())
            }
            What::Reset { by_firmware } => {
                if self.broken.is_none() {
                    let by = if by_firmware { "itself" } else { "its watchdog" };
                    return Err(format!("the chip is reset by {by}"));
                }
                self.lost = 0;
                Ok(())
            }
            What::Pin { .. } | What::Log(_) | What::Time => Ok(()),
        }
    }

    fn byte(&mut self, byte: u8, data: bool, selected: bool, time: u64) -> Result<(), String> {
        if !selected {
            return Err(format!("byte {byte:#04x} while CS is high"));
        }
        self.scan(time);
        self.received += 1;
        if self.forgets_at == Some(self.received) {
            self.controller = powered_on(self.board);
            self.broken = Some(time);
        }
        if !data {
            self.timing.command(byte, time)?;
            if byte == 0x2c
                && self.broken.is_none()
                && self.controller.inverted() != self.board.display.inverted
            {
                return Err("pixels before the inversion is as the glass needs it".into());
            }
        }
        self.controller.receive(byte, data);
        self.refusals()?;
        let last_pixel = (self.board.display.width - 1, self.board.display.height - 1);
        match self.controller.completed().filter(|_| data) {
            Some(_) if !self.frames.is_empty() => self.changes(time),
            Some(((_, right), (_, bottom))) if (right, bottom) == last_pixel => self.first_frame(time),
            _ => Ok(()),
        }
    }

    /// Reports what the controller would not have understood.
    fn refusals(&mut self) -> Result<(), String> {
        let controller = &mut self.controller;
        if self.broken.is_some() {
            let cut = controller.partly_filled + controller.overfilled + controller.cut_off;
            self.spoilt |= cut > 0 || !controller.errors.is_empty();
            (controller.partly_filled, controller.overfilled, controller.cut_off) = (0, 0, 0);
            controller.errors.clear();
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

    /// The last pixel of the display has arrived, and no frame has been shown yet.
    fn first_frame(&mut self, time: u64) -> Result<(), String> {
        let display = &self.board.display;
        if std::mem::take(&mut self.spoilt) || self.controller.inverted() != display.inverted {
            return Ok(()); // one after the bus has broken
        }
        let mut number = self.lost % self.board.frames;
        let (width, height) = (usize::from(display.width), usize::from(display.height));
        let shown = self.controller.picture(display.held, width, height);
        let mut wanted = (self.pictures)(number)?;
        // While the panel did not know what it got, nobody has counted frames.
        let turn = if self.broken.is_some() { self.board.frames } else { 1 };
        for _ in 1..turn {
            if shown == wanted {
                break;
            }
            number = (number + 1) % self.board.frames;
            wanted = (self.pictures)(number)?;
        }
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
        if self.broken.is_some() {
            if self.turn.is_empty() {
                self.turn = (0..self.board.frames).map(&mut self.pictures).collect::<Result<_, _>>()?;
            }
            let is_ready =
                !std::mem::take(&mut self.spoilt) && self.controller.inverted() == display.inverted;
            return match self.turn.iter().position(|picture| is_ready && *picture == shown) {
                Some(step) => self.shown(time, step as u32, shown),
                None => Ok(()),
            };
        }
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
        self.broken = None;
        self.frames.push(Frame { time, waited: self.waited, bytes, step });
        if let Some(kept) = &mut self.kept {
            kept.push(picture.clone());
        }
        self.scan.whole.push_back(picture.clone());
        self.scan.whole.drain(..self.scan.whole.len().saturating_sub(3));
        self.last = picture;
        self.next.clear();
        let turn = self.board.frames;
        let steps = [(step + 1) % turn, (step + turn - 1) % turn];
        for step in &steps[..if self.steps_back { 2 } else { 1 }] {
            // There is none after the last picture of a file.
            self.next.extend((self.pictures)(*step).map(|picture| (*step, picture)).ok());
        }
        Ok(())
    }
}

fn powered_on(board: &Board) -> Controller {
    let controller = Controller::new();
    if board.display.bgr {
        controller.with_bgr()
    } else {
        controller
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boards::{Chip, Refresh};
    use support::panel::Held;
    use Step::{Clock, Reset, Send, Unselected, Waited};

    /// A display of 2 × 2 pixels, which shows one picture.
    const BOARD: Board = Board {
        name: "test",
        chip: Chip::Rp2040 { spi: 0, clock: 0, data: 1, select: 2, command: 3, reset: 4 },
        display: Display {
            width: 2,
            height: 2,
            held: Held::Upright,
            bgr: false,
            inverted: true,
            bit: 16,
            refresh: Refresh { lines: 4, pause: 2, line: Some(1000) },
            tearing: None,
        },
        frames: 1,
        pictures: |_| Err("no model".into()),
    };
    const PIXELS: [u8; 8] = [0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc, 0xde, 0xf0];
    const MS: u64 = 1_000_000;

    /// What reaches the display, some nanoseconds after what came before.
    #[derive(Clone, Copy, Debug)]
    enum Step {
        /// A command and its parameters, a byte each 128 ns.
        Send(u64, u8, &'static [u8]),
        /// A low pulse on a pin of this number.
        Reset(u8, u64),
        Unselected(u8),
        Clock(u64),
        Waited(u64),
    }

    /// Up to the window of the whole display.
    const START: [Step; 7] = [
        Send(120 * MS, 0x11, &[]),
        Send(5 * MS, 0x36, &[0]),
        Send(0, 0x21, &[]),
        Send(0, 0x3a, &[0x55]),
        Send(0, 0x29, &[]),
        Send(0, 0x2a, &[0, 0, 0, 1]),
        Send(0, 0x2b, &[0, 0, 0, 1]),
    ];

    /// Takes the steps, the first of them at a time, and returns the time after the last one.
    fn take(watch: &mut Watch<'_>, mut time: u64, steps: &[Step]) -> Result<u64, String> {
        let mut event = |after: u64, what| {
            time += after;
            watch.event(Event { time, what })
        };
        for &step in steps {
            match step {
                Send(wait, command, parameters) => {
                    event(wait + 128, What::Byte { byte: command, data: false, selected: true })?;
                    for &byte in parameters {
                        event(128, What::Byte { byte, data: true, selected: true })?;
                    }
                }
                Reset(number, low) => {
                    event(0, What::Pin { number, high: false })?;
                    event(low, What::Pin { number, high: true })?;
                }
                Unselected(byte) => event(128, What::Byte { byte, data: false, selected: false })?,
                Clock(byte) => event(0, What::Clock(byte))?,
                Waited(time) => event(0, What::Waited(time))?,
            }
        }
        Ok(time)
    }

    fn watch<'a>(board: &'a Board, last_pixels: &'static [u32]) -> Watch<'a> {
        let picture = move |frame| Ok(vec![0x1234, 0x5678, 0x9abc, last_pixels[frame as usize]]);
        Watch::new(board, Box::new(picture))
    }

    #[test]
    fn a_frame_ends_with_the_last_pixel() {
        let mut watch = watch(&BOARD, &[0xdef0]);
        let start = take(&mut watch, 0, &START).expect("a start");
        let time = take(&mut watch, start, &[Send(0, 0x2c, &PIXELS)]).expect("pixels");
        let bytes = 1 + 2 + 1 + 2 + 1 + 5 + 5 + 1 + 8;
        assert_eq!(
            (watch.frames(), time),
            (&[Frame { time, waited: 0, bytes, step: 0 }][..], start + 9 * 128)
        );
        let again = [Waited(7), Send(0, 0x2c, &PIXELS)];
        let time = take(&mut watch, time, &again).expect("the same window again");
        assert_eq!(watch.frames()[1], Frame { time, waited: 7, bytes: 9, step: 0 });
    }

    #[test]
    fn what_no_display_would_take_is_an_error() {
        let cases: [(&[Step], &str); 10] = [
            (&[Clock(128), Reset(5, 1)], ""), // slow enough, and another pin
            (&[Unselected(0x2c)], "byte 0x2c while CS is high"),
            (
                &[Send(0, 0x2c, &[0x12, 0x34]), Send(0, 0x2a, &[])],
                "a window with fewer pixels than it has room for",
            ),
            (
                &[Send(0, 0x2b, &[0, 0, 0, 0]), Send(0, 0x2c, &PIXELS)],
                "a window with more pixels than it has room for",
            ),
            (
                &[Send(0, 0x2a, &[0, 0, 0]), Send(0, 0x2c, &[])],
                "a command or a pixel is cut off by the next command",
            ),
            (
                &[Send(0, 0x2c, &[0x34, 0x12, 0x78, 0x56, 0xbc, 0x9a, 0xf0, 0xde])],
                "frame 0 differs in 4 pixels, the first in column 0, row 0: 0x3412 in place of 0x1234",
            ),
            (&[Send(0, 0xff, &[])], "unknown command 0xff"),
            (&[Clock(127)], "a byte in 127 ns: the display needs 128 ns"),
            (&[Reset(4, 9999)], "a reset pulse of 9999 ns: the controller needs 10000 ns"),
            // All has to be set up again.
            (
                &[Reset(4, 10_000), Send(5 * MS, 0x2c, &PIXELS)],
                "pixels before the inversion is as the glass needs it",
            ),
        ];
        for (steps, problem) in cases {
            let mut watch = watch(&BOARD, &[0xdef0]);
            let start = take(&mut watch, 0, &START).expect("a start");
            let found = take(&mut watch, start, steps);
            assert_eq!(found.err().unwrap_or_default(), problem, "{steps:x?}");
        }
    }

    #[test]
    fn each_command_of_the_start_is_needed() {
        let asleep = "pixels before the display is awake and on";
        let inversion = "pixels before the inversion is as the glass needs it";
        for (forgotten, problem) in
            [(0, asleep), (4, asleep), (2, inversion), (3, "pixels before their format")]
        {
            let mut steps = START.to_vec();
            steps.remove(forgotten);
            steps.push(Send(0, 0x2c, &PIXELS));
            let error = take(&mut watch(&BOARD, &[0xdef0]), 120 * MS, &steps).expect_err("an error");
            assert_eq!(error, problem, "{:x?}", START[forgotten]);
        }
    }

    /// Frames that send what has changed: first 0x1234 … 0xdef0, then a last pixel of 0x1111.
    #[test]
    fn a_frame_of_changes_ends_when_the_display_shows_it() {
        const CHANGING: Board = Board { frames: 2, ..BOARD };
        const ROW: Step = Send(0, 0x2b, &[0, 1, 0, 1]);
        let rows: [(&'static [u8], usize); 4] = [
            (&[0x9a, 0xbc, 0xde, 0xf0], 1), // as before
            (&[0x9a, 0xbc, 0x11, 0x11], 2),
            (&[0x9a, 0xbc, 0xde, 0xf0], 3), // the first picture again
            (&[0x9a, 0xbd, 0x11, 0x11], 0), // another pixel
        ];
        let mut watch = watch(&CHANGING, &[0xdef0, 0x1111]);
        let mut time = take(&mut watch, 0, &START).expect("a start");
        time = take(&mut watch, time, &[Send(0, 0x2c, &PIXELS)]).expect("the first frame");
        for (pixels, frames) in rows {
            match take(&mut watch, time, &[ROW, Send(0, 0x2c, pixels)]) {
                Ok(end) => time = end,
                Err(error) => {
                    let wanted =
                        "before frame 1, column 0, row 1 is 0x9abd, in place of 0x9abc as before, or 0x9abc";
                    assert_eq!((&error[..], frames), (wanted, 0));
                    return;
                }
            }
            assert_eq!(watch.frames().len(), frames, "{pixels:x?}");
        }
        panic!("no error");
    }
}
