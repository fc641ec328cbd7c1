//! Output files, written completely or not at all, and never over an input.

use std::fmt::Display;
use std::path::Path;

#[allow(dead_code)] // the importer writes single files
#[path = "../../../import/src/part.rs"]
mod part;
#[path = "../../../import/src/same.rs"]
mod same;

pub(crate) use part::Part;

/// Checks that no output is the input file under any name.
///
/// # Errors
///
/// A message that names the output.
pub fn apart<'a>(input: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), String> {
    match outputs.into_iter().find(|output| same::is_same(input, output)) {
        Some(output) => Err(format!("{}: is the input file: name another output", output.display())),
        None => Ok(()),
    }
}

/// Writes files: each is completed under a temporary name first, and all are moved to their names in the end.
///
/// # Errors
///
/// A message that names the file that cannot be written. Existing files of these names are then unchanged.
pub fn write<B: AsRef<[u8]>>(files: &[(&Path, B)]) -> Result<(), String> {
    let mut pending = Vec::new();
    for (path, bytes) in files {
        pending.push((path, Part::write(path, bytes.as_ref()).map_err(|e| unwritable(path, e))?));
    }
    // Devices first: whether one accepts the bytes (/dev/full does not) shows only now, and no file is replaced yet.
    pending.sort_by_key(|(path, _)| path.is_file() || !path.exists());
    for (path, part) in pending {
        part.settle().map_err(|e| unwritable(path, e))?;
    }
    Ok(())
}

/// The message for a file that cannot be written.
pub fn unwritable(path: &Path, problem: impl Display) -> String {
    format!("{}: cannot be written: {problem}", path.display())
}
