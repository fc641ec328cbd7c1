//! Building for the emulated board and running on it, by `tools/cross`.

use crate::Result;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// This directory, and the project's.
pub(crate) const BENCH: &str = env!("CARGO_MANIFEST_DIR");

pub(crate) fn root() -> PathBuf {
    Path::new(BENCH).ancestors().nth(2).unwrap_or(Path::new(".")).to_path_buf()
}

/// One target at one level of optimisation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Build {
    pub(crate) target: &'static str,
    pub(crate) level: &'static str,
}

impl std::fmt::Display for Build {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at opt-level {}", self.target, self.level)
    }
}

impl Build {
    pub(crate) fn cargo(self, verb: &str, rest: &[String]) -> Result<()> {
        let mut command = self.command(verb);
        let status = command.args(rest).stdin(Stdio::null()).status()?;
        if !status.success() {
            return Err(format!("{command:?}: {status}").into());
        }
        Ok(())
    }

    /// Runs a firmware; returns its output and the depth of its stack.
    pub(crate) fn run(self, bin: &str) -> Result<(String, u64)> {
        let output = self.command("run").args(["--bin", bin]).stdin(Stdio::null()).output()?;
        let (printed, console) = (String::from_utf8(output.stdout)?, String::from_utf8(output.stderr)?);
        // The last thing that it writes to the emulator's console.
        let stack = console.lines().last().and_then(|line| u64::from_str_radix(line, 16).ok());
        match stack {
            Some(stack) if output.status.success() => Ok((printed, stack)),
            _ => Err(format!("{bin} for {}: {}\n{printed}{console}", self.target, output.status).into()),
        }
    }

    fn command(self, verb: &str) -> Command {
        let mut command = cross();
        command.args(["cargo", verb, "--quiet", "--locked", "--release", "--target", self.target]);
        command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", self.level);
        command
    }

    pub(crate) fn image(self, bin: &str) -> PathBuf {
        let built =
            std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target/cross"), PathBuf::from);
        built.join(self.target).join("release").join(bin)
    }
}

fn cross() -> Command {
    let mut command = Command::new("bash");
    // These would replace the flags by which firmware is linked.
    command
        .arg(root().join("tools/cross"))
        .current_dir(BENCH)
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

/// The compiler that the firmware is built with.
pub(crate) fn compiler() -> Result<String> {
    // The name of the target makes `tools/cross` choose the compiler.
    let output =
        cross().args(["bash", "-c", "\"${RUSTC:-rustc}\" --version", "--target", crate::M3]).output()?;
    let text = String::from_utf8(output.stdout)?;
    // Without the date and the distributor's additions.
    Ok(text.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}

/// The last commit.
pub(crate) fn commit() -> Result<String> {
    let output = Command::new("git").args(["rev-parse", "--short=8", "HEAD"]).current_dir(BENCH).output()?;
    Ok(String::from_utf8(output.stdout)?.trim().into())
}
