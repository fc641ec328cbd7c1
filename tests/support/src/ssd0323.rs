//! An SSD0323 in memory, with its bus and its D/C line as embedded-hal has them.
//!
//! After the data sheet's chapters on the command table and the graphic display data RAM (Solomon Systech, *SSD0323*). It is
//! strict: a command that it does not know or that ends too early, a window beyond the panel, and a D/C line that
//! changes while bytes are under way are errors of the test.

use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, SpiBus};
use std::cell::RefCell;
use std::rc::Rc;

const COLUMNS: usize = 64;
const ROWS: usize = 64;

struct Controller {
    /// Two pixels a byte.
    memory: [[u8; COLUMNS]; ROWS],
    columns: (usize, usize),
    rows: (usize, usize),
    cursor: (usize, usize),
    /// A command and its parameters so far.
    command: Vec<u8>,
    on: bool,
}

impl Controller {
    fn receive(&mut self, byte: u8, data: bool) {
        if data {
            assert!(self.command.is_empty(), "pixels inside command {:02x?}", self.command);
            let (column, row) = self.cursor;
            self.memory[row][column] = byte;
            let ((first, last), (top, bottom)) = (self.columns, self.rows);
            self.cursor = match (column == last, row == bottom) {
                (false, _) => (column + 1, row),
                (true, false) => (first, row + 1),
                (true, true) => (first, top),
            };
            return;
        }
        self.command.push(byte);
        match self.command[..] {
            [0x15] | [0x15, _] | [0x75] | [0x75, _] => return,
            [0x15, first, last] => self.columns = span(first, last, COLUMNS),
            [0x75, first, last] => self.rows = span(first, last, ROWS),
            [0xA4] => (),
            [0xAE] => self.on = false,
            [0xAF] => self.on = true,
            _ => panic!("no command of this controller: {:02x?}", self.command),
        }
        self.command.clear();
        self.cursor = (self.columns.0, self.rows.0);
    }
}

fn span(first: u8, last: u8, end: usize) -> (usize, usize) {
    let (first, last) = (usize::from(first), usize::from(last));
    assert!(first <= last && last < end, "{first} to {last} of {end}");
    (first, last)
}

/// The bus or the pin fails, once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    Bus,
    Pin,
}

struct State {
    controller: Controller,
    /// The D/C line: high for data.
    data: bool,
    /// Bytes under way: they arrive when the bus is flushed.
    pending: Vec<u8>,
    /// Which call fails, after this many calls that succeed.
    failure: Option<(Failure, usize)>,
    count: usize,
}

/// All wires to a controller: clones lead to the same one.
#[derive(Clone)]
pub struct Wires(Rc<RefCell<State>>);

impl Wires {
    /// As after a reset, with a memory that holds whatever it holds.
    pub fn new() -> Self {
        let noise = |row: usize, column: usize| (row * 37 + column * 101) as u8 ^ 0x5A;
        let memory = std::array::from_fn(|row| std::array::from_fn(|column| noise(row, column)));
        let (columns, rows) = ((0, COLUMNS - 1), (0, ROWS - 1));
        let controller = Controller { memory, columns, rows, cursor: (0, 0), command: Vec::new(), on: false };
        let state = State { controller, data: true, pending: Vec::new(), failure: None, count: 0 };
        Self(Rc::new(RefCell::new(state)))
    }

    pub fn pin(&self) -> Pin {
        Pin(self.clone())
    }

    /// The level of every pixel, row by row.
    pub fn levels(&self) -> Vec<u8> {
        self.0.borrow().controller.memory.iter().flatten().flat_map(|byte| [byte >> 4, byte & 15]).collect()
    }

    pub fn on(&self) -> bool {
        self.0.borrow().controller.on
    }

    /// Bytes that arrived.
    pub fn count(&self) -> usize {
        self.0.borrow().count
    }

    /// Lets something fail once, after some calls that do not.
    pub fn fail(&self, what: Failure, after: usize) {
        self.0.borrow_mut().failure = Some((what, after));
    }

    /// Receives bytes without the driver.
    pub fn receive(&self, bytes: &[u8], data: bool) {
        let state = &mut *self.0.borrow_mut();
        state.count += bytes.len();
        bytes.iter().for_each(|byte| state.controller.receive(*byte, data));
    }

    fn may_fail(&self, here: Failure) -> Result<(), Failure> {
        let state = &mut *self.0.borrow_mut();
        match &mut state.failure {
            Some((what, 0)) if *what == here => {
                state.failure = None;
                Err(here)
            }
            Some((what, after)) if *what == here => {
                *after -= 1;
                Ok(())
            }
            _ => Ok(()),
        }
    }
}

impl spi::Error for Failure {
    fn kind(&self) -> spi::ErrorKind {
        spi::ErrorKind::Other
    }
}

impl digital::Error for Failure {
    fn kind(&self) -> digital::ErrorKind {
        digital::ErrorKind::Other
    }
}

impl spi::ErrorType for Wires {
    type Error = Failure;
}

impl SpiBus for Wires {
    fn read(&mut self, _: &mut [u8]) -> Result<(), Failure> {
        panic!("nothing is read from this panel")
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Failure> {
        self.may_fail(Failure::Bus)?;
        self.0.borrow_mut().pending.extend_from_slice(words);
        Ok(())
    }

    fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), Failure> {
        panic!("nothing is read from this panel")
    }

    fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), Failure> {
        panic!("nothing is read from this panel")
    }

    fn flush(&mut self) -> Result<(), Failure> {
        let (bytes, data) = {
            let state = &mut *self.0.borrow_mut();
            (std::mem::take(&mut state.pending), state.data)
        };
        self.receive(&bytes, data);
        Ok(())
    }
}

/// The D/C line.
pub struct Pin(Wires);

impl Pin {
    fn set(&mut self, data: bool) -> Result<(), Failure> {
        self.0.may_fail(Failure::Pin)?;
        let state = &mut *self.0 .0.borrow_mut();
        assert!(state.pending.is_empty(), "the D/C line changes while bytes are under way");
        state.data = data;
        Ok(())
    }
}

impl digital::ErrorType for Pin {
    type Error = Failure;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Failure> {
        self.set(false)
    }

    fn set_high(&mut self) -> Result<(), Failure> {
        self.set(true)
    }
}
