//! Models as `pinhole-import` makes them: its options, its up axis, its winding and its warnings.

use crate::scene::Colors;
use clap::builder::PossibleValuesParser;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches};
pub use pinhole_import::arguments::arguments;
use pinhole_import::{arguments, Options, Preview, TextureFormat};
use std::path::Path;

/// The option that shows a model's picture.
pub fn texture_argument() -> Arg {
    Arg::new("texture")
        .long("texture")
        .value_name("COLORS")
        .help("Show the picture of an .obj's materials in so many colours, as pinhole-import writes it")
        .value_parser(PossibleValuesParser::new(["2", "4", "16", "256"]))
}

/// The given ones of these options and of [`texture_argument`].
pub fn options(given: &ArgMatches) -> Options {
    let colors = given.get_one::<String>("texture").and_then(|colors| colors.parse().ok()); // one of the choices
    let texture = colors.map(|colors| TextureFormat { colors, ..TextureFormat::default() });
    Options { texture, ..arguments::options(given) }
}

/// Whether a model's picture was asked for, in a program that shows a scene. The error names the option.
pub fn refuse_texture(given: &ArgMatches) -> Result<(), String> {
    match given.contains_id("texture") {
        true => Err("--texture: a scene has its own texture; use this option with .obj".into()),
        false => Ok(()),
    }
}

/// The first of the options of these names that was typed, if any.
pub fn typed<'a>(given: &ArgMatches, names: &[&'a str]) -> Option<&'a str> {
    names.iter().copied().find(|name| given.value_source(name) == Some(ValueSource::CommandLine))
}

/// Whether a file is a model, and not a scene.
pub fn is_model(file: &Path) -> bool {
    file.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj") || e.eq_ignore_ascii_case("stl"))
}

/// Reads a model.
pub fn read(file: &Path, options: &Options) -> Result<Preview, String> {
    let model = pinhole_import::preview(file, options).map_err(|e| e.to_string())?;
    match model.triangles.faces.is_empty() {
        true => Err(format!(
            "{}: has lines alone, which firmware draws and this program does not",
            file.display()
        )),
        false => Ok(model),
    }
}

/// The colours of a model's triangles, taken out of it.
pub fn colors(model: &mut Preview) -> Colors {
    Colors { faces: std::mem::take(&mut model.colors), emission: std::mem::take(&mut model.emission) }
}

/// The flash that this model takes in a firmware, as a message.
pub fn size(preview: &Preview) -> Option<String> {
    Some(format!("in firmware: {}", preview.mesh.as_ref().ok()?.size()))
}
