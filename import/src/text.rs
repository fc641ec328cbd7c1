//! Text out of the bytes of a file.

use crate::Problem;
use std::borrow::Cow;

/// Whether the bytes are text in UTF-16, by the mark at their beginning.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// The text of UTF-8 or, with a mark, of UTF-16, without the mark, and without the zeros or Ctrl-Z that some programs write behind
/// the end; where nothing but carriage returns ends lines, as on old Macs, they end as elsewhere.
pub(crate) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes).into(),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes).into(),
        [0xef, 0xbb, 0xbf, rest @ ..] | rest => String::from_utf8_lossy(without_end(rest)),
    };
    if text.contains('\r') && !text.contains('\n') {
        text.replace('\r', "\n").into()
    } else {
        text
    }
}

/// The bytes of a text without zeros and Ctrl-Z at the end; all of them, if there is nothing else.
pub(crate) fn without_end(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|byte| !b"\0\x1a".contains(byte));
    bytes.get(..end.map_or(bytes.len(), |last| last + 1)).unwrap_or_default()
}

/// A line of numbers or indices without its comment, and without spaces around it.
pub(crate) fn before_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).filter_map(|pair| pair.first_chunk().copied().map(unit));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// The problem of a vertex whose coordinates are not three numbers. `found` is the text in their place: a comma is named, as
/// programs in some languages write it before the fraction, and spreadsheets between numbers.
pub(crate) fn a_vertex_needs_numbers(found: &str) -> Problem {
    Problem::Syntax(match found.contains(',') {
        true => "a vertex needs three numbers such as `1.5 0 2`, without commas: replace them, or export the model again",
        false => "a vertex needs three numbers",
    })
}
