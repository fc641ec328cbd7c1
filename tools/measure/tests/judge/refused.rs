//! The refusals of `refused.txt`: one line that names the file and the field or option, and no file is changed.

use crate::coverage::COVERAGE;
use crate::harness::{changed, Folder, RENDER};
use pinhole_apps_support::testing::refusal;
use serde_json::{json, Value};

/// The line that a program prints when it refuses an input of this kind.
fn refused(to: &Folder, kind: &str, input: &str) -> String {
    let value =
        || -> Value { serde_json::from_str(input).unwrap_or_else(|error| panic!("{input}: {error}")) };
    let table: Value = serde_json::from_str(include_str!("scenes.json")).unwrap();
    let of = |base: &str, changes: Value| changed(table["bases"][base]["scene"].clone(), &changes);
    let with = |changes: Value| of("triangles", changes);
    let mesh = |field: &str, mesh: Value| with(json!({"vertices": null, "triangles": null, field: mesh}));
    let sprite = |entry: Value| with(json!({"sprites": [changed(entry, &value())]}));
    let words: Vec<&str> = input.split_whitespace().collect();
    let scene = match kind {
        "scene" => with(value()),
        "space" => of(kind, value()),
        "camera" => with(json!({"camera": value(), "view": null, "projection": null})),
        "meshes" => mesh(kind, value()),
        "mesh" => {
            let (name, text) = input.split_once(": ").expect("a file and its text");
            to.write(name, text.replace("; ", "\n").replace(';', "\n"));
            mesh(kind, name.into())
        }
        "textured" => return to.refused(&of(kind, value()).to_string(), &["--texels", "texels"]),
        "square" => sprite(json!({"color": [1, 2, 3], "at": [0, 0, -2]})),
        "picture" => sprite(json!({"picture": "picture.png", "at": [0, 0, -2]})),
        "text" => return to.refused(input, &[]),
        "counts" => {
            to.write("in.json", input.replace("$DEEP", &"[".repeat(100_000)));
            return refusal(&COVERAGE.run_in(&to.0, &["in.json", "kept"]));
        }
        "coverage" => return refusal(&COVERAGE.run_in(&to.0, &words)),
        "render" => {
            to.write("s.json", with(json!({})).to_string());
            return refusal(&RENDER.run_in(&to.0, &words));
        }
        _ => panic!("{kind}: no kind of input"),
    };
    to.refused(&scene.to_string(), &[])
}

#[test]
fn what_is_refused_is_named_in_one_line() {
    let to = Folder::new("refused");
    to.png("picture.png", [2, 2], |_, _| [9, 8, 7, 255]);
    to.png("glass.png", [2, 2], |_, _| [9, 9, 9, 0]);
    to.write("text.png", "picture");
    to.write("far.obj", "v 0 1 2\nv 2 1 2\nv 0 3 2\nf 1 2 3\n");
    to.write("kept", "as it was");
    let (mut kind, mut rows, mut problems) = ("", 0, Vec::new());
    for line in include_str!("refused.txt").lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
    {
        let Some((input, words)) = line.split_once(" => ") else {
            kind = line.trim_matches(['[', ']']);
            continue;
        };
        to.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        to.write("in.json", r#"{"width": 1, "height": 1}"#);
        let said = refused(&to, kind, input);
        let written = ["none", "o", "out", "same", "target", "texels"].map(|name| to.0.join(name).exists());
        if !said.contains(words) || written != [false; 6] || to.read("kept") != b"as it was" {
            problems.push(format!("[{kind}] {line}\n{said}"));
        }
        rows += 1;
    }
    assert!(rows > 190 && problems.is_empty(), "of {rows}:\n{}", problems.join("\n"));
    assert!(RENDER.run(&["--help"]).status.success(), "help is no error");
}
