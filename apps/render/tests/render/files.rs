//! Standard output and files: an output never replaces an input, and a run that fails changes no file.

use pinhole_apps_support::testing::{self, Program};
use std::fs;
use std::path::PathBuf;

const RENDER: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-render"), env!("CARGO_TARGET_TMPDIR"));

/// A scene whose mesh is the file `m.obj`.
const SCENE: &str = r#"{"mesh": "m.obj", "width": 8, "height": 8,
    "model": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "view": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]],
    "projection": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]}"#;

/// Command lines that print.
const PRINTING: [&str; 2] = ["m.obj --png p.png --size 16x16", "m.obj --ascii --stats"];

/// A tetrahedron: closed, so that nothing is said of it.
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A folder with a mesh, `m.obj`, and a scene that names it, `s.json`.
fn folder(name: &str) -> PathBuf {
    let to = RENDER.folder("files", name);
    fs::write(to.join("m.obj"), MESH).unwrap();
    fs::write(to.join("s.json"), SCENE).unwrap();
    to
}

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

#[test]
fn closed_output_is_no_error() {
    for line in PRINTING {
        testing::closed_output_is_no_error(RENDER.command(&folder("closed"), &words(line)));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_output_is_an_error() {
    for line in PRINTING {
        testing::full_output_is_an_error(RENDER.command(&folder("full"), &words(line)));
    }
}

#[test]
fn input_is_not_overwritten() {
    for (input, line) in [
        ("m.obj", "m.obj --png"),
        ("m.obj", "m.obj --png new --gif"),
        ("s.json", "s.json --png"),
        ("m.obj", "s.json --png"),
    ] {
        testing::input_is_not_overwritten(RENDER, &folder("input"), input, line);
    }
    // What materials name, though it is not shown.
    for input in ["skin.mtl", "skin.png"] {
        for line in
            ["skin.obj --png", "skin.obj --firmware --png", "skin.obj --texture 4 --png", "s.json --png"]
        {
            let to = folder("named");
            testing::textured(&to);
            if input == "skin.mtl" {
                let text = fs::read_to_string(to.join("skin.obj")).unwrap();
                fs::write(to.join("skin.obj"), text.replace("usemtl", "# no")).unwrap();
            }
            fs::write(to.join("s.json"), SCENE.replace("m.obj", "skin.obj")).unwrap();
            testing::input_is_not_overwritten(RENDER, &to, input, line);
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn failed_write_changes_nothing() {
    for before in [None, Some("before")] {
        let to = folder("no_room");
        if let Some(before) = before {
            fs::write(to.join("p.png"), before).unwrap();
        }
        let command = RENDER.command(&to, &words("m.obj --size 16x16 --png p.png"));
        testing::failed_write_changes_nothing(&command, &to, "p.png");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_device_leaves_other_outputs_unchanged() {
    let to = folder("device");
    fs::write(to.join("film"), "before").unwrap();
    // --png is written last.
    let line = "m.obj --size 16x16 --gif film --frames 2 --png /dev/full";
    let text = testing::refusal(&RENDER.run_in(&to, &words(line)));
    assert!(text.starts_with("/dev/full: cannot be written: "), "{text}");
    assert_eq!(fs::read(to.join("film")).unwrap(), b"before");
    // A device that takes the bytes is written to, and stays a device.
    let done = RENDER.run_in(&to, &words("m.obj --size 1x1 --gif new --frames 2 --png /dev/stdout"));
    assert!(
        done.status.success() && done.stdout.starts_with(b"\x89PNG") && to.join("new").exists(),
        "{done:?}"
    );
}
