//! Text out of the bytes of a file.

use crate::Problem;
use std::borrow::Cow;

/// Without a mark of UTF-8; where nothing but carriage returns ends lines, as on old Macs, they end as elsewhere.
pub(crate) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    if text.contains('\r') && !text.contains('\n') {
        text.replace('\r', "\n").into()
    } else {
        text
    }
}

/// The problem of a vertex whose coordinates are not three numbers. `found` is the text in their place: a comma is named, as
/// programs in some languages write it before the fraction, and spreadsheets between numbers.
pub(crate) fn a_vertex_needs_numbers(found: &str) -> Problem {
    Problem::Syntax(match found.contains(',') {
        true => "a vertex needs three numbers such as `1.5 0 2`, without commas: replace them, or export the model again",
        false => "a vertex needs three numbers",
    })
}
