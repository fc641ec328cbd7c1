//! `pinhole-measure coverage`: its formats, and its counts against the exact oracles.

use pinhole_apps_support::testing::{self, Program};
use std::fs;
use std::path::{Path, PathBuf};
use support::oracle::cases::{self, CLASSES};
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

/// The picture against the oracles', which decide pixel by pixel. Returns how often pixels are drawn.
fn same(folder: &Path, area: Area, triangles: &[[P; 3]], lines: &[(P, P)]) -> u64 {
    let mut exact = Counts::new(area);
    let is_in = |t: &[P; 3]| {
        let t = *t;
        area.pixels().filter(move |&(x, y)| coverage::covers(t, x, y))
    };
    let of_lines = lines.iter().flat_map(|&(a, b)| line::clipped(a, b, area));
    triangles.iter().flat_map(is_in).chain(of_lines).for_each(|(x, y)| exact.hit(x, y));
    let (ours, _) = counts(folder, &json(area, triangles, lines));
    assert!(ours == exact.hits, "{area:?}");
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

/// Triangles of every class and lines, to the ends of their ranges, in pictures of every shape. What the rasteriser draws of a million of
/// them is tested in `tests/raster/random_shapes.rs`.
#[test]
fn pictures_are_those_of_the_oracle() {
    let (folder, mut rng) = (folder("pictures"), Rng::new(0xC07));
    let (far, end) = (cases::GUARD, cases::FARTHEST);
    for (width, height) in [(64, 64), (320, 240), (33, 17), (1, 4096), (4096, 1)] {
        let mut triangles =
            vec![[(-far, -far), (far, -far), (-far, far)], [(far, far), (-far, 0), (0, -far)]];
        triangles.extend(CLASSES.repeat(50).into_iter().map(|class| cases::triangle(&mut rng, class)));
        let mut lines = vec![((-end, -end), (end, end)), ((end, -end), (-end, end)), ((0, -end), (20, end))];
        lines.extend((0..1000).map(|_| cases::line(&mut rng)));
        assert!(same(&folder, Area::new(0, 0, width, height), &triangles, &lines) > 1000);
    }
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
