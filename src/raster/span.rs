//! Runs of pixels.

/// A run of pixels: `width` columns from `x` rightwards, or `height` rows from `y` downwards. One of `width` and
/// `height` is 1, and neither is less than 1. Coordinates are those of the target; in a band they are those of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Span {
    /// The leftmost column.
    pub x: i32,
    /// The topmost row.
    pub y: i32,
    /// The number of columns.
    pub width: i32,
    /// The number of rows.
    pub height: i32,
}
