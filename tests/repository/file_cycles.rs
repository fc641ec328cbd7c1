//! No files of the library import each other in a cycle: the strongly connected components of the graph of files.
//!
//! An edge leads from a file to the file that defines what the first one names, by a `use` or by a path in its code.
//! Re-exports are followed to the definition, so a `mod.rs` that only declares and re-exports modules is never part
//! of a cycle. Code under `#[cfg(test)]` does not count.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Cycles that are known and still to be removed. None are.
const KNOWN: &[&[&str]] = &[];

type Sources = BTreeMap<String, String>;
/// The names of a module and of all modules around it, from the crate's root.
type ModulePath = Vec<String>;

/// Splits code into identifiers, `::` and single characters, without comments, strings, characters and lifetimes.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut found, mut i) = (Vec::new(), 0);
    while i < chars.len() {
        let c = chars[i];
        if c == '/' && at(i + 1) == '/' {
            while i < chars.len() && chars[i] != '\n' {
                i += 1;
            }
        } else if c == '/' && at(i + 1) == '*' {
            i += 2;
            while i < chars.len() && !(chars[i] == '*' && at(i + 1) == '/') {
                i += 1;
            }
            i += 2;
        } else if c == 'r' && (at(i + 1) == '"' || at(i + 1) == '#' && matches!(at(i + 2), '"' | '#')) {
            let hashes = (i + 1..).take_while(|&k| at(k) == '#').count();
            i += hashes + 2;
            while i < chars.len() && !(chars[i] == '"' && (1..=hashes).all(|k| at(i + k) == '#')) {
                i += 1;
            }
            i += hashes + 1;
        } else if c == '"' {
            i += 1;
            while i < chars.len() && chars[i] != '"' {
                i += 1 + usize::from(chars[i] == '\\');
            }
            i += 1;
        } else if c == '\'' {
            if at(i + 1) == '\\' {
                i += 3;
                while i < chars.len() && chars[i] != '\'' {
                    i += 1;
                }
                i += 1;
            } else if at(i + 2) == '\'' {
                i += 3;
            } else {
                i += 1;
                while word(at(i)) {
                    i += 1;
                }
            }
        } else if word(c) {
            let start = i;
            while word(at(i)) {
                i += 1;
            }
            found.push(chars[start..i].iter().collect());
        } else if c == ':' && at(i + 1) == ':' {
            found.push("::".to_string());
            i += 2;
        } else {
            if !c.is_whitespace() {
                found.push(c.to_string());
            }
            i += 1;
        }
    }
    found
}

/// The position after the bracket that closes the one at `open`.
fn after_closing(code: &[String], open: usize) -> usize {
    let mut depth = 0;
    for (i, token) in code.iter().enumerate().skip(open) {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    code.len()
}

/// A name that a `use` brings into a module.
#[derive(Clone, Debug)]
struct Import {
    /// `*` for a glob.
    name: String,
    path: Vec<String>,
    /// Whether the import has a visibility of its own.
    re_export: bool,
}

#[derive(Debug, Default)]
struct Module {
    file: String,
    items: BTreeSet<String>,
    imports: Vec<Import>,
    /// Paths in code, and single names, which matter for re-exports alone.
    paths: Vec<Vec<String>>,
    names: BTreeSet<String>,
}

/// The imports of the tree that starts at `i`, each appended to `found`; returns the position after the tree.
fn use_tree(code: &[String], mut i: usize, mut path: Vec<String>, found: &mut Vec<Import>) -> usize {
    while let Some(token) = code.get(i) {
        match token.as_str() {
            "::" => i += 1,
            "{" => {
                let end = after_closing(code, i);
                i += 1;
                while i + 1 < end {
                    i = use_tree(code, i, path.clone(), found);
                    i += usize::from(code[i] == ",");
                }
                return end;
            }
            "*" => {
                found.push(Import { name: token.clone(), path, re_export: false });
                return i + 1;
            }
            "as" => {
                found.push(Import { name: code[i + 1].clone(), path, re_export: false });
                return i + 2;
            }
            "," | ";" | "}" => break,
            _ => {
                path.push(token.clone());
                i += 1;
            }
        }
    }
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    if let Some(name) = path.last().cloned() {
        found.push(Import { name, path, re_export: false });
    }
    i
}

/// Reads the modules of a file: its own, and those written out in it.
fn read(file: &str, text: &str, modules: &mut BTreeMap<ModulePath, Module>) {
    let mut own: ModulePath = file.trim_end_matches(".rs").split('/').map(str::to_string).collect();
    if matches!(own.last().map(String::as_str), Some("mod" | "lib")) {
        own.pop();
    }
    let code = tokens(text);
    // The depth in braces at which each open module's items stand.
    let (mut open, mut depth, mut i, mut public) = (vec![(own, 0)], 0, 0, false);
    modules.insert(open[0].0.clone(), Module { file: file.to_string(), ..Module::default() });
    while i < code.len() {
        let (path, items) = open.last().cloned().expect("the file's own module");
        let module = modules.get_mut(&path).expect("inserted when it was opened");
        let next = |k: usize| code.get(i + k).map_or("", String::as_str);
        match code[i].as_str() {
            "#" if next(1) == "[" || next(1) == "!" => {
                let start = i + 1 + usize::from(next(1) == "!");
                let end = after_closing(&code, start);
                let of_tests = code[start..end].windows(2).any(|w| w[0] == "cfg" && w[1] == "(")
                    && code[start..end].iter().any(|token| token == "test")
                    && !code[start..end].iter().any(|token| token == "not");
                i = end;
                if of_tests {
                    while i < code.len() && !matches!(code[i].as_str(), ";" | "{") {
                        i = if matches!(code[i].as_str(), "(" | "[") {
                            after_closing(&code, i)
                        } else {
                            i + 1
                        };
                    }
                    let braced = code.get(i).is_some_and(|token| token == "{");
                    i = if braced { after_closing(&code, i) } else { i + 1 };
                }
                continue;
            }
            "{" => depth += 1,
            "}" => {
                depth -= 1;
                if open.len() > 1 && depth < items {
                    open.pop();
                }
            }
            "pub" => {
                public = true;
                i = if next(1) == "(" { after_closing(&code, i + 1) } else { i + 1 };
                continue;
            }
            // `use<…>` of a type lists what it captures.
            "use" if next(1) != "<" => {
                let mut found = Vec::new();
                i = use_tree(&code, i + 1, Vec::new(), &mut found);
                module.imports.extend(found.into_iter().map(|import| Import { re_export: public, ..import }));
                public = false;
                continue;
            }
            "mod" if next(2) == "{" => {
                module.items.insert(next(1).to_string());
                let inner: ModulePath = path.iter().cloned().chain([next(1).to_string()]).collect();
                depth += 1;
                modules.insert(inner.clone(), Module { file: file.to_string(), ..Module::default() });
                open.push((inner, depth));
                i += 3;
                continue;
            }
            "struct" | "enum" | "union" | "trait" | "type" | "static" | "fn" | "const" if depth == items => {
                let name = if next(1) == "mut" || next(1) == "fn" { next(2) } else { next(1) };
                module.items.insert(name.to_string());
                i += 1;
                public = false;
                continue;
            }
            "macro_rules" => {
                module.items.insert(next(2).to_string());
                i += 3;
                continue;
            }
            token if token.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                let mut path = vec![token.to_string()];
                let is_name = |k: usize| {
                    code.get(k).is_some_and(|t| t.starts_with(|c: char| c.is_alphabetic() || c == '_'))
                };
                while code.get(i + 1).is_some_and(|t| t == "::") && is_name(i + 2) {
                    path.push(code[i + 2].clone());
                    i += 2;
                }
                module.names.insert(path[0].clone());
                if path.len() > 1 {
                    module.paths.push(path);
                }
            }
            _ => {}
        }
        public = false;
        i += 1;
    }
}

/// The file that defines what a path names, seen from a module; `None` for other crates and for modules as such.
fn defining_file(
    modules: &BTreeMap<ModulePath, Module>,
    from: &ModulePath,
    path: &[String],
    seen: &mut BTreeSet<(ModulePath, Vec<String>)>,
) -> Option<String> {
    if !seen.insert((from.clone(), path.to_vec())) {
        return None;
    }
    let (first, rest) = path.split_first()?;
    let mut at = from.clone();
    match first.as_str() {
        "crate" => return defining_file(modules, &Vec::new(), rest, seen),
        "self" => return defining_file(modules, from, rest, seen),
        "super" => {
            at.pop();
            return defining_file(modules, &at, rest, seen);
        }
        _ => {}
    }
    at.push(first.clone());
    if modules.contains_key(&at) {
        if rest.is_empty() {
            return None;
        }
        let found = defining_file(modules, &at, rest, seen);
        // A name that a macro makes: it stands in the module's own file.
        let module = rest.len() == 1 && modules.contains_key(&[&at[..], rest].concat());
        let keyword = matches!(rest[0].as_str(), "super" | "self");
        return found.or_else(|| {
            let imported = modules[&at].imports.iter().any(|import| import.name == rest[0]);
            (!module && !keyword && !imported && rest.len() == 1).then(|| modules[&at].file.clone())
        });
    }
    let module = modules.get(from)?;
    if module.items.contains(first) {
        return Some(module.file.clone());
    }
    if let Some(import) = module.imports.iter().find(|import| import.name == *first) {
        // An import of its own name, `use first::…`, means a child or another crate.
        let target = [&import.path[..], rest].concat();
        return defining_file(modules, from, &target, seen);
    }
    let globs = module.imports.iter().filter(|import| import.name == "*");
    globs.map(|glob| [&glob.path[..], path].concat()).find_map(|target| {
        let outer = matches!(target[0].as_str(), "crate" | "super" | "self");
        let child = modules.contains_key(&[&from[..], &target[..1]].concat());
        (outer || child).then(|| defining_file(modules, from, &target, seen)).flatten()
    })
}

/// Which files each file needs.
fn imports(sources: &Sources) -> BTreeMap<String, BTreeSet<String>> {
    let mut modules = BTreeMap::new();
    for (file, text) in sources {
        read(file, text, &mut modules);
    }
    let mut edges: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (path, module) in &modules {
        let used = |import: &&Import| !import.re_export || module.names.contains(&import.name);
        let targets = module.imports.iter().filter(used).map(|import| &import.path).chain(&module.paths);
        for target in targets {
            let found = defining_file(&modules, path, target, &mut BTreeSet::new());
            if let Some(found) = found.filter(|found| *found != module.file) {
                edges.entry(module.file.clone()).or_default().insert(found);
            }
        }
    }
    edges
}

/// The strongly connected components of more than one file.
fn cycles(sources: &Sources) -> Vec<BTreeSet<String>> {
    let edges = imports(sources);
    let reach: BTreeMap<&String, BTreeSet<&String>> = edges
        .keys()
        .map(|from| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
            while let Some(file) = open.pop() {
                open.extend(edges.get(file).into_iter().flatten().filter(|next| seen.insert(*next)));
            }
            (from, seen)
        })
        .collect();
    let mut found: Vec<BTreeSet<String>> = Vec::new();
    for (from, to) in &reach {
        if !to.contains(from) || found.iter().any(|cycle| cycle.contains(*from)) {
            continue;
        }
        let both_ways = to.iter().filter(|file| reach.get(**file).is_some_and(|back| back.contains(from)));
        found.push(both_ways.map(|file| file.to_string()).collect());
    }
    found
}

fn library() -> Sources {
    let src = Path::new(support::ROOT).join("src");
    let (mut found, mut folders) = (Sources::new(), vec![src.clone()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let below = path.strip_prefix(&src).expect("below src").to_string_lossy().replace('\\', "/");
            if path.is_dir() {
                folders.push(path);
            } else if below.ends_with(".rs") && !below.split('/').any(|part| part.starts_with("tests")) {
                found.insert(below, fs::read_to_string(&path).expect("a source file"));
            }
        }
    }
    found
}

#[test]
fn files_of_the_library_form_no_cycle() {
    let sources = library();
    let edges: usize = imports(&sources).values().map(BTreeSet::len).sum();
    assert!(edges > 150, "only {edges} imports were found: the reader of sources misses some");
    let all = imports(&sources);
    let mut unknown = String::new();
    for cycle in cycles(&sources) {
        if KNOWN.iter().any(|known| cycle.iter().all(|file| known.contains(&file.as_str()))) {
            continue;
        }
        unknown += &format!("{} files import each other in a cycle:\n", cycle.len());
        for file in &cycle {
            let targets: Vec<_> = all[file].intersection(&cycle).map(String::as_str).collect();
            unknown += &format!("  {file} -> {}\n", targets.join(", "));
        }
    }
    assert!(unknown.is_empty(), "{unknown}");
}

fn written(files: &[(&str, &str)]) -> Sources {
    files.iter().map(|(file, text)| (file.to_string(), text.to_string())).collect()
}

#[test]
fn a_cycle_through_a_re_export_is_found() {
    let sources = written(&[
        ("lib.rs", "mod a; mod b; pub use a::One;"),
        ("a/mod.rs", "mod one; mod three; pub use one::One; pub(crate) use three::Three as Renamed;"),
        ("a/one.rs", "use crate::b::Two; pub struct One(Two);"),
        ("a/three.rs", "pub struct Three;"),
        ("b.rs", "pub struct Two; impl Two { fn f() -> crate::One { let _: crate::a::Renamed; } }"),
    ]);
    let expected: BTreeSet<String> = ["a/one.rs", "b.rs"].map(String::from).into();
    assert_eq!(cycles(&sources), [expected]);
    let of_b: BTreeSet<String> = ["a/one.rs", "a/three.rs"].map(String::from).into();
    assert_eq!(imports(&sources)["b.rs"], of_b);
}

#[test]
fn a_child_that_imports_its_parents_item_is_a_cycle_if_the_parent_uses_the_child() {
    let child = ("a/child.rs", "use super::helper; pub fn f() { helper() }");
    let uses = written(&[("a/mod.rs", "mod child; fn helper() {} fn g() { child::f() }"), child]);
    assert_eq!(cycles(&uses).len(), 1);
    let re_exports = written(&[("a/mod.rs", "mod child; pub use child::f; fn helper() {}"), child]);
    assert_eq!(cycles(&re_exports), []);
    let both = written(&[("a/mod.rs", "mod child; pub use child::f; fn helper() { let _ = f; }"), child]);
    assert_eq!(cycles(&both).len(), 1);
}

#[test]
fn test_code_strings_and_comments_do_not_count() {
    let sources = written(&[
        ("a.rs", "// use crate::b::B;\nconst S: &str = \"crate::b::B\"; pub struct A<'a>(&'a str);"),
        ("b.rs", "pub struct B; #[cfg(test)] mod tests { use super::*; use crate::a::A; }"),
        (
            "c.rs",
            "mod inner { use super::super::b::B; pub fn f() {} } use self::inner::f; pub fn c() { f() }",
        ),
    ]);
    assert_eq!(cycles(&sources), []);
    assert_eq!(imports(&sources).keys().collect::<Vec<_>>(), ["c.rs"]);
}
