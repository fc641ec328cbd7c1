//! Definitions of the README's links, and of the cookbook's pictures, for the crate's pages, where files of the repository are not
//! at hand. Links to pages lead to the source that docs.rs shows, and a small drawing says where each picture is; the picture's
//! alternative text describes it. Markdown takes the first definition of a name, so this file is included before the README.

use std::fmt::Write;

const SOURCE: &str = "https://docs.rs/crate/pinhole/latest/source";

pub(crate) fn definitions() -> Result<String, String> {
    let readme = super::read("README.md")?;
    let mut text = String::new();
    for line in readme.lines() {
        let Some((name, path)) = line.strip_prefix('[').and_then(|line| line.split_once("]: ")) else {
            continue;
        };
        if path.contains("://") {
            continue;
        }
        let target = match path.rsplit_once('.') {
            _ if path == "src/book/mod.rs" => "crate::book".to_string(),
            Some((_, "png" | "gif")) => placeholder(path),
            _ => format!("{SOURCE}/{path}"),
        };
        let _ = writeln!(text, "[{name}]: {target}");
    }
    for name in cookbook()? {
        let path = format!("docs/cookbook/{name}");
        let _ = writeln!(text, "[{path}]: {}", placeholder(&path));
    }
    text.push('\n');
    Ok(text)
}

/// The pictures of the book's cookbook.
fn cookbook() -> Result<Vec<String>, String> {
    let folder = super::root().join("docs/cookbook");
    let entries = std::fs::read_dir(&folder).map_err(|e| format!("docs/cookbook: cannot be read: {e}"))?;
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    Ok(names)
}

/// A drawing that stands for a picture and names its file, as a data URL: pictures take some 100 KB, and the package carries text
/// alone.
fn placeholder(path: &str) -> String {
    // A letter of 12 pixels' height is 7 pixels wide.
    let caption = format!("{path}, in the repository");
    let width = 7 * caption.len() + 20;
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='32'>\
         <rect width='100%' height='100%' fill='none' stroke='gray'/>\
         <text x='10' y='20' font-family='monospace' font-size='12' fill='gray'>{caption}</text></svg>"
    );
    let mut url = String::from("data:image/svg+xml,");
    for byte in svg.bytes() {
        match byte {
            // RFC 3986, section 2.3, and delimiters that a data URL may contain.
            b'A'..=b'Z'
            | b'a'..=b'z'
            | b'0'..=b'9'
            | b'-'
            | b'.'
            | b'_'
            | b'~'
            | b'/'
            | b':'
            | b'='
            | b',' => {
                url.push(char::from(byte));
            }
            _ => {
                let _ = write!(url, "%{byte:02X}");
            }
        }
    }
    url
}
