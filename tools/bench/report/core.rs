//! The emulated cores, and building and running images for them, by `tools/cross` and `tools/bench/emulate`.

use crate::{Result, M0, M3, RV32};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// This directory, and the project's.
const BENCH: &str = env!("CARGO_MANIFEST_DIR");

pub(crate) fn root() -> PathBuf {
    Path::new(BENCH).ancestors().nth(2).unwrap_or(Path::new(".")).to_path_buf()
}

/// At opt-level 3, the level for speed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Core {
    pub(crate) name: &'static str,
    pub(crate) target: &'static str,
}

pub(crate) const CORES: [Core; 4] = [
    Core { name: "M0", target: M0 },
    Core { name: "M3", target: M3 },
    Core { name: "M4F", target: "thumbv7em-none-eabihf" },
    Core { name: "RV32", target: RV32 },
];

impl Core {
    pub(crate) const fn build(self) -> Build {
        Build { target: self.target, level: "3" }
    }
}

/// Runs a firmware on a board of `tools/bench/emulate`, that of a core or another one, and returns its output.
pub(crate) fn run(board: &str, image: &Path) -> Result<String> {
    printed(&mut emulate(board, image))
}

/// Runs a command and returns what it prints.
fn printed(command: &mut Command) -> Result<String> {
    let output = command.output()?;
    let (printed, console) = (String::from_utf8(output.stdout)?, String::from_utf8_lossy(&output.stderr));
    match output.status.success() {
        true => Ok(printed.trim().into()),
        false => Err(format!("{command:?}: {}\n{printed}{console}", output.status).into()),
    }
}

/// Further arguments are QEMU's.
pub(crate) fn emulate(board: &str, image: &Path) -> Command {
    let mut command = Command::new("bash");
    command.arg("emulate").arg(board).arg(image);
    command.current_dir(BENCH).stdin(Stdio::null());
    command
}

/// One target at one level of optimisation.
#[derive(Clone, Copy, PartialEq, Eq)]
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

    /// Runs a firmware; returns the depth of its stack.
    pub(crate) fn stack(self, bin: &str) -> Result<u64> {
        let output = self.command("run").args(["--bin", bin]).stdin(Stdio::null()).output()?;
        let console = String::from_utf8(output.stderr)?;
        // The last thing that it writes to the emulator's console.
        let stack = console.lines().last().and_then(|line| u64::from_str_radix(line, 16).ok());
        match stack {
            Some(stack) if output.status.success() => Ok(stack),
            _ => Err(format!("{bin} for {}: {}\n{console}", self.target, output.status).into()),
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
    let text = printed(cross().args(["bash", "-c", "\"${RUSTC:-rustc}\" --version", "--target", crate::M3]))?;
    // Without the date and the distributor's additions.
    Ok(text.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}

/// The last commit.
pub(crate) fn commit() -> Result<String> {
    printed(Command::new("git").args(["rev-parse", "--short=8", "HEAD"]).current_dir(BENCH))
}

/// Applies `each` to all items, as many at a time as the host has cores; returns the results in order. Instructions are counted by
/// the emulator's own clock, so tasks that run at the same time change no count.
pub(crate) fn side_by_side<T: Sync, R: Send>(
    these: &[T],
    each: impl Fn(&T) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    these.par_iter().map(each).collect()
}
