//! Files that are written whole, all of them or none, and never what was read.
#![allow(dead_code)] // not every example is given a file

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

#[path = "../../import/src/same.rs"]
mod same;

/// Refuses outputs that are the input, by whatever name.
pub(crate) fn apart<'a>(input: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), String> {
    match outputs.into_iter().find(|output| same::is_same(input, output)) {
        Some(output) => Err(format!("{}: is the input itself: name another file", output.display())),
        None => Ok(()),
    }
}

/// Writes each file beside its place first, and moves them there when all are complete. An error
/// names the file; what stood there before stays.
pub(crate) fn write(files: &[(&Path, Vec<u8>)]) -> Result<(), String> {
    let mut pending: Vec<(&Path, Part)> = Vec::new();
    for (path, bytes) in files {
        let part =
            Part::write(path, bytes).map_err(|e| format!("{}: cannot be written: {e}", path.display()))?;
        pending.push((path, part));
    }
    for (path, part) in pending {
        part.settle().map_err(|e| format!("{}: cannot be written: {e}", path.display()))?;
    }
    Ok(())
}

/// A file that is complete but not in its place; dropped, it goes.
struct Part {
    beside: PathBuf,
    /// Its place, through links to the file itself.
    to: PathBuf,
}

impl Part {
    fn write(to: &Path, bytes: &[u8]) -> io::Result<Self> {
        let to = fs::canonicalize(to).unwrap_or_else(|_| to.to_path_buf());
        let there = fs::metadata(&to);
        if there.as_ref().is_ok_and(fs::Metadata::is_dir) {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        let mut name = to.file_name().ok_or(io::ErrorKind::InvalidInput)?.to_os_string();
        name.push(format!(".{}.part", std::process::id()));
        let beside = match there {
            // What is there and no file (/dev/stdout) must not be replaced.
            Ok(there) if !there.is_file() => std::env::temp_dir().join(name),
            _ => to.with_file_name(name),
        };
        let part = Self { beside, to };
        fs::write(&part.beside, bytes)?;
        Ok(part)
    }

    fn settle(self) -> io::Result<()> {
        if fs::metadata(&self.to).is_ok_and(|there| !there.is_file()) {
            return fs::copy(&self.beside, &self.to).map(|_| ());
        }
        fs::rename(&self.beside, &self.to)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // Moved away already, or not wanted any more.
        let _ = fs::remove_file(&self.beside);
    }
}
