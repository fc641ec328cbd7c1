//! No dead links: every relative link of every tracked page leads to a file, and its anchor to a heading of that file. Each page that
//! the crate's documentation names has a definition that leads to its published source.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(support::ROOT)
}

/// The tracked pages. rustdoc checks the chapters of the book; the templates in `report` folders have the links of the pages
/// that are generated from them.
fn pages() -> Vec<PathBuf> {
    let done = Command::new("git").args(["ls-files", "*.md"]).current_dir(root()).output().expect("git");
    let list = String::from_utf8(done.stdout).expect("names");
    let is_page = |path: &&str| !path.starts_with("src/") && !path.contains("/report/");
    list.lines().filter(is_page).map(PathBuf::from).collect()
}

/// The lines outside code blocks, without inline code.
fn prose(text: &str) -> Vec<String> {
    let mut fenced = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced && !line.starts_with("    ") {
            lines.push(line.split('`').step_by(2).collect());
        }
    }
    lines
}

/// `[name]: target` at the start of a line.
fn definition(line: &str) -> Option<(&str, &str)> {
    line.strip_prefix('[')?.split_once("]: ")
}

/// Targets of `[text](target)` and of definitions.
fn targets(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for line in prose(text) {
        let inline = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        found.extend(inline.map(str::to_string));
        found.extend(definition(&line).map(|(_, target)| target.to_string()));
    }
    found
}

/// Anchors of headings as GitHub makes them: small letters, digits, - and _; spaces become -.
fn anchors(text: &str) -> BTreeSet<String> {
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let titles = headings.map(|line| line.trim_start_matches('#').trim().to_lowercase());
    titles.map(|title| title.replace(' ', "-").chars().filter(|&c| kept(c)).collect()).collect()
}

/// The path without `.` and `..`; `None` where it leaves the repository.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => plain.pop().then_some(())?,
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    Some(plain)
}

/// The dead links of a page.
fn dead(page: &Path, text: &str) -> Vec<String> {
    let is_dead = |target: &str| {
        if target.contains("://") {
            return false;
        }
        let (path, anchor) =
            target.split_once('#').map_or((target, None), |(path, anchor)| (path, Some(anchor)));
        let folder = page.parent().unwrap_or(Path::new(""));
        let file = if path.is_empty() { Some(page.to_path_buf()) } else { plain(&folder.join(path)) };
        let Some(file) = file.map(|file| root().join(file)).filter(|file| file.exists()) else { return true };
        anchor.is_some_and(|anchor| !anchors(&fs::read_to_string(file).unwrap_or_default()).contains(anchor))
    };
    let dead = targets(text).into_iter().filter(|target| is_dead(target));
    dead.map(|target| format!("{}: {target}", page.display())).collect()
}

#[test]
fn every_link_leads_somewhere() {
    let (mut links, mut found) = (0, Vec::new());
    for page in pages() {
        let text = fs::read_to_string(root().join(&page)).expect("a page");
        links += targets(&text).len();
        found.extend(dead(&page, &text));
    }
    assert!(links > 40, "only {links} links were found");
    assert!(found.is_empty(), "dead links:\n{}", found.join("\n"));
}

/// A copy's README may name files of the copy, and those of the repository by absolute paths.
#[test]
fn no_readme_of_a_copied_template_has_a_dead_link() {
    let folder = support::firmware::Folder::new("copied-readmes");
    for board in support::firmware::templates() {
        let copy = folder.0.join(&board);
        let new = root().join("boards/new");
        support::firmware::run(Command::new("bash").arg(new).arg(&board).arg(&copy));
        let readme = copy.join("README.md");
        let text = fs::read_to_string(&readme).expect("a README");
        assert_eq!(dead(&readme, &text), [""; 0], "{board}");
        assert!(
            targets(&text).iter().all(|target| !target.starts_with("..")),
            "{board}: a link to a folder beside it"
        );
    }
}

/// The tables of where things are, and the steps to contribute, name files and folders as code.
#[test]
fn every_path_in_code_leads_somewhere() {
    let read = |page: &str| fs::read_to_string(root().join(page)).expect(page);
    let readme = read("README.md");
    let (_, found) = readme.split_once("## Where to find what").expect("the table");
    let text = [found, &read("ARCHITECTURE.md"), &read("CONTRIBUTING.md")].concat();
    let paths = text.split('`').skip(1).step_by(2).filter_map(|code| code.split_whitespace().next());
    let is_file = |path: &&str| path.contains('/') && !path.starts_with(|c: char| c.is_ascii_digit());
    let (mut count, mut gone) = (0, Vec::new());
    for path in paths.filter(|path| is_file(path) && !path.starts_with("target/")) {
        let path = path.split('{').next().unwrap_or("");
        count += 1;
        gone.extend((!root().join(path).exists() && !root().join("src").join(path).exists()).then_some(path));
    }
    assert!(count > 80, "only {count} paths were found");
    assert!(gone.is_empty(), "README.md, ARCHITECTURE.md or CONTRIBUTING.md: {gone:?}");
}

/// The crate's documentation has no files beside it: `links.md` defines where each page that it names is shown, and `package.rs`
/// checks that these are published.
#[test]
fn each_page_that_the_documentation_names_is_defined() {
    let read = |path: &Path| fs::read_to_string(path).expect("a source");
    let links = read(&root().join("src/book/links.md"));
    let defined: BTreeSet<&str> = links.lines().filter_map(definition).map(|(name, _)| name).collect();
    let book = fs::read_dir(root().join("src/book")).expect("the book");
    let chapters = book.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file());
    let mut named = 0;
    for path in chapters.chain([root().join("src/lib.rs")]) {
        let text = read(&path);
        for name in text.split('[').skip(1).filter_map(|rest| rest.split(']').next()) {
            if name.ends_with(".md") {
                named += 1;
                assert!(defined.contains(name), "{}: {name} is not in src/book/links.md", path.display());
            }
        }
    }
    assert!(named > 20, "only {named} pages were found");
}
