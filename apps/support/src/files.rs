//! Output files, written completely or not at all, and never over an input.

use crate::host;
use std::fmt::Display;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

pub(crate) use crate::host::Part;

/// Checks that no output is the input file under any name. The error names the output.
pub fn apart<'a>(input: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), String> {
    match outputs.into_iter().find(|output| host::is_same(input, output)) {
        Some(output) => Err(format!("{}: is the input file: name another output", output.display())),
        None => Ok(()),
    }
}

/// Output files in the making: each is completed under a temporary name, and all are moved to their names in the end. Files that
/// stand there before stay as they are until then.
#[derive(Default)]
pub struct Outputs {
    parts: Vec<(PathBuf, u64, Part)>,
}

impl Outputs {
    /// Adds a file with these bytes. The error names the file where it cannot be written.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), String> {
        self.stream(path, |file| file.write_all(bytes).map_err(|e| unwritable(path, e)))
    }

    /// Adds a file that `write` writes piece by piece. The error is that of `write`, or a message that names the file that cannot
    /// be written.
    pub fn stream(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> Result<(), String>,
    ) -> Result<(), String> {
        let (part, file) = Part::begin(path).map_err(|e| unwritable(path, e))?;
        let mut file = BufWriter::new(file);
        write(&mut file)?;
        let file = file.into_inner().map_err(|e| unwritable(path, e.error()))?;
        let bytes = file.metadata().map_err(|e| unwritable(path, e))?.len();
        self.parts.push((path.into(), bytes, part));
        Ok(())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Moves all files to their names. Returns the names and the number of bytes in each, in the order in which they were added.
    /// The error names the file that cannot be written. Existing files of these names are then unchanged.
    pub fn settle(self) -> Result<Vec<(PathBuf, u64)>, String> {
        let written = self.parts.iter().map(|(path, bytes, _)| (path.clone(), *bytes)).collect();
        let mut parts = self.parts;
        // Devices first: whether one accepts the bytes (/dev/full does not) shows only now, and no file is replaced yet.
        parts.sort_by_key(|(path, ..)| path.is_file() || !path.exists());
        for (path, _, part) in parts {
            part.settle().map_err(|e| unwritable(&path, e))?;
        }
        Ok(written)
    }
}

/// Writes files: each is completed under a temporary name first, and all are moved to their names in the end. The error names the
/// file that cannot be written. Existing files of these names are then unchanged.
pub fn write<B: AsRef<[u8]>>(files: &[(&Path, B)]) -> Result<(), String> {
    let mut outputs = Outputs::default();
    files.iter().try_for_each(|(path, bytes)| outputs.add(path, bytes.as_ref()))?;
    outputs.settle().map(drop)
}

/// The message for a file that cannot be written.
pub fn unwritable(path: &Path, problem: impl Display) -> String {
    format!("{}: cannot be written: {problem}", path.display())
}
