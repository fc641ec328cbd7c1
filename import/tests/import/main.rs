//! `pinhole-import`: readers, options, what it writes, and the command.

mod any_file;
mod cli;
mod closed;
mod colors;
mod common;
mod decimate;
mod images;
mod lines;
mod materials;
mod obj;
mod options;
mod selection;
mod source;
mod stl;
mod teapot;
#[cfg(feature = "textures")]
mod textures;
mod winding;
