//! Each public trait says what to do where a type does not implement it: the compiler's own message names the trait alone. It
//! shows the line of a function whose argument has another type.

use std::fs;
use std::path::{Path, PathBuf};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files(&path, found),
            false => found.push(path),
        }
    }
}

/// The public traits of a source file that users meet, each with whether its message says what to do.
fn traits(source: &str) -> Vec<(String, bool)> {
    let mut found = Vec::new();
    let (mut is_explained, mut in_attribute) = (false, false);
    for line in source.lines() {
        if line == "#[diagnostic::on_unimplemented(" {
            in_attribute = true;
        } else if in_attribute {
            is_explained |= line.trim_start().starts_with("note = ");
            in_attribute = line != ")]";
        } else if let Some(rest) = line.strip_prefix("pub trait ") {
            found.push((
                rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("").to_string(),
                is_explained,
            ));
            is_explained = false;
        } else if !line.starts_with("#[") && !line.starts_with("//") {
            is_explained = false;
        }
    }
    found
}

#[test]
fn every_public_trait_says_what_to_do() {
    let mut paths = Vec::new();
    files(&Path::new(support::ROOT).join("src"), &mut paths);
    let mut count = 0;
    for path in paths {
        for (name, is_explained) in traits(&fs::read_to_string(&path).expect("a source")) {
            assert!(
                is_explained,
                "{}: {name} has no `diagnostic::on_unimplemented` with a note",
                path.display()
            );
            count += 1;
        }
    }
    assert!(count >= 12, "only {count} traits were found");
}

#[test]
fn the_line_shown_for_a_coordinate_of_another_type_says_how_to_make_a_scalar() {
    let source = include_str!("../../src/math/point.rs");
    let line = source.lines().find(|line| line.contains("fn new(x: Scalar,")).expect("a constructor");
    for way in ["Scalar::from_int(", "from_ratio(", "from_f32("] {
        assert!(line.contains(way), "{line}");
    }
}

#[test]
fn a_trait_without_a_note_is_found() {
    let message = "#[diagnostic::on_unimplemented(\n    message = \"a\",\n    note = \"b\"\n)]\n";
    let source = format!("{message}pub trait One {{}}\n{message}struct S;\npub trait Two: One {{}}\n");
    assert_eq!(traits(&source), [("One".to_string(), true), ("Two".to_string(), false)]);
}
