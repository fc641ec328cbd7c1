//! Building firmware and running it on an emulated core, by `tools/cross`.

use crate::Result;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// This directory, and the project's.
const HERE: &str = env!("CARGO_MANIFEST_DIR");

pub(crate) fn root() -> PathBuf {
    Path::new(HERE).ancestors().nth(2).unwrap_or(Path::new(".")).to_path_buf()
}

fn cross() -> Command {
    let mut command = Command::new("bash");
    // These would replace the flags by which firmware is linked.
    command.arg("../cross").current_dir(HERE).env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    command
}

/// Builds a firmware for all these targets at once, on as many cores as there are.
pub(crate) fn build(bin: &str, targets: &[&str]) -> Result<()> {
    let mut command = cross();
    command.args(["cargo", "build", "--quiet", "--locked", "--release", "--bin", bin]);
    command.args(targets.iter().flat_map(|target| ["--target", target]));
    let status = command.stdin(Stdio::null()).status()?;
    if !status.success() {
        return Err(format!("{command:?}: {status}").into());
    }
    Ok(())
}

/// Runs a firmware, and returns its output.
pub(crate) fn run(bin: &str, target: &str) -> Result<String> {
    let mut command = cross();
    command.args(["cargo", "run", "--quiet", "--locked", "--release", "--bin", bin, "--target", target]);
    let output = command.stdin(Stdio::null()).output()?;
    if !output.status.success() {
        let console = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{bin} for {target}: {}\n{console}", output.status).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The compiler that builds firmware here, which the target decides.
pub(crate) fn compiler() -> Result<String> {
    let version = "\"${RUSTC:-rustc}\" --version";
    let output = cross().args(["bash", "-c", version, "--target", crate::speed::CORES[0].1]).output()?;
    let text = String::from_utf8(output.stdout)?;
    // Without the date and the distributor's additions.
    Ok(text.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}
