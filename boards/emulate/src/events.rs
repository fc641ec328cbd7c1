//! The records of an emulator, which `rp2040.mjs` describes.

use std::io::{self, Read};

/// Something that happened on the board, and when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Event {
    /// Nanoseconds since power on.
    pub(crate) time: u64,
    pub(crate) what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// A byte on the bus has ended: the D/C line at its last bit, and whether the display was selected all the time.
    Byte { byte: u8, data: bool, selected: bool },
    /// A watched pin has changed.
    Pin { number: u8, high: bool },
    /// A byte of the log.
    Log(u8),
    /// The core has waited this many nanoseconds for the bus.
    Waited(u64),
    /// Time passes.
    Time,
    /// A byte on the bus takes this many nanoseconds from now on.
    Clock(u64),
    /// The bus has broken, on request.
    Broken,
    /// The chip was reset: by its firmware, or by its watchdog.
    Reset { by_firmware: bool },
}

impl Event {
    /// Reads the next event; `None` if the emulator has ended.
    pub(crate) fn read(from: &mut impl Read) -> io::Result<Option<Self>> {
        let mut record = [0; 8];
        match from.read_exact(&mut record) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            result => result?,
        }
        let [value, kind, time @ ..] = record;
        let [a, b, c, d, e, f] = time;
        let time = u64::from_le_bytes([a, b, c, d, e, f, 0, 0]);
        let (time, what) = match kind {
            0x00..=0x03 => (time, What::Byte { byte: value, data: kind & 1 != 0, selected: kind & 2 == 0 }),
            0x10 => (time, What::Pin { number: value & 0x7f, high: value & 0x80 != 0 }),
            0x20 => (time, What::Log(value)),
            0x30 => (0, What::Waited(time)),
            0x40 => (time, What::Time),
            0x50 => (time, What::Broken),
            0x60 => (0, What::Clock(time)),
            0x70 => (time, What::Reset { by_firmware: value != 0 }),
            _ => return Err(io::Error::other(format!("the emulator's output is damaged: kind {kind:#04x}"))),
        };
        Ok(Some(Self { time, what }))
    }
}
