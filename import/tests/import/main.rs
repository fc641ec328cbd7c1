//! `pinhole-import`: readers, options, what it writes, and the command.

mod build_rs;
mod cli;
mod closed;
mod colors;
mod decimate;
mod images;
mod lines;
mod materials;
mod obj;
mod options;
mod properties;
mod selection;
mod source;
mod stl;
mod teapot;
#[cfg(feature = "textures")]
mod textures;
mod winding;
