//! GLOSSARY.md explains every public type, trait, function and constant of the library.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(support::ROOT).join(path)).expect(path)
}

/// The names in backticks in the third column of the glossary's tables, and the parts of `Type::function`.
fn explained(glossary: &str) -> BTreeSet<String> {
    let rows = glossary.lines().filter(|line| line.starts_with('|'));
    let thirds = rows.filter_map(|line| line.trim_matches('|').split('|').nth(2));
    let code = thirds.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    code.flat_map(|name| name.trim_end_matches("()").split("::")).map(str::to_string).collect()
}

/// The names that `pub use module::{...};` exports.
fn exported(root: &str) -> BTreeSet<String> {
    let uses = root.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    let names = uses.flat_map(|path| path.split(['{', '}', ',']).skip(1)).map(str::trim);
    names.filter(|name| !name.is_empty()).map(str::to_string).collect()
}

/// The names of public items at the top level of a file of a public module, of those that documentation shows.
fn declared(source: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for line in source.lines() {
        let Some(item) = line.strip_prefix("pub ") else { continue };
        let item = item.strip_prefix("const fn ").map_or(item.to_string(), |rest| format!("fn {rest}"));
        let mut words = item.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|w| !w.is_empty());
        if let (Some("struct" | "enum" | "trait" | "fn" | "const" | "type"), Some(name)) =
            (words.next(), words.next())
        {
            names.insert(name.to_string());
        }
    }
    names
}

/// What `src/lib.rs` exports, and what its public modules declare or export.
fn public() -> BTreeSet<String> {
    let mut names = exported(&read("src/lib.rs"));
    for file in ["src/clip.rs", "src/meshes.rs", "src/space.rs"] {
        names.extend(declared(&read(file)));
    }
    let raster = read("src/raster/mod.rs");
    names.extend(declared(&raster));
    for path in raster.lines().filter_map(|line| line.strip_prefix("pub use ")) {
        let items = path.trim_end_matches(';').rsplit("::").next().unwrap_or("");
        let items = items.trim_matches(['{', '}']).split(',').map(str::trim);
        names.extend(items.filter(|name| !name.is_empty()).map(str::to_string));
    }
    names
}

#[test]
fn every_public_name_is_in_the_glossary() {
    let explained = explained(&read("GLOSSARY.md"));
    let public = public();
    for known in [
        "Camera",
        "MeshInstance",
        "SpanShader",
        "edge_faces",
        "Barycentric",
        "GUARD_BAND",
        "Gradient",
        "area",
    ] {
        assert!(public.contains(known), "{known} is public, but this test does not find it");
    }
    let missing: Vec<_> = public.difference(&explained).collect();
    assert!(missing.is_empty(), "GLOSSARY.md has no entry for {missing:?}");
}

#[test]
fn a_missing_name_is_found() {
    let page =
        "| mesh | a mesh | `Mesh`, `Mesh::faces` | RTR |\n| edge | an edge | `edge_faces()` | – |\n`Prose`\n";
    let found = explained(page);
    assert_eq!(found.iter().map(String::as_str).collect::<Vec<_>>(), ["Mesh", "edge_faces", "faces"]);
    assert!(exported("pub use a::{B,\n    C};").contains("C"));
    assert!(declared("pub const fn f() {}\npub(crate) struct Hidden;\npub trait Seen {}").len() == 2);
}
