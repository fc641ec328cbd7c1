//! `pinhole-measure coverage`: its formats, its counts against the exact oracles, and its messages for bad input.

use pinhole_apps_support::testing::{self, refusal, Program};
use std::fs;
use std::path::{Path, PathBuf};
use support::oracle::cases::{self, Class, CLASSES};
use support::oracle::coverage::{self, Area, Counts, P};
use support::oracle::line;
use support::oracle::rng::Rng;

const COVERAGE: Program =
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
fn bad_input_is_one_line_that_names_the_field() {
    let folder = folder("bad");
    let with = |rest: &str| format!(r#"{{"width": 8, "height": 8, {rest}}}"#);
    let line = |numbers: &str| with(&format!(r#""lines": [[{numbers}]]"#));
    let triangle = |numbers: &str| with(&format!(r#""triangles": [[1, 2, 3, 4, 5, 6], [{numbers}]]"#));
    let sized = |width: &str| format!(r#"{{"width": {width}, "height": 1}}"#);
    for (text, named) in [
        (String::new(), "is not JSON: EOF while parsing a value"),
        ("pinhole".into(), "is not JSON: expected"),
        (with(r#""lines": [[0, 0, 1, 1]"#), "lines: is not JSON: expected `,` or `]`"),
        (line("0, 0, NaN, 1"), "lines[0][2]: is not JSON: expected value"),
        (line("0, 0, 1e400, 1"), "lines[0][2]: is not JSON: number out of range"),
        (with(r#""lines": []"#) + "{}", "is not JSON: trailing characters"),
        (with(&format!(r#""lines": {}"#, "[".repeat(100_000))), "lines[0][0]"),
        ("[8, 8]".into(), "is not an object"),
        ("null".into(), "is not an object"),
        (r#"{"width": 8}"#.into(), "missing field `height`"),
        (r#"{"height": 8, "lines": []}"#.into(), "missing field `width`"),
        (r#"{"width": 8, "height": 8, "width": 8}"#.into(), "duplicate field `width`"),
        (with(r#""points": []"#), "points: unknown field `points`"),
        (sized("0"), "width: 0 is not from 1 to 4096"),
        (sized("4097"), "width: 4097 is not from 1 to 4096"),
        (sized("8.5"), "width: 8.5 is not a whole number"),
        (sized("\"8\""), "width: invalid type: string \"8\""),
        (with(r#""triangles": null"#), "triangles: invalid type: null"),
        (with(r#""triangles": [1, 2, 3, 4, 5, 6]"#), "triangles[0]: invalid type: integer `1`"),
        (triangle("1, 2, 3, 4, 5"), "triangles[1]: invalid length 5"),
        (triangle("1, 2, 3, 4, 5, 6, 7"), "triangles[1]: is not JSON: trailing characters"),
        (triangle("1, 2, 1.5, 4, 5, 6"), "triangles[1][2]: 1.5 is not a whole number"),
        (triangle("2097153, 0, 0, 0, 0, 0"), "triangles[1][0]: 2097153 is not from -2097152 to"),
        (triangle("0, 0, 0, 0, 0, -2097153"), "triangles[1][5]: -2097153 is not from"),
        (line("0, 0, 32768, 0"), "lines[0][2]: 32768 is not from -32767 to 32767"),
        (line("0, -32768, 0, 0"), "lines[0][1]: -32768 is not from"),
        (line("0, true, 0, 0"), "lines[0][1]: invalid type: boolean `true`"),
        (line("1, 2, 3"), "lines[0]: invalid length 3"),
    ] {
        fs::write(folder.join("in.json"), &text).unwrap();
        fs::write(folder.join("out"), "before").unwrap();
        let said = refusal(&COVERAGE.run_in(&folder, &["in.json", "out"]));
        assert!(said.starts_with("in.json: ") && said.contains(named), "{said:?} should contain {named:?}");
        assert_eq!(fs::read(folder.join("out")).unwrap(), b"before");
    }
}

#[test]
fn bad_arguments_are_one_line_and_files_stay() {
    let folder = folder("files");
    fs::write(folder.join("in.json"), r#"{"width": 1, "height": 1}"#).unwrap();
    for (arguments, named) in [
        (&[][..], "<IN.json> <OUT>"),
        (&["in.json"], "<OUT>"),
        (&["in.json", "out", "third"], "'third'"),
        (&["--size", "in.json", "out"], "--size"),
        (&["none.json", "out"], "none.json: cannot be read"),
        (&[".", "out"], ".: cannot be read"),
        (&["in.json", "in.json/below"], "in.json/below: cannot be written"),
        (&["in.json", "."], ".: cannot be written"),
    ] {
        let said = refusal(&COVERAGE.run_in(&folder, arguments));
        assert!(said.contains(named), "{said}");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "in.json alone");
    }
    testing::input_is_not_overwritten(COVERAGE, &folder, "in.json", "in.json");
    testing::closed_output_is_no_error(COVERAGE.command(&folder, &["in.json", "out"]));
}
