//! What host programs share: lines of output, and files that are written whole or not at all. For the command, for
//! `build`, and for the host programs of pinhole's repository: these compile this file, too, because its examples should not wait for
//! the importer.

use std::collections::hash_map::RandomState;
use std::ffi::OsStr;
use std::fmt::Display;
use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Lines to standard output. Who closes it (`| head`) has read enough, and the program goes on without.
pub fn say(lines: impl Display) -> Result<(), String> {
    let text: String = lines.to_string().split('\n').flat_map(|line| [shown(line), "\n".into()]).collect();
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(problem) if problem.kind() != ErrorKind::BrokenPipe => {
            Err(format!("standard output: cannot be written: {problem}"))
        }
        _ => Ok(()),
    }
}

/// A line to standard error, if anybody reads that; there is no other place to say that nobody does.
pub fn complain(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", shown(&line.to_string()));
}

/// Prints the warnings about a model to standard error, one line each.
pub fn warn(model: &Path, warnings: impl IntoIterator<Item = impl Display>) {
    for warning in warnings {
        complain(format_args!("{}: warning: {warning}", model.display()));
    }
}

/// The text with its control characters, and the characters that change the direction of text, escaped as in Rust: a name within
/// a file can then neither move the cursor nor change colours or the window's title.
pub fn shown(text: &str) -> String {
    let is_harmful = |c: char| {
        c.is_control()
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        match is_harmful(c) {
            true => out.extend(c.escape_default()),
            false => out.push(c),
        }
        out
    })
}

/// Whether both name one file, by links of whatever kind. What is not there is no file, and what is no file (a terminal, a
/// pipe) may be read and written at once.
pub fn is_same(a: &Path, b: &Path) -> bool {
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

/// A file that is not in its place yet; dropped, it goes.
pub struct Part {
    beside: PathBuf,
    /// Its place, through links to the file itself.
    to: PathBuf,
}

/// Writes a file; where that fails, what stood there before stays.
pub fn write(to: &Path, bytes: &[u8]) -> io::Result<()> {
    Part::write(to, bytes)?.settle()
}

impl Part {
    /// Begins a file beside its place.
    pub fn begin(to: &Path) -> io::Result<(Self, File)> {
        let to = fs::canonicalize(to).unwrap_or_else(|_| to.to_path_buf());
        let name = to.file_name().ok_or(ErrorKind::InvalidInput)?;
        let there = fs::metadata(&to);
        let folder = match &there {
            Ok(there) if there.is_dir() => {
                return Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder"))
            }
            // A path that exists and is no regular file, such as /dev/stdout, must not be replaced.
            Ok(there) if !there.is_file() => std::env::temp_dir(),
            _ => to.with_file_name(""),
        };
        let replaced = there.ok().filter(fs::Metadata::is_file);
        if replaced.is_some() {
            File::options().append(true).open(&to)?; // what must not be written must not be replaced either
        }
        let (beside, file) = create(&folder, name)?;
        let part = Self { beside, to };
        if let Some(replaced) = replaced {
            file.set_permissions(replaced.permissions())?;
        }
        Ok((part, file))
    }

    /// All of a file, beside its place.
    pub fn write(to: &Path, bytes: &[u8]) -> io::Result<Self> {
        let (part, mut file) = Self::begin(to)?;
        file.write_all(bytes)?;
        Ok(part)
    }

    /// Moves it to its place.
    pub fn settle(self) -> io::Result<()> {
        if fs::metadata(&self.to).is_ok_and(|there| !there.is_file()) {
            return fs::copy(&self.beside, &self.to).map(|_| ());
        }
        fs::rename(&self.beside, &self.to)
    }
}

/// Creates a file for a part of this name. Nobody can tell the file's name before, or have it be an existing file by a link.
fn create(folder: &Path, name: &OsStr) -> io::Result<(PathBuf, File)> {
    loop {
        let random = RandomState::new().build_hasher().finish();
        let mut name = name.to_os_string();
        name.push(format!(".{random:016x}.part"));
        let path = folder.join(name);
        match File::options().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            result => return result.map(|file| (path, file)),
        }
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // Moved away already, or not wanted any more.
        let _ = fs::remove_file(&self.beside);
    }
}
