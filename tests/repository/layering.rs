//! The library's modules import each other only as the table in ARCHITECTURE.md allows, and no files import each other in a
//! cycle.
//!
//! An import is a path from `crate`, `super`, `self` or a child module in code that is no test. It leads to the file that defines
//! the name, so a `mod.rs` that only declares and exports again is never part of a cycle.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use support::ROOT;

type Graph<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// The code of a file, without comments and tests.
fn code(text: &str) -> String {
    let (mut code, mut in_test) = (String::new(), false);
    for line in text.lines() {
        let line = line.split("//").next().unwrap_or("");
        in_test |= line == "#[cfg(test)]";
        code += if in_test { "" } else { line };
        code.push('\n');
        // Until the last line of the item.
        in_test &= line != "}" && (line.starts_with(' ') || !line.ends_with(';'));
    }
    code
}

/// The code of each file of the library.
fn sources() -> BTreeMap<String, String> {
    support::sources().into_iter().map(|(file, text)| (file, code(&text))).collect()
}

/// The module of a file, from the crate's root.
fn module(file: &str) -> Vec<&str> {
    let parts = file.trim_end_matches(".rs").split('/');
    parts.filter(|part| *part != "mod" && *part != "lib").collect()
}

/// Words, `::` and single characters.
fn tokens(code: &str) -> Vec<&str> {
    let (mut found, mut rest) = (Vec::new(), code.trim_start());
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let end = if rest.starts_with("::") { 2 } else { word.max(first.len_utf8()) };
        found.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    found
}

/// The imports of a file, as paths from the crate's root, but for names that it only exports again.
fn imports<'a>(file: &'a str, tokens: &[&'a str]) -> Vec<Vec<&'a str>> {
    let (own, mut found) = (module(file), Vec::new());
    // The path that is read, those around the open braces of a tree `a::{b, c::d}`, and whether it is exported again.
    let (mut path, mut around, mut is_exported) = (Vec::new(), Vec::<Vec<&str>>::new(), false);
    for (at, &token) in tokens.iter().enumerate() {
        let before = if at > 0 { tokens[at - 1] } else { "" };
        match token {
            "use" => is_exported = matches!(before, "pub" | ")"),
            ";" => is_exported = false,
            "{" if before == "::" => around.push(path.clone()),
            "}" => _ = around.pop(),
            _ => {}
        }
        if !token.starts_with(|c: char| c.is_alphabetic() || c == '_') || [token, before].contains(&"as") {
            continue;
        }
        if before != "::" {
            path = around.last().cloned().unwrap_or_default();
        }
        path.push(token);
        let is_child = || tokens.windows(3).any(|w| w[0] == "mod" && w[1] == path[0] && w[2] == ";");
        let is_inside = matches!(path[0], "crate" | "super" | "self") || is_child();
        let is_only_exported = || is_exported && tokens.iter().filter(|other| **other == token).count() == 1;
        if tokens.get(at + 1) == Some(&"::") || path.len() == 1 || !is_inside || is_only_exported() {
            continue;
        }
        let supers = path.iter().filter(|part| **part == "super").count();
        let from = if path[0] == "crate" { &[] } else { &own[..own.len() - supers] };
        let names = path.iter().filter(|part| !matches!(**part, "crate" | "super" | "self"));
        found.push(from.iter().chain(names).copied().collect());
    }
    found
}

/// The files that each file imports.
fn graph(files: &BTreeMap<String, String>) -> Graph<'_> {
    const ITEMS: [&str; 8] = ["fn", "struct", "enum", "trait", "type", "static", "const", "macro_rules"];
    let tokens: BTreeMap<&str, Vec<&str>> =
        files.iter().map(|(file, code)| (file.as_str(), tokens(code))).collect();
    let defines = |file: &str, name: &str| {
        let items = tokens[file].windows(3).filter(|w| ITEMS.contains(&w[0]));
        items.into_iter().any(|w| w[1] == name || w[1] == "!" && w[2] == name)
    };
    let modules: BTreeMap<Vec<&str>, &str> = tokens.keys().map(|file| (module(file), *file)).collect();
    let mut edges = Graph::new();
    for (&file, tokens) in &tokens {
        for path in imports(file, tokens) {
            let at = (0..=path.len()).rev().find(|&n| modules.contains_key(&path[..n])).expect("the root");
            let (Some(name), module) = (path.get(at), &path[..at]) else { continue };
            // In the module itself, below it, or anywhere; a macro may have made it in the module.
            let own = [modules[module]]
                .into_iter()
                .chain(modules.iter().filter(|other| other.0.starts_with(module)).map(|(_, file)| *file));
            let target = own.chain(modules.values().copied()).find(|file| defines(file, name));
            edges.entry(file).or_default().insert(target.unwrap_or(modules[module]));
        }
    }
    edges.iter_mut().for_each(|(file, imports)| _ = imports.remove(file));
    edges
}

/// The rows of the table: each module with the modules that it may import. A remark in parentheses names no module.
fn table() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(Path::new(ROOT).join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let rows = text.lines().skip_while(|line| !line.starts_with("| module | may import |")).skip(2);
    let rows = rows.map_while(|line| line.strip_prefix("| `")?.split_once("` | "));
    let name = |item: &str| item.split(['(', '|']).next().unwrap_or("").trim().to_string();
    let list = |cells: &str| {
        cells.split(" |").next().unwrap_or("").split(", ").map(name).filter(|n| n != "–").collect()
    };
    rows.map(|(name, cells)| (name.to_string(), list(cells))).collect()
}

#[test]
fn imports_go_one_way() {
    let (files, table) = (sources(), table());
    let edges = graph(&files);
    for (file, imports) in edges.iter().filter(|(file, _)| **file != "lib.rs") {
        for other in imports {
            let (own, from) = (module(file)[0], module(other).first().copied().unwrap_or("the root"));
            assert!(own == from || table[own].contains(from), "{file}: {own} may not import {from}: {other}");
        }
    }
    let modules: BTreeSet<&str> = files.keys().filter_map(|file| module(file).first().copied()).collect();
    assert!(modules.iter().copied().eq(table.keys()), "the modules, and the rows of the table");
    // The table itself has an order, and only draw calls attach fast paths.
    let rows = |name: &'_ str| {
        table.iter().filter(|row| row.1.contains(name)).map(|row| row.0.clone()).collect::<Vec<_>>()
    };
    assert_eq!((rows("pipeline"), rows("fast")), (vec!["prelude".to_string()], vec!["pipeline".to_string()]));
    let table =
        table.iter().map(|(name, imports)| (name.as_str(), imports.iter().map(String::as_str).collect()));
    assert_eq!(cycle(table.collect()), Graph::new());
}

/// What remains of a graph when what nothing imports, and what imports nothing, is taken away again and again.
fn cycle(mut edges: Graph<'_>) -> Graph<'_> {
    for _ in 0..edges.len() {
        let targets: BTreeSet<&str> = edges.values().flatten().copied().collect();
        edges.retain(|file, imports| targets.contains(file) && !imports.is_empty());
        let files: BTreeSet<&str> = edges.keys().copied().collect();
        edges.values_mut().for_each(|imports| imports.retain(|file| files.contains(file)));
    }
    edges
}

#[test]
fn files_of_the_library_form_no_cycle() {
    let files = sources();
    let edges = graph(&files);
    let count: usize = edges.values().map(BTreeSet::len).sum();
    assert!(count > 600, "only {count} imports were found");
    assert_eq!(cycle(edges), Graph::new());
}
