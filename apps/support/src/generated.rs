//! Files of the repository that a program generates, or with `--check` compares.

use crate::command::{complain, folder, matches, option, say};
use crate::files;
use clap::{value_parser, Arg, ArgAction, ArgMatches, Command};
use std::path::PathBuf;
use std::process::ExitCode;

/// A generated file of the repository, or a folder of such.
pub struct Generated {
    program: &'static str,
    /// The file, and what the command line has for `--out`.
    out: PathBuf,
    given: PathBuf,
    check: bool,
}

impl Generated {
    /// Parses the command line of a program that takes `--out` and `--check` alone. `program` is what follows `cargo run
    /// --release`, `about` its description, `out` the default file. The error is the message to print where an argument is wrong.
    pub fn arguments(program: &'static str, about: &'static str, out: &'static str) -> Result<Self, String> {
        let mut given = matches(Self::command(program, about, out))?;
        Ok(Self::from(program, &mut given))
    }

    /// The command line with `--out` and `--check`, for a program that adds options of its own.
    pub fn command(program: &'static str, about: &'static str, out: &'static str) -> Command {
        let check = Arg::new("check").long("check").action(ArgAction::SetTrue);
        Command::new(program)
            .about(about)
            .arg(option("out", "PATH", "What to write", out).value_parser(value_parser!(PathBuf)))
            .arg(check.help("Write nothing; exit with code 1 if the file is out of date"))
    }

    /// Takes `--out` and `--check` from a parsed command line.
    pub fn from(program: &'static str, given: &mut ArgMatches) -> Self {
        let out: PathBuf = given.remove_one("out").unwrap_or_default();
        Self { program, given: out.clone(), out, check: given.get_flag("check") }
    }

    /// A file in this folder.
    #[must_use]
    pub fn within(&self, name: &str) -> Self {
        Self { out: self.out.join(name), given: self.given.clone(), ..*self }
    }

    /// Writes the file, or compares it. The error names the file where it cannot be written or read.
    pub fn finish(self, content: &[u8]) -> Result<ExitCode, String> {
        self.finish_showing(content, |_| ())
    }

    /// Writes a page, or compares it and prints the first line that differs. The error names the file where it cannot be written or
    /// read.
    pub fn finish_page(self, page: &str) -> Result<ExitCode, String> {
        self.finish_showing(page.as_bytes(), |old| {
            let old = String::from_utf8_lossy(old);
            if let Some((old, new)) = old.lines().zip(page.lines()).find(|(old, new)| old != new) {
                complain(format_args!("- {old}"));
                complain(format_args!("+ {new}"));
            }
        })
    }

    fn finish_showing(self, content: &[u8], difference: impl FnOnce(&[u8])) -> Result<ExitCode, String> {
        let (program, out) = (self.program, self.out.display());
        if !self.check {
            self.out.parent().map_or(Ok(()), folder)?;
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
            "{out}: out of date: run cargo run --release {program} -- --out {}",
            self.given.display()
        ));
        Ok(ExitCode::from(1))
    }
}
