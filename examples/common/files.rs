//! Files that are written whole, all of them or none, and never what was read.
#![allow(dead_code)] // not every example is given a file

use std::fmt::Display;
use std::path::Path;

#[path = "../../import/src/part.rs"]
mod part;
#[path = "../../import/src/same.rs"]
mod same;

pub(crate) use part::Part;

/// Refuses outputs that are the input, by whatever name.
pub(crate) fn apart<'a>(input: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), String> {
    match outputs.into_iter().find(|output| same::is_same(input, output)) {
        Some(output) => Err(format!("{}: is the input itself: name another file", output.display())),
        None => Ok(()),
    }
}

/// Writes each file beside its place first, and moves them there when all are complete. An error
/// names the file; what stood there before stays.
pub(crate) fn write<B: AsRef<[u8]>>(files: &[(&Path, B)]) -> Result<(), String> {
    let mut pending = Vec::new();
    for (path, bytes) in files {
        pending.push((path, Part::write(path, bytes.as_ref()).map_err(|e| unwritable(path, e))?));
    }
    // A device takes it or fails only now (/dev/full): before any file is replaced.
    pending.sort_by_key(|(path, _)| path.is_file() || !path.exists());
    for (path, part) in pending {
        part.settle().map_err(|e| unwritable(path, e))?;
    }
    Ok(())
}

/// The line that says so.
pub(crate) fn unwritable(path: &Path, problem: impl Display) -> String {
    format!("{}: cannot be written: {problem}", path.display())
}
