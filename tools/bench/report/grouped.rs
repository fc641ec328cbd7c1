//! The format of large numbers, for all pages that are measured and pages that quote them (`apps/pages`).

/// The separator of groups of digits: a space that does not break.
pub(crate) const SPACE: char = '\u{a0}';

/// 1234567 as 1 234 567.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(SPACE);
        }
        text.push(digit);
    }
    text
}
