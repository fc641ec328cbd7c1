//! Files of the repository that examples make.
#![allow(dead_code)] // some make pages, some pictures

use crate::command::{complain, matches, option, say};
use crate::files;
use clap::{value_parser, Arg, ArgAction, ArgMatches, Command};
use std::path::PathBuf;
use std::process::ExitCode;

/// A file of the repository that an example makes.
pub(crate) struct Generated {
    example: &'static str,
    out: PathBuf,
    check: bool,
}

impl Generated {
    pub(crate) fn arguments(
        example: &'static str,
        about: &'static str,
        out: &'static str,
    ) -> Result<Self, String> {
        let mut given = matches(Self::command(example, about, out))?;
        Ok(Self::from(example, &mut given))
    }

    /// For an example that can be told more.
    pub(crate) fn command(example: &'static str, about: &'static str, out: &'static str) -> Command {
        let check = Arg::new("check").long("check").action(ArgAction::SetTrue);
        Command::new(example)
            .about(about)
            .arg(option("out", "FILE", "The file", out).value_parser(value_parser!(PathBuf)))
            .arg(check.help("Write nothing; exit code 1 if the file is not what would be written"))
    }

    /// `example` as it follows `--example`.
    pub(crate) fn from(example: &'static str, given: &mut ArgMatches) -> Self {
        let out = given.remove_one("out").unwrap_or_default();
        Self { example, out, check: given.get_flag("check") }
    }

    /// Writes the file, or compares it.
    pub(crate) fn finish(self, content: &[u8]) -> Result<ExitCode, String> {
        self.finish_showing(content, |_| ())
    }

    /// The same for a page; the first line that changed shows.
    pub(crate) fn finish_page(self, page: &str) -> Result<ExitCode, String> {
        self.finish_showing(page.as_bytes(), |old| {
            let old = String::from_utf8_lossy(old);
            if let Some((old, new)) = old.lines().zip(page.lines()).find(|(old, new)| old != new) {
                complain(format_args!("- {old}\n+ {new}"));
            }
        })
    }

    fn finish_showing(self, content: &[u8], difference: impl FnOnce(&[u8])) -> Result<ExitCode, String> {
        let (example, out) = (self.example, self.out.display());
        if !self.check {
            files::write(&[(&*self.out, content)])?;
            say(&out)?;
            return Ok(ExitCode::SUCCESS);
        }
        let file = std::fs::read(&self.out).map_err(|e| format!("{out}: cannot be read: {e}"))?;
        if file == content {
            return Ok(ExitCode::SUCCESS);
        }
        difference(&file);
        complain(format_args!(
            "{out}: not current: run cargo run --release --example {example} -- --out {out}"
        ));
        Ok(ExitCode::from(1))
    }
}
