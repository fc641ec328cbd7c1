//! Files that are written whole or not at all. The command and `build` write so, and the host examples of pinhole do.

use std::collections::hash_map::RandomState;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file that is not in its place yet; dropped, it goes.
pub(crate) struct Part {
    beside: PathBuf,
    /// Its place, through links to the file itself.
    to: PathBuf,
}

/// Writes a file; where that fails, what stood there before stays.
pub(crate) fn write(to: &Path, bytes: &[u8]) -> io::Result<()> {
    Part::write(to, bytes)?.settle()
}

impl Part {
    /// Begins a file beside its place.
    pub(crate) fn begin(to: &Path) -> io::Result<(Self, File)> {
        let to = fs::canonicalize(to).unwrap_or_else(|_| to.to_path_buf());
        let name = to.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        let there = fs::metadata(&to);
        let folder = match &there {
            Ok(there) if there.is_dir() => {
                return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"))
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
    pub(crate) fn write(to: &Path, bytes: &[u8]) -> io::Result<Self> {
        let (part, mut file) = Self::begin(to)?;
        file.write_all(bytes)?;
        Ok(part)
    }

    /// Moves it to its place.
    pub(crate) fn settle(self) -> io::Result<()> {
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
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
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
