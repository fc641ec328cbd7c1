//! What the host programs of this repository share: the examples and the programs in `apps`. Command lines, files that are
//! written completely or not at all, pictures in memory, PNG and GIF files, and the named projections.

pub mod animation;
pub mod palette;
pub mod projections;

#[cfg(feature = "host")]
pub mod bodies;
#[cfg(feature = "host")]
pub mod canvas;
#[cfg(feature = "host")]
pub mod command;
#[cfg(feature = "host")]
pub mod files;
#[cfg(feature = "host")]
pub mod generated;
/// The importer has it, and the examples should not wait for the importer.
#[cfg(feature = "host")]
#[path = "../../../import/src/host.rs"]
pub mod host;
#[cfg(feature = "host")]
pub mod sheet;
#[cfg(feature = "host")]
pub mod still;
#[cfg(feature = "host")]
pub mod testing;
#[cfg(feature = "work")]
pub mod work;

/// 1234567 as 1 234 567, with spaces that do not break, as pages have large numbers.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}
