//! What the host programs of this repository share: the examples and the programs in `apps`. Command lines, files that are
//! written completely or not at all, pictures in memory, and PNG and GIF files.

pub mod animation;
pub mod bodies;
pub mod canvas;
pub mod command;
pub mod files;
pub mod film;
pub mod generated;
pub mod grouped;
#[cfg(feature = "progress")]
pub mod progress;
pub mod sheet;
pub mod still;
pub mod testing;
