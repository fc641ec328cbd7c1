//! Models in a project that was made from a template: what its build script says of them, and what `--firmware` draws and says.
//! `pinhole-preview` is `pinhole-render` with a project's code; here it has the picture of `rp2040-st7789`.

use pinhole_apps_support::bodies::{cuboid, gear, obj, reversed, stl, Body};
use pinhole_apps_support::testing::Program;
use std::fs;
use std::process::Output;

const TMP: &str = env!("CARGO_TARGET_TMPDIR");
const PREVIEW: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-preview"), TMP);
const SCRIPT: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-template-build-script"), TMP);

/// What the templates' build script prints where its model is a file with these bytes.
fn build(bytes: &[u8]) -> Output {
    let folder = SCRIPT.folder("projects", "build");
    let shared = SCRIPT.folder("projects", "common/all");
    fs::write(shared.join("model.stl"), bytes).unwrap();
    let mut script = SCRIPT.command(&folder, &[""; 0]);
    script.env("OUT_DIR", &folder).env("CARGO_MANIFEST_DIR", &folder).output().unwrap()
}

/// The lines of output that begin so, without their beginnings.
fn lines<'o>(out: &'o [u8], start: &str) -> Vec<&'o str> {
    std::str::from_utf8(out).unwrap().lines().filter_map(|line| line.strip_prefix(start)).collect()
}

/// A model with a doubt, which the build script and the preview word by their own options, and what the preview says if it is given the
/// option that helps, which the project's build script should then have, too.
#[test]
fn both_say_what_to_do() {
    // Every second face of a gear reversed.
    let mut mixed = gear();
    mixed.iter_mut().step_by(2).for_each(|[_, b, c]| std::mem::swap(b, c));
    let cube = cuboid([2.0; 3]);
    let inside_out = "parts inside out: 1 of 1, the first at triangle 1; the outside shows nothing: use ";
    // Of the first side without the bottom, the second triangle has an edge at the bottom.
    let open =
        "open edges: 4, the first at triangle 4; faces show nothing from behind: close the surface, or use ";
    for (body, doubt, field, option, then) in [
        (gear(), "", "", "", ""),
        (reversed(&gear()), inside_out, "`flip: true`", "--flip", ", unless it is a room seen from inside"),
        (mixed, "; some faces will be culled: use ", "`fix_winding: true`", "--fix-winding", ""),
        (cube[2..].to_vec(), open, "`two_sided: true`", "--two-sided", ""),
        (
            [&cube[..], &cube[3..4]].concat(),
            "duplicate faces: 1, the first at triangle 13; dropped, which changes no picture",
            "",
            "",
            "",
        ),
    ] {
        let in_script = if field.is_empty() { "" } else { " (in the `Options` of build.rs)" };
        let done = build(&stl(&body));
        assert!(done.status.success(), "{done:?}");
        let said = lines(&done.stdout, "cargo::warning=../common/all/model.stl: ");
        let is_said = |said: &[&str], wanted: String| match doubt {
            "" => said.is_empty(),
            _ => said.len() == 1 && said[0].ends_with(&wanted),
        };
        assert!(is_said(&said, format!("{doubt}{field}{then}{in_script}")), "{said:?}");

        let folder = PREVIEW.folder("projects", "preview");
        fs::write(folder.join("part.stl"), stl(&body)).unwrap();
        let preview = |option: &str| {
            let words = ["part.stl", "--firmware", "--size", "64x48", option];
            let done = PREVIEW.run_in(&folder, &words[..if option.is_empty() { 4 } else { 5 }]);
            let drawn = lines(&done.stdout, "");
            let by = "common: drawn by its src/picture.rs and build.rs";
            assert!(done.status.success() && drawn.iter().any(|line| line.ends_with(by)), "{done:?}");
            done.stderr
        };
        let out = preview("");
        let said = lines(&out, "part.stl: warning: ");
        assert!(is_said(&said, format!("{doubt}{option}{then}")), "{said:?}");
        if !option.is_empty() {
            let note = "part.stl: note: set the same in the `Options` of the project's build.rs, so that the firmware draws this picture";
            assert_eq!(lines(&preview(option), ""), [note]);
        }
    }
}

/// An error is one line, which cargo prints, and names no option of a command line.
#[test]
fn the_build_script_refuses_in_one_line() {
    let mut cells = Body::new();
    for (x, y) in (0..210).flat_map(|y| (0..210).map(move |x| (f64::from(x), f64::from(y)))) {
        // Apart, so that no vertex is shared.
        cells.push([[x, y, 0.0], [x + 0.5, y, 0.0], [x, y + 0.5, 0.0]]);
    }
    for (bytes, what) in [
        (stl(&cells), "has 132300 vertices, more than the 65536 of a mesh: use `decimate: Some(N)` with"),
        (stl(&Body::new()), "has no faces: export the model as a mesh"),
        (obj(&gear()).into_bytes(), "is text, but no ASCII STL"),
        (stl(&gear())[..2000].to_vec(), "copy or export it again"),
    ] {
        let done = build(&bytes);
        // It fails the build, and cargo shows nothing else.
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        let errors = lines(&done.stdout, "cargo::error=");
        let [said] = errors[..] else { panic!("{done:?}") };
        assert!(
            said.starts_with("../common/all/model.stl: ") && said.contains(what) && !said.contains("--"),
            "{said}"
        );
    }
}
