//! `pinhole-measure coverage`: its formats. What the rasteriser draws is compared with the exact oracles in `tests/raster`.

use pinhole_apps_support::testing::{self, Program};
use std::fs;
use std::path::{Path, PathBuf};
use support::oracle::cases;

pub(crate) const COVERAGE: Program =
    Program::new(env!("CARGO_BIN_EXE_pinhole-measure"), env!("CARGO_TARGET_TMPDIR")).subcommand("coverage");

fn folder(name: &str) -> PathBuf {
    COVERAGE.folder("coverage", name)
}

/// The counts that the tool writes for a JSON text, and its output.
fn counts(folder: &Path, json: &str) -> (Vec<u32>, String) {
    let (from, to) = (folder.join("in.json"), folder.join("out"));
    fs::write(&from, json).unwrap();
    let done = COVERAGE.run(&[&from, &to]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let bytes = fs::read(to).unwrap();
    assert_eq!(bytes.len() % 4, 0);
    let words = bytes.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    (words, String::from_utf8(done.stdout).unwrap())
}

#[test]
fn counts_by_hand() {
    let folder = folder("format");
    for (text, wanted) in [
        // A square of two triangles, its centre line through both, and a line in row 1; 4 x 3 pixels, top row first.
        (
            r#"{"lines": [[-5, 1, 30000, 1]], "height": 3, "width": 4,
            "triangles": [[256, 0, 768, 0, 768, 512], [256, 0, 768, 512, 256, 512], [0, 0, 256, 0, 0, 256]]}"#,
            &[0, 1, 1, 0, 1, 2, 2, 1, 0, 0, 0, 0][..],
        ),
        (r#"{"width": 2, "height": 1}"#, &[0, 0]),
        (r#"{"width": 2, "height": 1, "triangles": [], "lines": [ ]}"#, &[0, 0]),
        (r#"{"width": 2.0, "height": 1e0, "lines": [[1, -0.0, 1.0, 0]]}"#, &[0, 1]),
        (r#"{"width": 2, "height": 1, "triangles": [[0, 0, 256, 0, 0, 256]]}"#, &[0, 0]),
        (r#"{"width": 2, "height": 1, "triangles": [[0, 0, 2.57e2, 0, 0, 257]]}"#, &[1, 0]),
    ] {
        let (counts, said) = counts(&folder, text);
        assert_eq!(counts, wanted, "{text}");
        let drawn = wanted.iter().filter(|&&count| count > 0).count();
        assert!(said.contains(&format!("; {drawn} pixels drawn, each at most")), "{said}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "the input and the output");
}

#[test]
fn the_largest_picture() {
    let far = cases::GUARD;
    let half = format!("[-{far}, -{far}, {far}, -{far}, {far}, {far}]");
    let text = format!(r#"{{"width": 4096, "height": 4096, "triangles": [{half}, {half}, {half}]}}"#);
    let (ours, _) = counts(&folder("largest"), &text);
    // Half of it, the diagonal included, as it is a left edge.
    for y in 0..4096 {
        let row = &ours[4096 * y..4096 * (y + 1)];
        assert!(row[..y].iter().all(|&n| n == 0) && row[y..].iter().all(|&n| n == 3), "row {y}");
    }
}

#[test]
fn files_are_as_of_all_programs() {
    let folder = folder("files");
    fs::write(folder.join("in.json"), r#"{"width": 1, "height": 1}"#).unwrap();
    testing::input_is_not_overwritten(COVERAGE, &folder, "in.json", "in.json");
    testing::closed_output_is_no_error(COVERAGE.command(&folder, &["in.json", "out"]));
}
