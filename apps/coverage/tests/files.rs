//! Standard output and files: the output never replaces the input, and a run that fails changes no file.

use pinhole_apps_support::testing::{self, Program};
use std::fs;
use std::path::PathBuf;

const COVERAGE: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-coverage"), env!("CARGO_TARGET_TMPDIR"));
const ARGUMENTS: [&str; 2] = ["in.json", "out"];

/// A folder with an input of one triangle, `in.json`.
fn folder(name: &str) -> PathBuf {
    let to = COVERAGE.folder("files", name);
    let input = r#"{"width": 2, "height": 1, "triangles": [[0, 0, 257, 0, 0, 257]]}"#;
    fs::write(to.join("in.json"), input).unwrap();
    to
}

#[test]
fn closed_output_is_no_error() {
    testing::closed_output_is_no_error(COVERAGE.command(&folder("closed"), &ARGUMENTS));
}

#[cfg(target_os = "linux")]
#[test]
fn full_output_is_an_error() {
    testing::full_output_is_an_error(COVERAGE.command(&folder("full"), &ARGUMENTS));
}

#[test]
fn input_is_not_overwritten() {
    testing::input_is_not_overwritten(COVERAGE, &folder("input"), "in.json", "in.json");
}

#[cfg(target_os = "linux")]
#[test]
fn failed_write_changes_nothing() {
    for before in [None, Some("before")] {
        let to = folder("no_room");
        if let Some(before) = before {
            fs::write(to.join("out"), before).unwrap();
        }
        testing::failed_write_changes_nothing(&COVERAGE.command(&to, &ARGUMENTS), &to, "out");
    }
}

#[cfg(unix)]
#[test]
fn replaced_file_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let to = folder("permissions");
    fs::write(to.join("out"), "before").unwrap();
    fs::set_permissions(to.join("out"), fs::Permissions::from_mode(0o640)).unwrap();
    let done = COVERAGE.run_in(&to, &ARGUMENTS);
    assert!(done.status.success(), "{done:?}");
    assert_eq!(fs::metadata(to.join("out")).unwrap().permissions().mode() & 0o777, 0o640);
}
