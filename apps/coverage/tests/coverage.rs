//! `pinhole-coverage`: its formats, its counts against the exact oracles, and its messages for bad input.

use pinhole_apps_support::testing::{refusal, Program};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use support::oracle::cases::{self, Class, CLASSES};
use support::oracle::coverage::{self, Area, Counts, P};
use support::oracle::line;
use support::oracle::rng::Rng;

const COVERAGE: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-coverage"), env!("CARGO_TARGET_TMPDIR"));

fn folder(name: &str) -> PathBuf {
    COVERAGE.folder("coverage", name)
}

fn tool<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Output {
    COVERAGE.run(arguments)
}

/// The counts that the tool writes for a JSON text, and its output.
fn counts(folder: &Path, json: &str) -> (Vec<u32>, String) {
    let (from, to) = (folder.join("in.json"), folder.join("out"));
    fs::write(&from, json).unwrap();
    let done = tool(&[&from, &to]);
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
fn the_format_by_hand() {
    let folder = folder("format");
    // A square of two triangles, its centre line through both, and a line in row 1; 4 x 3 pixels, top row first.
    let text = r#"{
        "lines": [[-5, 1, 30000, 1]],
        "height": 3, "width": 4,
        "triangles": [[256, 0, 768, 0, 768, 512], [256, 0, 768, 512, 256, 512], [0, 0, 256, 0, 0, 256]]
    }"#;
    let (counts_of_it, said) = counts(&folder, text);
    assert_eq!(counts_of_it, [0, 1, 1, 0, 1, 2, 2, 1, 0, 0, 0, 0]);
    assert_eq!(said.lines().count(), 1);
    assert!(
        said.contains("4 x 3 pixels, 3 triangles, 1 lines; 6 pixels drawn, each at most 2 times"),
        "{said}"
    );
    // Nothing else is left in the folder.
    let mut names: Vec<_> = fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort_unstable();
    assert_eq!(names, ["in.json", "out"]);
}

#[test]
fn triangles_and_lines_may_be_missing_or_none() {
    let folder = folder("missing");
    for (text, wanted) in [
        (r#"{"width": 2, "height": 1}"#, [0, 0]),
        (r#"{"width": 2, "height": 1, "triangles": [], "lines": [ ]}"#, [0, 0]),
        (r#"{"width": 2, "height": 1, "lines": [[1, 0, 1, 0]]}"#, [0, 1]),
        (
            r#"{"width": 2, "height": 1, "triangles": [[0, 0, 256, 0, 0, -0], [0, 0, 256, 0, 0, 256]]}"#,
            [0, 0],
        ),
        (r#"{"width": 2, "height": 1, "triangles": [[0, 0, 257, 0, 0, 257]]}"#, [1, 0]),
    ] {
        assert_eq!(counts(&folder, text).0, wanted, "{text}");
    }
}

#[test]
fn pictures_of_every_class() {
    let folder = folder("pictures");
    let mut rng = Rng::new(0xC07);
    for (class, area) in CLASSES.into_iter().zip([
        Area::new(0, 0, 64, 64),
        Area::new(0, 0, 96, 40),
        Area::new(0, 0, 80, 80),
        Area::new(0, 0, 80, 80),
        Area::new(0, 0, 120, 90),
        Area::new(0, 0, 320, 240),
    ]) {
        let number = if class == Class::Huge { 60 } else { 1000 };
        let triangles: Vec<_> = (0..number).map(|_| cases::triangle(&mut rng, class)).collect();
        let drawn = same(&folder, area, &triangles, &[]);
        assert!(drawn > 100, "{class:?}: {drawn}");
    }
}

#[test]
fn pictures_of_lines_to_the_ends_of_the_range() {
    let folder = folder("lines");
    let mut rng = Rng::new(0xC08);
    for (w, h) in [(100, 100), (320, 240), (1, 4096), (4096, 1)] {
        let lines: Vec<_> = (0..2000).map(|_| cases::line(&mut rng)).collect();
        assert!(same(&folder, Area::new(0, 0, w, h), &[], &lines) > 500);
    }
}

#[test]
fn a_picture_of_all_together() {
    let folder = folder("together");
    let mut rng = Rng::new(0xC09);
    let triangles: Vec<_> = (0..600).map(|k| cases::triangle(&mut rng, CLASSES[k % CLASSES.len()])).collect();
    let lines: Vec<_> = (0..600).map(|_| cases::line(&mut rng)).collect();
    same(&folder, Area::new(0, 0, 160, 120), &triangles, &lines);
}

#[test]
fn the_largest_picture() {
    let folder = folder("largest");
    let far = cases::GUARD;
    let text = json(Area::new(0, 0, 4096, 4096), &[[(-far, -far), (far, -far), (far, far)]; 3], &[]);
    let (ours, _) = counts(&folder, &text);
    // Half of it, the diagonal included, as it is a left edge.
    for y in 0..4096 {
        let row = &ours[4096 * y..4096 * (y + 1)];
        assert!(row[..y].iter().all(|&n| n == 0) && row[y..].iter().all(|&n| n == 3), "row {y}");
    }
}

#[test]
fn bad_input_is_one_line_that_names_the_field() {
    let folder = folder("bad");
    let (from, to) = (folder.join("in.json"), folder.join("out"));
    let with = |rest: &str| format!(r#"{{"width": 8, "height": 8, {rest}}}"#);
    let sized = |w: &str, h: &str| format!(r#"{{"width": {w}, "height": {h}}}"#);
    let nested = "[".repeat(100_000);
    for (text, named) in [
        // Not JSON.
        (String::new(), "is not JSON: EOF while parsing a value"),
        ("pinhole".into(), "is not JSON: expected"),
        (with(r#""lines": [[0, 0, 1, 1]"#), "lines[1]: is not JSON"),
        (with(r#""lines": [[0, 0, NaN, 1]]"#), "lines[0][2]: is not JSON: expected value"),
        (with(r#""lines": [[0, 0, Infinity, 1]]"#), "lines[0][2]: is not JSON: expected value"),
        (with(r#""lines": [[0, 0, 01, 1]]"#), "lines[0][2]: is not JSON: invalid number"),
        (with(r#""lines": []"#) + "{}", "is not JSON: trailing characters"),
        ("{'width': 8, 'height': 8}".into(), "is not JSON: key must be a string"),
        (with(&format!(r#""lines": {nested}"#)), "lines[0][0]: is not JSON"),
        // Fields.
        ("[8, 8]".into(), "invalid type: sequence, expected an object"),
        ("null".into(), "invalid type: null, expected an object"),
        (r#"{"width": 8}"#.into(), "height: is missing"),
        (r#"{"height": 8, "lines": []}"#.into(), "width: is missing"),
        (r#"{"width": 8, "height": 8, "width": 8}"#.into(), "width: is given twice"),
        (with(r#""lines": [], "lines": []"#), "lines: is given twice"),
        (with(r#""triangles": [], "triangles": [[0, 0, 1, 1, 2, 2]]"#), "triangles: is given twice"),
        (with(r#""points": []"#), "points: is not a field of this format"),
        (with("\"two\\nlines\": []"), "two\\nlines: is not a field"),
        (with(r#""Lines": []"#), "Lines: is not a field of this format"),
        // Sizes.
        (sized("0", "1"), "width: 0 is not from 1 to 4096"),
        (sized("1", "4097"), "height: 4097 is not from 1 to 4096"),
        (sized("-3", "1"), "width: -3 is not from 1 to 4096"),
        (sized("8.5", "1"), "width: 8.5 is not an integer"),
        (sized("8e-1", "1"), "width: 8e-1 is not an integer"),
        (sized("1", "\"8\""), "height: \"8\" is not an integer"),
        (sized("1", "null"), "height: null is not an integer"),
        (sized("1", "[8]"), "height: [8] is not an integer"),
        (sized("4294967297", "1"), "width: 4294967297 is not from"),
        // Arrays.
        (
            with(r#""triangles": null"#),
            "triangles: invalid type: null, expected an array of arrays of 6 integers",
        ),
        (with(r#""triangles": {}"#), "triangles: invalid type: map"),
        (with(r#""triangles": [1, 2, 3, 4, 5, 6]"#), "triangles[0]: invalid type: integer `1`"),
        (
            with(r#""lines": [[0, 0, 1, 1], "no"]"#),
            "lines[1]: invalid type: string \"no\", expected an array of 4",
        ),
        (
            with(r#""triangles": [[1, 2, 3, 4, 5, 6], [1, 2, 3, 4, 5]]"#),
            "triangles[1]: has 5 numbers and needs 6",
        ),
        (with(r#""triangles": [[]]"#), "triangles[0]: has 0 numbers and needs 6"),
        (with(r#""triangles": [[1, 2, 3, 4, 5, 6, 7]]"#), "triangles[0]: has more than 6 numbers"),
        (with(r#""lines": [[1, 2, 3]]"#), "lines[0]: has 3 numbers and needs 4"),
        (with(r#""lines": [[1, 2, 3, 4, 5]]"#), "lines[0]: has more than 4 numbers"),
        // Numbers.
        (
            with(r#""triangles": [[1,2,3,4,5,6], [1,2,3,4,5,6], [1,2,3,4,5,6], [1,2,1.5,4,5,6]]"#),
            "triangles[3][2]: 1.5 is not an integer",
        ),
        (with(r#""lines": [[0, 1.25, 0, 0]]"#), "lines[0][1]: 1.25 is not an integer"),
        (with(r#""lines": [[0, 1e-2, 0, 0]]"#), "lines[0][1]: 1e-2 is not an integer"),
        (with(r#""lines": [[0, 1e400, 0, 0]]"#), "lines[0][1]: 1e400 is not an integer"),
        (with(r#""lines": [[0, true, 0, 0]]"#), "lines[0][1]: true is not an integer"),
        (with(r#""lines": [[0, [0], 0, 0]]"#), "lines[0][1]: [0] is not an integer"),
        (with(r#""lines": [[0, "0", 0, 0]]"#), "lines[0][1]: \"0\" is not an integer"),
        // One beyond the range, on each side.
        (
            with(r#""triangles": [[2097153, 0, 0, 0, 0, 0]]"#),
            "triangles[0][0]: 2097153 is not from -2097152 to",
        ),
        (with(r#""triangles": [[0, 0, 0, 0, 0, -2097153]]"#), "triangles[0][5]: -2097153 is not from"),
        (with(r#""lines": [[0, 0, 32768, 0]]"#), "lines[0][2]: 32768 is not from -32767 to 32767"),
        (with(r#""lines": [[0, -32768, 0, 0]]"#), "lines[0][1]: -32768 is not from -32767 to 32767"),
        (with(r#""lines": [[65536, 0, 0, 0]]"#), "lines[0][0]: 65536 is not from"),
        (
            with(r#""lines": [[18446744073709551616, 0, 0, 0]]"#),
            "lines[0][0]: 18446744073709551616 is not from",
        ),
        (
            with(&format!(r#""lines": [[{}, 0, 0, 0]]"#, "9".repeat(1000))),
            "lines[0][0]: 999999999999999999999999999999... is not from",
        ),
    ] {
        fs::write(&from, &text).unwrap();
        refused(&tool(&[&from, &to]), &[from.to_str().unwrap(), named]);
        assert!(!to.exists(), "{text}");
        // An older output stays as it is.
        fs::write(&to, "before").unwrap();
        refused(&tool(&[&from, &to]), &[named]);
        assert_eq!(fs::read(&to).unwrap(), b"before");
        fs::remove_file(&to).unwrap();
    }
    fs::write(&from, b"{\"width\": 1, \"height\": \xff}").unwrap();
    refused(&tool(&[&from, &to]), &[from.to_str().unwrap(), "is not JSON: invalid utf-8"]);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

fn refused(done: &Output, named: &[&str]) {
    let said = refusal(done);
    for name in named {
        assert!(said.contains(name), "{said:?} should contain {name:?}");
    }
}

#[test]
fn whole_numbers_may_be_written_as_floats() {
    let folder = folder("floats");
    let plain =
        r#"{"width": 8, "height": 10, "triangles": [[0, 0, 2048, 0, 0, 2560]], "lines": [[-1, 0, 7, 5]]}"#;
    let floats = r#"{"width": 8.0, "height": 1e1, "triangles": [[0.0, -0.0, 2.048e3, 0, 0e0, 2560.0]], "lines": [[-1.0, 0, 7, 5]]}"#;
    assert_eq!(counts(&folder, plain).0, counts(&folder, floats).0);
}

#[test]
fn the_ends_of_the_range_are_inside() {
    let folder = folder("range");
    let (far, end) = (cases::GUARD, cases::FARTHEST);
    let area = Area::new(0, 0, 33, 17);
    let triangles = [[(-far, -far), (far, -far), (-far, far)], [(far, far), (-far, 0), (0, -far)]];
    let lines = [((-end, -end), (end, end)), ((end, -end), (-end, end)), ((0, -end), (20, end))];
    assert!(same(&folder, area, &triangles, &lines) > 500);
}

#[test]
fn bad_arguments_and_files() {
    let folder = folder("files");
    let (from, to) = (folder.join("in.json"), folder.join("out"));
    fs::write(&from, r#"{"width": 1, "height": 1}"#).unwrap();
    let (from, to) = (from.to_str().unwrap(), to.to_str().unwrap());
    let (missing, below) = (format!("{from}.not"), format!("{from}/below"));
    let inside = folder.to_str().unwrap();
    refused(&tool::<&str>(&[]), &["<IN.json> <OUT>"]);
    refused(&tool(&[from]), &["<OUT>"]);
    refused(&tool(&[from, to, "third"]), &["'third'"]);
    refused(&tool(&["--size", from, to]), &["--size"]);
    refused(&tool(&[missing.as_str(), to]), &[&missing, "cannot be read"]);
    refused(&tool(&[inside, to]), &[inside, "cannot be read"]);
    refused(&tool(&[from, &below]), &[&below, "cannot be written"]);
    refused(&tool(&[from, inside]), &[inside, "cannot be written"]);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "in.json alone");
    let help = tool(&["--help"]);
    assert!(help.status.success() && help.stderr.is_empty());
    let said = String::from_utf8(help.stdout).unwrap();
    assert!(said.contains("<IN.json> <OUT>") && said.contains("8.0 is one"));
}
