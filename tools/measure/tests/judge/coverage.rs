//! `pinhole-measure coverage`: its formats, and its counts against the exact oracles.

use pinhole_apps_support::testing::{self, Program};
use std::fs;
use std::path::{Path, PathBuf};
use support::oracle::cases::{self, Class, CLASSES};
use support::oracle::coverage::{self, Area, Counts, P};
use support::oracle::line;
use support::oracle::rng::Rng;

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

fn json(area: Area, triangles: &[[P; 3]], lines: &[(P, P)]) -> String {
    let triangles: Vec<_> = triangles.iter().map(|t| t.map(|p| [p.0, p.1]).concat()).collect();
    let lines: Vec<_> = lines.iter().map(|(a, b)| [a.0, a.1, b.0, b.1]).collect();
    format!(
        r#"{{"width": {}, "height": {}, "triangles": {triangles:?}, "lines": {lines:?}}}"#,
        area.width(),
        area.height()
    )
}

/// The picture against the oracles', which decide pixel by pixel.
fn same(folder: &Path, area: Area, triangles: &[[P; 3]], lines: &[(P, P)]) -> u64 {
    let mut exact = Counts::new(area);
    for &t in triangles {
        for (x, y) in area.pixels() {
            if coverage::covers(t, x, y) {
                exact.hit(x, y);
            }
        }
    }
    for &(a, b) in lines {
        for (x, y) in line::clipped(a, b, area) {
            exact.hit(x, y);
        }
    }
    let (ours, _) = counts(folder, &json(area, triangles, lines));
    assert_eq!(ours.len(), exact.hits.len());
    let differing = ours.iter().zip(&exact.hits).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 0, "{area:?}");
    exact.total()
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
fn pictures_of_every_class_are_those_of_the_oracle() {
    let folder = folder("pictures");
    let mut rng = Rng::new(0xC07);
    for (class, (width, height)) in
        CLASSES.into_iter().zip([(64, 64), (96, 40), (80, 80), (80, 80), (120, 90), (320, 240)])
    {
        let number = if class == Class::Huge { 60 } else { 1000 };
        let triangles: Vec<_> = (0..number).map(|_| cases::triangle(&mut rng, class)).collect();
        let lines: Vec<_> = (0..200).map(|_| cases::line(&mut rng)).collect();
        let drawn = same(&folder, Area::new(0, 0, width, height), &triangles, &lines);
        assert!(drawn > 100, "{class:?}: {drawn}");
    }
    for (width, height) in [(320, 240), (1, 4096), (4096, 1)] {
        let lines: Vec<_> = (0..2000).map(|_| cases::line(&mut rng)).collect();
        assert!(same(&folder, Area::new(0, 0, width, height), &[], &lines) > 500);
    }
    let (far, end) = (cases::GUARD, cases::FARTHEST);
    let triangles = [[(-far, -far), (far, -far), (-far, far)], [(far, far), (-far, 0), (0, -far)]];
    let lines = [((-end, -end), (end, end)), ((end, -end), (-end, end)), ((0, -end), (20, end))];
    assert!(same(&folder, Area::new(0, 0, 33, 17), &triangles, &lines) > 500);
}

#[test]
fn the_largest_picture() {
    let far = cases::GUARD;
    let text = json(Area::new(0, 0, 4096, 4096), &[[(-far, -far), (far, -far), (far, far)]; 3], &[]);
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
