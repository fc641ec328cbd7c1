//! The host examples, run as programs.
#![allow(dead_code)] // every test file takes what it needs

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs an example, which `cargo test` has built beside the tests.
pub(crate) fn example<S: AsRef<OsStr>>(name: &str, arguments: &[S]) -> Output {
    example_in(Path::new("."), name, arguments)
}

/// The same in a folder.
pub(crate) fn example_in<S: AsRef<OsStr>>(folder: &Path, name: &str, arguments: &[S]) -> Output {
    command(folder, name, arguments).output().unwrap()
}

/// The same, not yet run.
pub(crate) fn command<S: AsRef<OsStr>>(folder: &Path, name: &str, arguments: &[S]) -> Command {
    let tests = std::env::current_exe().unwrap();
    let program =
        tests.with_file_name("../examples").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.exists(), "cargo test builds {name}, cargo test --test does not");
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder);
    command
}

/// An empty folder of a test's own.
pub(crate) fn folder(test: &str, name: &str) -> PathBuf {
    // Of this test alone, which runs in a thread of its name: others run at the same time and may say the same.
    let thread = std::thread::current();
    let own = thread.name().unwrap_or_default().replace("::", "_");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test).join(own).join(name);
    let _ = std::fs::remove_dir_all(&folder); // from an earlier run
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Asserts that a program refused: exit code 2, nothing on stdout, one line on stderr, which is given.
pub(crate) fn refusal(done: &Output) -> String {
    let said = String::from_utf8(done.stderr.clone()).unwrap();
    assert_eq!(done.status.code(), Some(2), "{said}");
    assert!(done.stdout.is_empty());
    assert_eq!(said.lines().count(), 1, "{said}");
    said
}
