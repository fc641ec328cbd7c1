//! Text of files and paths as a terminal may show it.

/// The text with its control characters, and the characters that change the direction of text, escaped as in Rust: a name within
/// a file can then neither move the cursor nor change colours or the window's title.
pub(crate) fn shown(text: &str) -> String {
    let is_harmful = |c: char| {
        c.is_control()
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        match is_harmful(c) {
            true => out.extend(c.escape_default()),
            false => out.push(c),
        }
        out
    })
}
