//! Text out of the bytes of a file.

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
