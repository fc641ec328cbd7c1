//! Every example can be pasted into a function that returns a `Result`: visible lines need no hidden line but the final `Ok`.

use std::{fs, path::Path, process::Command};

/// Whether rustdoc compiles the block.
fn is_example(language: &str) -> bool {
    language.split(',').all(|word| ["", "rust", "no_run", "should_panic"].contains(&word.trim()))
}

/// The number of hidden lines in examples, and those that visible lines may need: not assertions or the result, nor a `let` after
/// the last visible line.
fn hidden(path: &str, text: &str) -> (usize, Vec<String>) {
    let (mut count, mut needed) = (0, Vec::new());
    let (mut block, mut variables) = (None, Vec::new());
    for (number, line) in (1..).zip(text.lines()) {
        let source = line.trim_start();
        let comment = source.strip_prefix("///").or_else(|| source.strip_prefix("//!"));
        let Some(line) = comment.or(path.ends_with(".md").then_some(source)).map(str::trim_start) else {
            // An attribute may include the lines of a block.
            block = block.filter(|_| source.starts_with('#'));
            continue;
        };
        if let Some(language) = line.strip_prefix("```") {
            block = if block.is_none() { Some(is_example(language)) } else { None };
            variables.clear();
        } else if block == Some(true) {
            let is_hidden = line == "#" || line.starts_with("# ");
            let code = line.trim_start_matches('#').trim_start();
            count += usize::from(is_hidden);
            if !is_hidden {
                needed.append(&mut variables);
            } else if code.starts_with("let ") {
                variables.push(format!("{path}:{number}: {line}"));
            } else if !code.starts_with("assert") && !code.starts_with("Ok::<") {
                needed.push(format!("{path}:{number}: {line}"));
            }
        }
    }
    (count, needed)
}

#[test]
fn examples_hide_no_line_that_they_need() {
    let root = Path::new(support::ROOT);
    let done =
        Command::new("git").args(["ls-files", "*.rs", "*.md"]).current_dir(root).output().expect("git");
    let (mut count, mut needed) = (0, Vec::new());
    for path in String::from_utf8(done.stdout).expect("names").lines() {
        let found = hidden(path, &fs::read_to_string(root.join(path)).expect("a file"));
        count += found.0;
        needed.extend(found.1);
    }
    assert!(count > 100, "only {count} hidden lines were found");
    assert!(
        needed.is_empty(),
        "these lines are hidden, so their examples do not compile where they are pasted. Remove `# `, or shorten the set-up \
         (`Camera::framing`, `meshes::CUBE`). Only `assert`, `Ok::<` and, after the last visible line, `let` may be hidden:\n{}",
        needed.join("\n")
    );
}
