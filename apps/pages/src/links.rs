//! Where links and pictures of the README lead on the crate's page, where files of the repository are not at hand: files
//! to the source that docs.rs shows, pictures into the page. Markdown takes the first definition of a name, so what
//! stands before the README goes before its own.

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
        // A file of the package, a picture, or the book itself.
        match path.rsplit_once('.') {
            _ if path == "src/book/mod.rs" => {
                let _ = writeln!(text, "[{name}]: crate::book");
            }
            Some((_, "png")) => {
                let file = std::fs::read(super::root().join(path)).map_err(|e| format!("{path}: {e}"))?;
                let _ = writeln!(text, "[{name}]: data:image/png;base64,{}", base64(&file));
            }
            _ => {
                let _ = writeln!(text, "[{name}]: {SOURCE}/{path}");
            }
        }
    }
    text.push('\n');
    Ok(text)
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits = three.iter().fold(0, |bits, &byte| bits << 8 | u32::from(byte)) << (8 * (3 - three.len()));
        for digit in 0..4 {
            let value = bits >> (18 - 6 * digit) & 63;
            text.push(if digit <= three.len() { char::from(DIGITS[value as usize]) } else { '=' });
        }
    }
    text
}
