//! The firmware's log: its place in memory, and its lines.

use defmt_decoder::{DecodeError, StreamDecoder, Table};
use object::{Object, ObjectSymbol};

/// The tables of an image by which its log is read.
pub(crate) struct Tables {
    table: Table,
    /// Where the control block of RTT lies.
    pub(crate) address: u64,
}

impl Tables {
    pub(crate) fn of(image: &[u8]) -> Result<Self, String> {
        let table = Table::parse(image).map_err(|error| error.to_string())?;
        let table = table.ok_or("it does not log by defmt")?;
        let file = object::File::parse(image).map_err(|error| error.to_string())?;
        let symbol = file.symbols().find(|symbol| symbol.name() == Ok("_SEGGER_RTT"));
        Ok(Self { table, address: symbol.ok_or("it does not log by RTT")?.address() })
    }

    pub(crate) fn decoder(&self) -> Log<'_> {
        Log(self.table.new_stream_decoder())
    }
}

/// A log that is being read.
pub(crate) struct Log<'a>(Box<dyn StreamDecoder + Send + Sync + 'a>);

/// A line of the log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Line {
    /// Warnings and errors: the firmware has a problem.
    pub(crate) is_problem: bool,
    pub(crate) text: String,
}

impl Log<'_> {
    /// Takes a byte; returns the line that it completes, if any.
    pub(crate) fn line(&mut self, byte: u8) -> Result<Option<Line>, String> {
        self.0.received(&[byte]);
        match self.0.decode() {
            Ok(frame) => {
                let level = frame.level().map_or("", |level| level.as_str());
                let is_problem = matches!(level, "warn" | "error");
                Ok(Some(Line { is_problem, text: frame.display_message().to_string() }))
            }
            Err(DecodeError::UnexpectedEof) => Ok(None),
            Err(DecodeError::Malformed) => Err("the log is damaged".into()),
        }
    }
}
