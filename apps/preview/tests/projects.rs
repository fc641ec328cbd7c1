//! Models in a project that was made from a template: what its build script says of them, and what `--firmware` draws and says.
//! `pinhole-preview` is `pinhole-render` with a project's code; here it has the RP2040's template.

use pinhole_apps_support::bodies::{cuboid, gear, obj, reversed, stl, Body};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("projects").join(name);
    let _ = fs::remove_dir_all(&folder); // of an earlier run
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// What the template's build script prints where its model is `model.stl` with these bytes.
fn build(name: &str, bytes: &[u8]) -> Output {
    let folder = folder(name);
    fs::write(folder.join("model.stl"), bytes).unwrap();
    let mut script = Command::new(env!("CARGO_BIN_EXE_pinhole-template-build-script"));
    script.current_dir(&folder).env("OUT_DIR", &folder).env("CARGO_MANIFEST_DIR", &folder);
    script.output().unwrap()
}

/// The warnings that cargo shows of it.
#[track_caller]
fn warnings(name: &str, body: &Body) -> Vec<String> {
    let done = build(name, &stl(body));
    assert!(done.status.success(), "{done:?}");
    let said = String::from_utf8(done.stdout).unwrap();
    said.lines().filter_map(|line| line.strip_prefix("cargo::warning=")).map(Into::into).collect()
}

/// Every second face of a gear reversed.
fn mixed() -> Body {
    let mut body = gear();
    body.iter_mut().step_by(2).for_each(|[_, b, c]| std::mem::swap(b, c));
    body
}

fn open() -> Body {
    cuboid([2.0; 3])[2..].to_vec()
}

fn doubled() -> Body {
    let mut body = cuboid([2.0; 3]);
    body.push(body[3]);
    body
}

#[test]
fn the_build_script_says_what_to_write_into_it() {
    assert_eq!(warnings("sound", &gear()), [""; 0]);
    let in_options = "(in the `Options` of build.rs)";
    assert_eq!(
        warnings("flipped", &reversed(&gear())),
        [format!(
            "model.stl: parts inside out: 1 of 1, the first at triangle 1; the outside shows nothing: use `flip: true`, unless \
             it is a room seen from inside {in_options}"
        )]
    );
    let said = warnings("mixed", &mixed());
    assert!(
        said.len() == 1 && said[0].starts_with("model.stl: edges between faces of opposite winding: "),
        "{said:?}"
    );
    let then = format!("; some faces will be culled: use `fix_winding: true` {in_options}");
    assert!(said[0].ends_with(&then), "{said:?}");
    // Of the first side without the top, which is the second after two triangles of the bottom, the second triangle has an edge
    // at the top.
    assert_eq!(
        warnings("open", &open()),
        [format!(
            "model.stl: open edges: 4, the first at triangle 4; faces show nothing from behind: close the surface, or use \
             `two_sided: true` {in_options}"
        )]
    );
    assert_eq!(
        warnings("doubled", &doubled()),
        ["model.stl: duplicate faces: 1, the first at triangle 13; dropped, which changes no picture"]
    );
}

/// An error is one line, which cargo prints, and names no option of a command line.
#[test]
fn the_build_script_refuses_in_one_line() {
    let mut cells = Body::new();
    for (x, y) in (0..210).flat_map(|y| (0..210).map(move |x| (f64::from(x), f64::from(y)))) {
        // Apart, so that no vertex is shared.
        cells.push([[x, y, 0.0], [x + 0.5, y, 0.0], [x, y + 0.5, 0.0]]);
    }
    for (name, bytes, what) in [
        (
            "vast",
            stl(&cells),
            "has 132300 vertices, more than the 65536 of a mesh: use `decimate: Some(N)` with",
        ),
        ("none", stl(&Body::new()), "has no faces: export the model as a mesh"),
        ("text", obj(&gear()).into_bytes(), "is text, but no ASCII STL"),
        ("short", stl(&gear())[..2000].to_vec(), "copy or export it again"),
    ] {
        let done = build(name, &bytes);
        // It fails the build, and cargo shows nothing else.
        assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
        let said = String::from_utf8(done.stdout).unwrap();
        let errors: Vec<_> = said.lines().filter_map(|line| line.strip_prefix("cargo::error=")).collect();
        let [said] = errors[..] else { panic!("{said}") };
        assert!(said.starts_with("model.stl: ") && said.contains(what) && !said.contains("--"), "{said}");
    }
}

/// What `pinhole-preview` says on standard error of a model in a folder.
fn said(folder: &Path, name: &str, body: &Body, options: &[&str]) -> Vec<String> {
    fs::write(folder.join(name), stl(body)).unwrap();
    let mut preview = Command::new(env!("CARGO_BIN_EXE_pinhole-preview"));
    let done = preview
        .current_dir(folder)
        .arg(name)
        .args(["--firmware", "--size", "64x48"])
        .args(options)
        .output()
        .unwrap();
    assert!(done.status.success(), "{done:?}");
    let out = String::from_utf8(done.stdout).unwrap();
    assert!(out.contains("rp2040-st7789: drawn by its src/picture.rs and build.rs"), "{out}");
    String::from_utf8(done.stderr).unwrap().lines().map(Into::into).collect()
}

#[test]
fn the_preview_of_firmware_says_what_to_do() {
    let to = folder("preview");
    let note = |name: &str| {
        format!("{name}: note: set the same in the `Options` of the project's build.rs, so that the firmware draws this picture")
    };
    assert_eq!(said(&to, "gear.stl", &gear(), &[]), [""; 0]);
    assert_eq!(
        said(&to, "flipped.stl", &reversed(&gear()), &[]),
        ["flipped.stl: warning: parts inside out: 1 of 1, the first at triangle 1; the outside shows nothing: use --flip, unless \
          it is a room seen from inside"]
    );
    assert_eq!(said(&to, "flipped.stl", &reversed(&gear()), &["--flip"]), [note("flipped.stl")]);
    let flipped = said(&to, "gear.stl", &gear(), &["--flip"]);
    assert!(
        flipped.len() == 2
            && flipped[0].contains("nothing: leave out --flip, unless")
            && !flipped[0].contains("use --flip")
    );
    let lines = said(&to, "mixed.stl", &mixed(), &[]);
    assert!(lines.len() == 1 && lines[0].ends_with(": use --fix-winding"), "{lines:?}");
    assert_eq!(said(&to, "mixed.stl", &mixed(), &["--fix-winding"]), [note("mixed.stl")]);
    let lines = said(&to, "open.stl", &open(), &[]);
    assert!(lines.len() == 1 && lines[0].ends_with(": close the surface, or use --two-sided"), "{lines:?}");
    assert_eq!(said(&to, "open.stl", &open(), &["--two-sided"]), [note("open.stl")]);
    let lines = said(&to, "doubled.stl", &doubled(), &[]);
    assert!(
        lines.len() == 1 && lines[0].contains("duplicate faces: 1, the first at triangle 13; dropped"),
        "{lines:?}"
    );
}
