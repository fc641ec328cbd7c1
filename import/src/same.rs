//! Whether an output is the input by another name. The command asks, and the host examples of pinhole do.

use std::path::Path;

/// Whether both name one file, by links of whatever kind. What is not there is no file, and what is no file (a terminal, a
/// pipe) may be read and written at once.
pub(crate) fn is_same(a: &Path, b: &Path) -> bool {
    let (Ok(first), Ok(second)) = (a.metadata(), b.metadata()) else { return false };
    if !(first.is_file() && second.is_file()) {
        return false;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        (first.dev(), first.ino()) == (second.dev(), second.ino())
    }
    #[cfg(not(unix))] // hard links are not known there
    {
        a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
    }
}
