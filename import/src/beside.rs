//! The files that a model names, material libraries and pictures: they lie in the model's folder, or were given with it.

use crate::remedy::Remedy;
use crate::text::before_comment;
use crate::{Options, LARGEST_FILE};
use std::borrow::Cow;
use std::fmt;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Where the files that a model names are looked for.
pub(crate) struct Beside<'a> {
    /// The model's file.
    pub(crate) model: &'a Path,
    /// Names and bytes of files that were given with the model, as in a browser.
    pub(crate) given: &'a [(String, Vec<u8>)],
    /// What may be read, and whether pictures are wanted.
    pub(crate) options: &'a Options,
}

/// A file that a model names.
#[derive(Debug)]
pub(crate) struct Found<'a> {
    /// Its path, or the name with which it was given.
    pub(crate) path: PathBuf,
    given: Option<&'a [u8]>,
}

/// Why a file that a model names is not read.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unread {
    /// It is not there.
    Missing,
    /// It lies neither in the model's folder nor in that of [`Options::root`](crate::Options::root), or a symbolic link leads out of them.
    Outside,
    /// It is a folder, a pipe or a device, which could keep a reader waiting for ever.
    NotRegular,
    /// It has more bytes than this crate reads, 2³⁰.
    TooLarge,
    /// The system cannot read it, for this reason.
    Failed(String),
}

impl Unread {
    pub(crate) fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Outside => vec![Remedy::PutBeside, Remedy::Root],
            _ => vec![Remedy::PutBeside],
        }
    }
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Missing => "is not there",
            Self::Outside => "lies outside the model's folder",
            Self::NotRegular => "is no regular file",
            Self::TooLarge => "has more than 1 GiB",
            Self::Failed(problem) => return write!(f, "cannot be read: {problem}"),
        })
    }
}

impl<'a> Beside<'a> {
    /// The file of a name. A name may be written with quotes, escaped spaces, the separators of another system, other capital
    /// letters, a comment behind it, or the folders of the computer where the model was made.
    pub(crate) fn find(&self, name: &str) -> Result<Found<'a>, Unread> {
        let plain = |name: &str| {
            let name = name.trim().trim_matches('"');
            name.replace("\\ ", " ").replace("%20", " ").replace('\\', "/")
        };
        let mut names = vec![name.to_owned(), plain(name), plain(before_comment(name))];
        names.dedup();
        let mut unread = Unread::Missing;
        for name in &names {
            let last = name.rsplit('/').next().unwrap_or_default();
            let given = || self.given.iter();
            let exact = given().find(|(other, _)| other == last);
            if let Some((name, bytes)) = exact.or(given().find(|(other, _)| other.eq_ignore_ascii_case(last)))
            {
                return Ok(Found { path: name.into(), given: Some(bytes) });
            }
            let beside_the_model = Some(last).filter(|last| last != name);
            for name in [&name[..]].into_iter().chain(beside_the_model) {
                let Some(path) = present(self.folder(), name) else { continue };
                match self.check(&path) {
                    Ok(()) => return Ok(Found { path, given: None }),
                    Err(why) => unread = why,
                }
            }
        }
        Err(unread)
    }

    /// The files of a list of names: of the one name that it is, if there is such a file, or else of its words.
    pub(crate) fn find_all<'n>(&self, list: &'n str) -> Vec<(&'n str, Result<Found<'a>, Unread>)> {
        let whole = self.find(list);
        if matches!(whole, Err(Unread::Missing)) {
            let (mut is_quoted, mut before) = (false, ' ');
            let ends = |c: char| {
                is_quoted ^= c == '"';
                let is_escaped = std::mem::replace(&mut before, c) == '\\';
                c.is_whitespace() && !is_quoted && !is_escaped
            };
            let words = before_comment(list).split(ends).filter(|word| !word.is_empty());
            let found: Vec<_> = words.map(|word| (word, self.find(word))).collect();
            if found.iter().any(|(_, found)| !matches!(found, Err(Unread::Missing))) {
                return found;
            }
        }
        vec![(list, whole)]
    }

    /// The bytes of a file.
    pub(crate) fn read(&self, found: &Found<'a>) -> Result<Cow<'a, [u8]>, Unread> {
        if let Some(bytes) = found.given {
            return Ok(bytes.into());
        }
        let failed = |error: std::io::Error| Unread::Failed(error.to_string());
        let file = fs::File::open(&found.path).map_err(failed)?;
        // Not more than the file's length: special files of the system, which could wait for ever, have none.
        let length = file.metadata().map_err(failed)?.len();
        if length > LARGEST_FILE {
            return Err(Unread::TooLarge);
        }
        let mut bytes = Vec::new();
        file.take(length).read_to_end(&mut bytes).map_err(failed)?;
        Ok(bytes.into())
    }

    fn folder(&self) -> &'a Path {
        self.model.parent().unwrap_or(Path::new(""))
    }

    /// Whether a file may be read. It is not opened: that could wait for ever.
    fn check(&self, path: &Path) -> Result<(), Unread> {
        let real = path.canonicalize().map_err(|_| Unread::Missing)?;
        let folders = [Some(here(self.folder())), self.options.root.as_deref()];
        let is_in = |folder: &Path| folder.canonicalize().is_ok_and(|folder| real.starts_with(folder));
        if !folders.into_iter().flatten().any(is_in) {
            return Err(Unread::Outside);
        }
        real.is_file().then_some(()).ok_or(Unread::NotRegular)
    }
}

/// A folder by a path that may be empty.
fn here(folder: &Path) -> &Path {
    Some(folder).filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The path of what a folder has by this name, if need be with other capital letters.
fn present(folder: &Path, name: &str) -> Option<PathBuf> {
    let exact = folder.join(name);
    if name.is_empty() || exact.exists() {
        return Some(exact).filter(|_| !name.is_empty());
    }
    name.split('/').try_fold(folder.to_path_buf(), |folder, part| {
        let exact = folder.join(part);
        if exact.exists() {
            return Some(exact);
        }
        let names = fs::read_dir(here(&folder)).ok()?.flatten().map(|entry| entry.file_name());
        names.filter(|name| name.eq_ignore_ascii_case(part)).min().map(|name| folder.join(name))
    })
}
