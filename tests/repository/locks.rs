//! The workspaces of the repository lock the same versions of what they share, so that a dependency is downloaded and, with
//! a common target folder, compiled once.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The names and versions of the packages that a lock file takes from a registry.
fn packages(lock: &str) -> Vec<(&str, &str)> {
    let value = |entry: &'_ str, key: &str| -> Option<(usize, usize)> {
        let start = entry.find(&format!("\n{key} = \""))? + key.len() + 5;
        Some((start, start + entry[start..].find('"')?))
    };
    lock.split("[[package]]")
        .filter(|entry| value(entry, "source").is_some())
        .map(|entry| {
            let text = |key| value(entry, key).map(|(start, end)| &entry[start..end]).unwrap();
            (text("name"), text("version"))
        })
        .collect()
}

/// What versions that may stand for each other have in common: the first number that is not 0, and those before it.
fn compatible(version: &str) -> &str {
    let zeros = version.len() - version.trim_start_matches("0.").len();
    version[zeros..].find('.').map_or(version, |dot| &version[..zeros + dot])
}

#[test]
fn workspaces_lock_equal_versions_of_what_they_share() {
    assert_eq!(["1.2.3", "0.4.1", "0.0.7"].map(compatible), ["1", "0.4", "0.0.7"]);
    let root = Path::new(support::ROOT);
    let listed =
        Command::new("git").args(["ls-files", "*Cargo.lock"]).current_dir(root).output().expect("git");
    let files = String::from_utf8(listed.stdout).unwrap();
    let texts = files.lines().map(|file| fs::read_to_string(root.join(file)).unwrap()).collect::<Vec<_>>();
    assert!(texts.len() > 10, "{files}");
    let mut versions: BTreeMap<_, BTreeSet<&str>> = BTreeMap::new();
    for (name, version) in texts.iter().flat_map(|text| packages(text)) {
        versions.entry((name, compatible(version))).or_default().insert(version);
    }
    assert!(versions.contains_key(&("fixed", "1")));
    versions.retain(|_, versions| versions.len() > 1);
    assert!(
        versions.is_empty(),
        "lock files have different versions of these; run `cargo update --package NAME@FROM --precise TO` beside some: {versions:#?}"
    );
}
