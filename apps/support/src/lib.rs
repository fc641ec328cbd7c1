//! What the host programs of this repository share: the examples and the programs in `apps`. Command lines, files that are
//! written completely or not at all, pictures in memory, PNG and GIF files, and the named projections.

pub mod animation;
pub mod grouped;
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
pub mod film;
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
