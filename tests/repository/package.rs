//! The published packages hold the library and its documentation, nothing large, and miss nothing. The workspaces of the repository lock
//! the same versions of what they share, so that a dependency is downloaded and, with a common target folder, compiled once.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;
use support::ROOT;

/// Bounds of a file, of the pictures in the documentation, and of a package, in bytes.
const FILE: u64 = 48 << 10;
const PICTURES: u64 = 30_000;
const ALL: u64 = 58 << 15; // a third are unit tests, which stand beside the code

/// The files of a package of the workspace, with their sizes. Files that cargo adds, such as Cargo.lock, are left out: no
/// dependent sees them.
fn files(package: &str, folder: &str) -> Vec<(String, u64)> {
    let mut list = Command::new(env!("CARGO"));
    list.args(["package", "--list", "--allow-dirty", "--offline", "--package", package]).current_dir(ROOT);
    let done = list.output().expect("cargo");
    let (names, problem) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{problem}");
    let folder = Path::new(ROOT).join(folder);
    let size = |name: &str| fs::metadata(folder.join(name)).map(|file| file.len()).ok();
    let own = names.lines().filter(|name| *name != "Cargo.lock");
    own.filter_map(|name| Some((name.to_string(), size(name)?))).collect()
}

#[test]
fn packages_are_small() {
    for (package, folder) in [("pinhole", ""), ("pinhole-import", "import")] {
        let files = files(package, folder);
        assert!(files.len() > 5, "{package}: {files:?}");
        for (name, size) in &files {
            let most = if name == "src/book/pictures.md" { PICTURES } else { FILE };
            assert!(*size <= most, "{package}: {name} has {size} bytes");
        }
        let all: u64 = files.iter().map(|(_, size)| size).sum();
        println!("{package}: {} files, {all} bytes", files.len());
        assert!(all <= ALL, "{package}: {all} bytes");
    }
}

/// The documentation, on a site of its own, links to sources of the package: each of them must be in it.
#[test]
fn what_the_documentation_links_to_is_in_the_package() {
    const SOURCES: &str = "https://docs.rs/crate/pinhole/latest/source/";
    let names: Vec<String> = files("pinhole", "").into_iter().map(|(name, _)| name).collect();
    let links = fs::read_to_string(Path::new(ROOT).join("src/book/links.md")).expect("links");
    let targets: Vec<&str> = links.lines().filter_map(|line| Some(line.split_once(SOURCES)?.1)).collect();
    assert!(targets.len() >= 10, "{targets:?}");
    for target in targets {
        assert!(names.iter().any(|name| name == target), "{target} is linked to and not in the package");
    }
}

#[test]
fn the_package_holds_the_library_and_nothing_else() {
    let names: Vec<String> = files("pinhole", "").into_iter().map(|(name, _)| name).collect();
    for name in ["Cargo.toml", "README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "src/lib.rs"] {
        assert!(names.iter().any(|n| n == name), "{name} is missing");
    }
    // Every file that the sources include.
    let mut included = 0;
    for source in names.iter().filter(|name| name.ends_with(".rs")) {
        let folder = Path::new(source).parent().expect("a folder");
        let text = fs::read_to_string(Path::new(ROOT).join(source)).expect("source");
        for rest in text.split("include_str!(\"").skip(1) {
            let path = Path::new(rest.split('"').next().expect("a path"));
            let up = path.components().filter(|part| *part == Component::ParentDir).count();
            let folder = folder.ancestors().nth(up).expect("a folder");
            let file = folder.join(path.components().skip(up).collect::<PathBuf>());
            let file = file.to_string_lossy().into_owned();
            assert!(names.contains(&file), "{source} includes {file}");
            included += 1;
        }
    }
    assert!(included > 5, "no include_str! was found in the sources");
    let others = ["apps/", "tests/", "tools/", "examples/", "boards/", "import/", "fuzz/", "assets/", ".ci"];
    for name in &names {
        assert!(!others.iter().any(|other| name.starts_with(other)), "{name} is not part of the library");
    }
}

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
    let root = Path::new(ROOT);
    let listed =
        Command::new("git").args(["ls-files", "*Cargo.lock"]).current_dir(root).output().expect("git");
    let files = String::from_utf8(listed.stdout).unwrap();
    let texts = files.lines().map(|file| fs::read_to_string(root.join(file)).unwrap()).collect::<Vec<_>>();
    assert!(texts.len() > 5, "{files}");
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
