//! The examples, run as a user runs them: their pictures and films, and their messages for bad input.

mod cookbook;
mod spin;

use pinhole_apps_support::testing;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs an example, which `cargo test` has built beside the tests.
fn example<S: AsRef<OsStr>>(name: &str, arguments: &[S]) -> Output {
    command(Path::new("."), name, arguments).output().unwrap()
}

/// An example with its arguments and working folder, not started yet.
fn command<S: AsRef<OsStr>>(folder: &Path, name: &str, arguments: &[S]) -> Command {
    let tests = std::env::current_exe().unwrap();
    let program =
        tests.with_file_name("../examples").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.exists(), "`cargo test` builds {name}; with `--package pinhole-tests` or `--test`, run `cargo test --package pinhole --no-run` before");
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder);
    command
}

/// An empty folder that no other test uses.
fn folder(test: &str, name: &str) -> PathBuf {
    testing::folder(Path::new(env!("CARGO_TARGET_TMPDIR")), test, name)
}
