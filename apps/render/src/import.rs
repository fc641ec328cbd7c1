//! Models as `pinhole-import` makes them: its options, its up axis, its winding and its warnings.

use crate::scene::Colors;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches};
use pinhole_import::{Options, Preview};
use std::path::Path;

#[path = "../../../import/src/arguments.rs"]
mod arguments;

/// The options that the command `pinhole-import` has, too.
pub fn arguments() -> [Arg; 4] {
    arguments::arguments()
}

/// The given ones of these options.
pub fn options(given: &ArgMatches) -> Options {
    arguments::options(given)
}

/// The first of these options that was typed, if any.
pub fn typed(given: &ArgMatches) -> Option<&'static str> {
    let is_typed = |name: &&str| given.value_source(name) == Some(ValueSource::CommandLine);
    arguments::NAMES.into_iter().find(is_typed)
}

/// Whether a file is a model, and not a scene.
pub fn is_model(file: &Path) -> bool {
    file.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj") || e.eq_ignore_ascii_case("stl"))
}

/// Reads a model.
pub fn read(file: &Path, options: &Options) -> Result<Preview, String> {
    pinhole_import::preview(file, options).map_err(|e| e.to_string())
}

/// The colours of a model's triangles, taken out of it.
pub fn colors(model: &mut Preview) -> Colors {
    Colors { faces: std::mem::take(&mut model.colors), emission: std::mem::take(&mut model.emission) }
}

/// The flash that this model takes in a firmware, as a message.
pub fn size(preview: &Preview) -> Option<String> {
    Some(format!("in firmware: {}", preview.mesh.as_ref().ok()?.size()))
}
