//! `pinhole-import`: readers, options, what it writes, and the command.

mod cases;
mod cli;
mod closed;
mod common;
mod materials;
mod obj;
mod options;
mod source;
mod stl;
#[cfg(feature = "textures")]
mod textures;
mod winding;
