//! The command.
#![cfg(feature = "cli")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn import(arguments: &[&Path]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pinhole-import")).args(arguments).output().unwrap()
}

/// A path for a file of this test run.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[test]
fn writes_rust_and_says_what_it_did() {
    let (model, output) = (scratch("triangle.obj"), scratch("triangle.rs"));
    std::fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let done = import(&[&model, Path::new("-o"), &output]);
    assert!(done.status.success(), "{done:?}");
    let said = String::from_utf8(done.stdout).unwrap();
    assert!(said.contains("3 vertices, 1 faces, 3 edges"), "{said}");
    let source = std::fs::read_to_string(&output).unwrap();
    assert!(source.contains("pub const FACES: [[u16; 3]; 1] = [\n    [0,1,2],\n];"));
}

#[test]
fn broken_input_is_one_line_exit_code_2_and_no_output() {
    let (broken, output) = (scratch("broken.obj"), scratch("broken.rs"));
    std::fs::write(&broken, "v 0 0 0\nv 1 0\n").unwrap();
    for model in [&broken, &scratch("missing.obj")] {
        let done = import(&[model, Path::new("-o"), &output]);
        assert_eq!(done.status.code(), Some(2));
        assert!(done.stdout.is_empty());
        let said = String::from_utf8(done.stderr).unwrap();
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.starts_with(model.to_str().unwrap()), "{said}");
        assert!(!output.exists());
    }
}
