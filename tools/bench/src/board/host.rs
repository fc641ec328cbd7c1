//! No board: nothing is counted.

pub(super) struct Counter(());

impl Counter {
    pub(super) fn new() -> Option<Self> {
        Some(Self(()))
    }

    pub(super) fn start(&mut self) {}

    /// The host counts no instructions.
    pub(super) fn instructions(&mut self) -> Option<u32> {
        Some(0)
    }
}

/// Instructions of a turn of [`turns`].
pub(super) const TURN: u32 = 0;

/// Not even a loop.
pub(super) fn turns(_: u32) {}

pub fn end(well: bool) -> ! {
    std::process::exit(i32::from(!well))
}
