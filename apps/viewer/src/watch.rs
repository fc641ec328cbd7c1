//! Whether files have changed since they were read.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// When a file was written, and its length; `None` where there is no file.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(file: &Path) -> Stamp {
    let there = file.metadata().ok()?;
    Some((there.modified().ok()?, there.len()))
}

/// A file that is about to be read.
pub(crate) struct Before(PathBuf, Stamp);

impl Before {
    pub(crate) fn reading(file: &Path) -> Self {
        Self(file.to_path_buf(), stamp(file))
    }
}

/// Files that were read, and what they looked like.
#[derive(Default)]
pub(crate) struct Watch {
    files: Vec<PathBuf>,
    /// At the last look.
    last: Vec<Stamp>,
    /// When [`Self::has_changed`] told of a change.
    told: Vec<Stamp>,
}

impl Watch {
    /// Watches a file that was read, and the files beside it that were found in it.
    pub(crate) fn of(Before(file, before): Before, beside: impl Iterator<Item = PathBuf>) -> Self {
        let files: Vec<_> = std::iter::once(file).chain(beside).collect();
        let read: Vec<_> = std::iter::once(before).chain(files[1..].iter().map(|file| stamp(file))).collect();
        Self { files, last: read.clone(), told: read }
    }

    fn now(&self) -> Vec<Stamp> {
        self.files.iter().map(|file| stamp(file)).collect()
    }

    /// Whether files have changed, and stayed as they are since the last call, so that nobody is writing them. Tells of each change
    /// once.
    pub(crate) fn has_changed(&mut self) -> bool {
        let now = self.now();
        let is_settled = now == self.last;
        self.last.clone_from(&now);
        let is_news = is_settled && now != self.told;
        if is_news {
            self.told = now;
        }
        is_news
    }
}
