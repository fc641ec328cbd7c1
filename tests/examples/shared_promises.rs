//! What all examples promise about standard output and files. The programs in `apps` promise it in tests of their own.

use crate::programs::{command, folder, testing};
#[cfg(target_os = "linux")]
use std::fs;

/// Examples that write files into their working folder and print what they wrote.
const PRINTING: [(&str, &str); 6] = [
    ("spin", "--size 16 --frames 2 --out spin"),
    ("arm", "--size 16 --frames 2 --out arm"),
    ("surface", "--size 16 --frames 2 --out surface"),
    ("bands", "--out bands"),
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
        ("bands", "--out .", "bands.png"),
        ("cookbook", "--out .", "logo.png"),
        ("spin", "--size 16 --frames 2 --out .", "spin.gif"),
        ("surface", "--size 16 --frames 2 --out .", "surface.gif"),
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
