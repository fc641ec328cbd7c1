//! QEMU's log, through a pipe.

use std::io::{BufReader, Read, Result};
use std::process::ChildStderr;
use std::thread::sleep;
use std::time::Duration;

/// How long QEMU writes before its log is read: about as long as it takes to fill a pipe.
const PAUSE: Duration = Duration::from_micros(300);

/// Reads what a pipe holds after a pause. QEMU writes line by line, and a reader that waits for the pipe is woken by each line, which
/// takes both more time than all else.
pub(crate) struct Paused(ChildStderr);

impl Read for Paused {
    fn read(&mut self, into: &mut [u8]) -> Result<usize> {
        sleep(PAUSE);
        self.0.read(into)
    }
}

/// The lines of a log.
pub(crate) fn lines(log: ChildStderr) -> BufReader<Paused> {
    BufReader::with_capacity(1 << 20, Paused(log))
}
