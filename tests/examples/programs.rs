//! What all examples promise about their films, standard output and files. The programs in `apps` promise it in tests of their own.

use crate::{command, example, folder};
use pinhole_apps_support::testing;
use std::collections::BTreeSet;
use std::fs::{self, File};

/// A film has its frames, which differ, and its sheet.
#[test]
fn films_have_their_frames_and_sheets() {
    let out = folder("spin", "film");
    let done = example("spin", &["--size", "32", "--frames", "6", "--out", out.to_str().unwrap()]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let said = String::from_utf8(done.stdout).unwrap();
    assert!(
        said.contains("3 frames, 2976 drawn, 2976 culled") && said.contains(out.to_str().unwrap()),
        "{said}"
    );
    assert!(!said.contains('\u{1b}'), "no colours in a pipe");
    let mut gif = gif::DecodeOptions::new().read_info(File::open(out.join("spin.gif")).unwrap()).unwrap();
    assert_eq!((gif.width(), gif.height()), (32, 32));
    let mut found = BTreeSet::new();
    while let Some(frame) = gif.read_next_frame().unwrap() {
        found.insert(frame.buffer.to_vec());
    }
    assert_eq!(found.len(), 6, "each frame differs");
    assert_eq!(testing::picture(&out.join("spin.png")).0, [128, 64]);
}

/// Examples that write files into their working folder and print what they wrote.
const PRINTING: [(&str, &str); 3] = [
    ("spin", "--size 16 --frames 2 --out spin"),
    ("gallery", "--out gallery.png"),
    ("cookbook", "--out cookbook"),
];

#[test]
fn closed_output_is_no_error() {
    for (name, line) in PRINTING {
        let words: Vec<_> = line.split_whitespace().collect();
        testing::closed_output_is_no_error(command(&folder("tools", "closed"), name, &words));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_output_is_an_error() {
    for (name, line) in PRINTING {
        let words: Vec<_> = line.split_whitespace().collect();
        testing::full_output_is_an_error(command(&folder("tools", "full"), name, &words));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn failed_write_changes_nothing() {
    for (name, line, output) in [
        ("gallery", "--out gallery.png", "gallery.png"),
        ("cookbook", "--out .", "logo.png"),
        ("spin", "--size 16 --frames 2 --out .", "spin.gif"),
    ] {
        for before in [None, Some("before")] {
            let to = folder("tools", "no_room");
            if let Some(before) = before {
                fs::write(to.join(output), before).unwrap();
            }
            let words: Vec<_> = line.split(' ').collect();
            testing::failed_write_changes_nothing(&command(&to, name, &words), &to, output);
        }
    }
}
