//! A display controller in memory, at the end of an SPI bus, which decodes bytes as an ST7789 or ILI9341 does.
//!
//! After the data sheets' chapters on commands and on the address counter (Sitronix ST7789V; Ilitek ILI9341), and independent
//! of the driver and of the library. It is strict: what it does not know, or what a real controller would answer with a
//! wrong picture, is noted in `errors`.

pub mod bus;
pub mod films;
pub mod screen;

/// The frame memory, in columns and rows of the glass.
const COLUMNS: u16 = 240;
const ROWS: u16 = 320;

/// How the glass is mounted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    Upright,
    /// Turned a quarter to the left, so that what was its right border is on top.
    Landscape,
    /// A controller behind a glass whose columns run from right to left: the memory's left border is at the right.
    UprightMirrored,
}

/// The last command, and the parameters that it still waits for.
#[derive(Clone, Debug, PartialEq, Eq)]
enum State {
    /// A command that takes this many parameters, with those it has.
    Parameters(u8, usize, Vec<u8>),
    /// Memory is written; the bytes of a pixel that is not complete.
    Pixels(Vec<u8>),
}

#[derive(Debug)]
pub struct Controller {
    memory: Vec<u32>,
    /// First and last column and row of the window, as the memory access control turns them.
    columns: (u16, u16),
    rows: (u16, u16),
    /// Where the next pixel goes.
    cursor: (u16, u16),
    /// Whether the glass has blue where others have red: then the bit that exchanges them must be set.
    bgr: bool,
    /// MADCTL and COLMOD.
    access: u8,
    format: Option<u8>,
    state: State,
    awake: bool,
    on: bool,
    /// What came over the wire since the last [`count`](Self::count).
    bytes: usize,
    windows: usize,
    /// The pixels of the last memory write.
    filled: u32,
    /// Whether the glass shows each colour as its complement.
    inverted: bool,
    /// FRMCTR1.
    line_clocks: u32,
    /// Commands and pixels that the next command cut off, and that had no effect.
    pub cut_off: usize,
    /// Windows that the next command found with fewer pixels than they have.
    pub partly_filled: usize,
    /// Pixels after the last one of a window: they begin it again.
    pub overfilled: usize,
    pub errors: Vec<String>,
}

const MIRROR_ROWS: u8 = 0x80;
const MIRROR_COLUMNS: u8 = 0x40;
const EXCHANGE: u8 = 0x20;
const BGR: u8 = 0x08;

impl Controller {
    /// As after power is put on: the memory holds whatever it holds.
    pub fn new() -> Self {
        let noise = |i: u32| i.wrapping_mul(2_654_435_761) >> 14;
        Self {
            memory: (0..u32::from(COLUMNS) * u32::from(ROWS)).map(noise).collect(),
            columns: (0, COLUMNS - 1),
            rows: (0, ROWS - 1),
            cursor: (0, 0),
            bgr: false,
            access: 0,
            format: None,
            state: State::Parameters(0, 0, Vec::new()),
            awake: false,
            on: false,
            bytes: 0,
            windows: 0,
            filled: 0,
            inverted: false,
            line_clocks: 0x1b,
            cut_off: 0,
            partly_filled: 0,
            overfilled: 0,
            errors: Vec::new(),
        }
    }

    /// A controller behind a glass with the opposite order of the colour channels.
    pub fn with_bgr(self) -> Self {
        Self { bgr: true, ..self }
    }

    /// Bytes and windows (memory writes) since the last call.
    pub fn count(&mut self) -> (usize, usize) {
        (std::mem::take(&mut self.bytes), std::mem::take(&mut self.windows))
    }

    /// As after the reset line was low, and after the command SWRESET: the memory stays.
    pub fn reset(&mut self) {
        let memory = std::mem::take(&mut self.memory);
        let errors = std::mem::take(&mut self.errors);
        let Self { bytes, windows, cut_off, partly_filled, overfilled, bgr, .. } = *self;
        let new = Self::new();
        *self = Self { memory, bytes, windows, cut_off, partly_filled, overfilled, bgr, errors, ..new };
    }

    /// Whether the inversion of colours is switched on.
    pub fn inverted(&self) -> bool {
        self.inverted
    }

    /// In how many clocks of 615 kHz an ILI9341 reads a line.
    pub fn line_clocks(&self) -> u32 {
        self.line_clocks
    }

    /// The window, if the last byte has filled its last pixel: first and last column, first and last row.
    pub fn completed(&self) -> Option<((u16, u16), (u16, u16))> {
        let complete = self.state == State::Pixels(Vec::new()) && self.filled == self.window_pixels();
        complete.then_some((self.columns, self.rows))
    }

    /// At most 240 times 320.
    fn window_pixels(&self) -> u32 {
        let length = |(from, to): (u16, u16)| u32::from(to - from) + 1;
        length(self.columns) * length(self.rows)
    }

    fn wrong(&mut self, what: impl Into<String>) {
        self.errors.push(what.into());
    }

    /// Receives one byte, with the level of the D/C line.
    pub fn receive(&mut self, byte: u8, data: bool) {
        self.bytes += 1;
        if data {
            self.data(byte);
        } else {
            self.command(byte);
        }
    }

    fn command(&mut self, command: u8) {
        match std::mem::replace(&mut self.state, State::Parameters(command, 0, Vec::new())) {
            State::Parameters(_, missing, _) => self.cut_off += usize::from(missing > 0),
            State::Pixels(part) => {
                self.cut_off += usize::from(!part.is_empty());
                self.partly_filled += usize::from(self.filled < self.window_pixels());
            }
        }
        let parameters = match command {
            0x01 => {
                self.reset();
                0
            }
            0x11 => {
                self.awake = true;
                0
            }
            0x13 => 0, // normal mode
            0x20 | 0x21 => {
                self.inverted = command == 0x21;
                0
            }
            0x29 => {
                self.on = true;
                0
            }
            0x2a | 0x2b => 4,
            0x2c => {
                self.windows += 1;
                self.filled = 0;
                self.cursor = (self.columns.0, self.rows.0);
                if !(self.awake && self.on) {
                    self.wrong("pixels before the display is awake and on");
                }
                self.state = State::Pixels(Vec::new());
                return;
            }
            0x35 | 0x36 | 0x3a => 1,
            0xb1 => 2,
            0xb4 => 1, // how the glass is inverted
            _ => {
                self.wrong(format!("unknown command {command:#04x}"));
                0
            }
        };
        self.state = State::Parameters(command, parameters, Vec::new());
    }

    fn data(&mut self, byte: u8) {
        match &mut self.state {
            State::Parameters(command, 0, _) => {
                let command = *command;
                self.wrong(format!("{byte:#04x} is one parameter too many for {command:#04x}"));
            }
            State::Parameters(command, missing, given) => {
                given.push(byte);
                *missing -= 1;
                if *missing == 0 {
                    let (command, given) = (*command, std::mem::take(given));
                    self.perform(command, &given);
                }
            }
            State::Pixels(part) => {
                part.push(byte);
                let pixel = match (self.format, &part[..]) {
                    (Some(0x55), &[high, low]) => u32::from(high) << 8 | u32::from(low),
                    // Three bytes with a channel each in the upper six bits.
                    (Some(0x66), &[r, g, b]) => [r, g, b].iter().fold(0, |p, c| p << 6 | u32::from(c >> 2)),
                    (Some(0x55 | 0x66), _) => return,
                    _ => return self.wrong("pixels before their format"),
                };
                part.clear();
                self.store(pixel);
            }
        }
    }

    /// A command that has all its parameters.
    fn perform(&mut self, command: u8, given: &[u8]) {
        match (command, given) {
            (0x2a | 0x2b, &[a, b, c, d]) => {
                let (from, to) = (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]));
                let exchanged = self.access & EXCHANGE != 0;
                let end = if (command == 0x2a) == exchanged { ROWS } else { COLUMNS };
                if from > to || to >= end {
                    self.wrong(format!("window from {from} to {to}, of {end}"));
                } else if command == 0x2a {
                    self.columns = (from, to);
                } else {
                    self.rows = (from, to);
                }
            }
            (0x36, &[access]) => {
                self.access = access;
                let order = if self.bgr { BGR } else { 0 };
                if access & !(MIRROR_ROWS | MIRROR_COLUMNS | EXCHANGE) != order {
                    let colours = if self.bgr { "BGR" } else { "RGB" };
                    self.wrong(format!(
                        "MADCTL {access:#04x}: this glass is {colours} and refreshed as it stands"
                    ));
                }
            }
            (0x3a, &[format]) => {
                self.format = Some(format);
                if !matches!(format, 0x55 | 0x66) {
                    self.wrong(format!("COLMOD {format:#04x}"));
                }
            }
            (0xb1, &[division, clocks]) => {
                if !matches!((division, clocks), (0..=3, 0x10..=0x1f)) {
                    self.wrong(format!("FRMCTR1 {division:#04x} {clocks:#04x}"));
                }
                self.line_clocks = u32::from(clocks) << (division & 3);
            }
            _ => {} // inversion; TE, which whoever has the panel drives
        }
    }

    /// Writes where the cursor stands and moves it on, row by row through the window and round again.
    fn store(&mut self, pixel: u32) {
        self.overfilled += usize::from(self.filled >= self.window_pixels());
        self.filled = self.filled.saturating_add(1);
        let (column, row) = self.cursor;
        let has = |bit| self.access & bit != 0;
        let (mut x, mut y) = if has(EXCHANGE) { (row, column) } else { (column, row) };
        if has(MIRROR_COLUMNS) {
            x = (COLUMNS - 1).wrapping_sub(x);
        }
        if has(MIRROR_ROWS) {
            y = (ROWS - 1).wrapping_sub(y);
        }
        if x < COLUMNS && y < ROWS {
            self.memory[usize::from(y) * usize::from(COLUMNS) + usize::from(x)] = pixel;
        } else {
            self.wrong(format!("a pixel at column {x}, row {y} of the glass"));
        }
        self.cursor = if column < self.columns.1 {
            (column + 1, row)
        } else if row < self.rows.1 {
            (self.columns.0, row + 1)
        } else {
            (self.columns.0, self.rows.0)
        };
    }

    /// The visible picture: the pixels of the upper left `width` × `height` of the glass as it is mounted, row by row.
    pub fn picture(&self, held: Held, width: usize, height: usize) -> Vec<u32> {
        (0..height).flat_map(|y| self.row(held, width, y)).collect()
    }

    /// The pixels of a row of the picture.
    pub fn row(&self, held: Held, width: usize, y: usize) -> impl Iterator<Item = u32> + '_ {
        let at = move |x: usize| match held {
            Held::Upright => (x, y),
            Held::Landscape => (usize::from(COLUMNS) - 1 - y, x),
            Held::UprightMirrored => (usize::from(COLUMNS) - 1 - x, y),
        };
        (0..width).map(at).map(|(x, y)| self.memory[y * usize::from(COLUMNS) + x])
    }
}
