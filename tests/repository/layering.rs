//! The library's modules import each other only as the table in ARCHITECTURE.md allows: each `crate::` and `super::` path
//! is compared with it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(support::ROOT)
}

/// The rows of the table: each module with the modules that it may import. `all` means every other module.
fn table() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let rows: Vec<Vec<&str>> = text
        .lines()
        .skip_while(|line| !line.starts_with("| module | may import |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let modules: Vec<String> = rows.iter().map(|row| row[0].trim_matches('`').to_string()).collect();
    rows.iter()
        .zip(&modules)
        .map(|(row, name)| {
            let imports = match row[1] {
                "–" => BTreeSet::new(),
                "all" => modules.iter().filter(|other| *other != name).cloned().collect(),
                // A remark in parentheses names no module.
                list => list
                    .split(',')
                    .map(|item| item.split('(').next().unwrap_or("").trim().to_string())
                    .filter(|item| modules.contains(item))
                    .collect(),
            };
            (name.clone(), imports)
        })
        .collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The module of a file, as its path from the crate's root.
fn module(path: &Path) -> Vec<String> {
    let relative = path.strip_prefix(root().join("src")).expect("below src");
    let mut parts: Vec<String> =
        relative.with_extension("").iter().map(|p| p.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod" || last == "lib") {
        parts.pop();
    }
    parts
}

/// The names right after each `prefix`: one name, or the names of a group in braces.
fn heads(code: &str, prefix: &str) -> Vec<String> {
    let ident = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut names = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find(prefix) {
        let whole_word = !rest[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$');
        rest = &rest[at + prefix.len()..];
        if !whole_word {
            continue;
        }
        if let Some(group) = rest.strip_prefix('{') {
            let (mut depth, mut start) = (0, 0);
            for (i, c) in group.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => {
                        names.push(ident(group[start..i].trim()));
                        break;
                    }
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        names.push(ident(group[start..i].trim()));
                        start = i + 1;
                    }
                    _ => {}
                }
            }
        } else {
            names.push(ident(rest));
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// The top-level modules that a file's code reaches.
fn reaches(path: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(path).expect("source");
    let code: String =
        text.lines().map(|line| line.split("//").next().unwrap_or("").to_string() + "\n").collect();
    let mut found: BTreeSet<String> = heads(&code, "crate::").into_iter().collect();
    // A file at depth n reaches the top-level modules by n times `super::`. In an inline module the name that follows is
    // not the name of a top-level module.
    let supers = heads(&code, &"super::".repeat(module(path).len().max(1)));
    found.extend(supers.into_iter().filter(|name| table().contains_key(name)));
    found
}

#[test]
fn the_table_names_every_module() {
    let table = table();
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(root().join("src")).expect("src") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if name != "lib" {
            names.insert(name);
        }
    }
    assert_eq!(names, table.keys().cloned().collect());
}

/// What `macro_export` puts at the crate's root and nowhere else, with the types of these names.
const MACROS: [&str; 4] = ["mesh_buffers", "strip_buffers", "MeshBuffers", "StripBuffers"];

#[test]
fn imports_go_one_way() {
    let table = table();
    let mut found = Vec::new();
    files(&root().join("src"), &mut found);
    assert!(found.len() > 10);
    let mut edges = 0;
    for path in found {
        let Some(own) = module(&path).first().cloned() else {
            continue; // lib.rs re-exports
        };
        for other in reaches(&path) {
            if own == "prelude" && MACROS.contains(&other.as_str()) {
                continue;
            }
            if other == own || !table.contains_key(&other) {
                // An item of the file's own module. Items re-exported at the crate's root are for users only.
                assert!(other == own || other == "tests", "{} reaches crate::{other}", path.display());
                continue;
            }
            edges += 1;
            assert!(table[&own].contains(&other), "{}: {own} may not import {other}", path.display());
        }
    }
    assert!(edges > 10, "only {edges} imports were found: the reader of sources misses some");
}

#[test]
fn the_table_has_the_order_of_the_pipeline() {
    let table = table();
    let of = |name: &str| table[name].iter().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(of("raster"), ["math"]);
    assert!(!of("camera").contains(&"clip") && !of("clip").contains(&"camera"));
    // No module reaches itself through its imports.
    for name in table.keys() {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&String> = table[name].iter().collect();
        while let Some(next) = open.pop() {
            assert_ne!(next, name, "{name} imports itself through other modules");
            if seen.insert(next) {
                open.extend(&table[next]);
            }
        }
    }
    // The draw calls use everything and nothing uses them; only they attach the fast paths; shaders stand on surfaces. The
    // prelude, which only exports again, is not part of the pipeline.
    for (name, imports) in &table {
        let importers: &[(&str, &[&str])] = &[
            ("pipeline", &[]),
            ("fast", &["pipeline"]),
            ("shading", &["fast", "pipeline"]),
            ("surface", &["shading", "fast", "pipeline"]),
        ];
        for (module, allowed) in importers {
            let may = name == module || name == "prelude" || allowed.contains(&name.as_str());
            assert!(may || !imports.contains(*module), "the table lets {name} import {module}");
        }
    }
}
