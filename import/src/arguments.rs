//! The options of command lines that decide which model is drawn: `pinhole-import` has them, and so have the programs that
//! show a model before it is in a firmware.

use crate::{Axis, Options};
use clap::builder::{PathBufValueParser, PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgAction, ArgMatches};
use std::path::PathBuf;

/// The names of the options.
pub const NAMES: [&str; 8] =
    ["up", "flip", "fix-winding", "two-sided", "object", "step", "materials-only", "root"];

/// The options themselves.
pub fn arguments() -> [Arg; 8] {
    let flag = |name: &'static str, help| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    let up = Arg::new("up")
        .long("up")
        .value_name("AXIS")
        .value_parser(PossibleValuesParser::new(Axis::ALL.map(|(name, _)| name)))
        .allow_hyphen_values(true)
        .help("The file's axis that points upwards [default: z of .stl, y of .obj]");
    [
        up,
        flag("flip", "Reverse all faces, for a model that is inside out"),
        flag("fix-winding", "Reverse faces that are wound otherwise than their neighbours, and parts that point inwards"),
        flag("two-sided", "Show the backs of faces too, except of closed bodies: these faces count, and cost, twice"),
        Arg::new("object").long("object").value_name("NAME").action(ArgAction::Append)
            .help("Only this object or group of an OBJ file; may be given several times"),
        Arg::new("step").long("step").value_name("STEP").allow_hyphen_values(true).value_parser(step).help(
            "The step of the grid, a power of two such as 2^-10 or 0.5: parts of one step fit together [default: the finest]",
        ),
        flag("materials-only", "Leave out colours of vertices (OBJ) and of facets (STL)"),
        Arg::new("root").long("root").value_name("FOLDER").value_parser(PathBufValueParser::new().try_map(folder)).help(
            "A folder whose material libraries and pictures the model may name, besides its own folder",
        ),
    ]
}

/// The value of `--step`: a number, or 2^ and an exponent.
fn step(text: &str) -> Result<f64, String> {
    let number = match text.strip_prefix("2^") {
        Some(exponent) => exponent.parse().map(|exponent| 2f64.powi(exponent)).ok(),
        None => text.parse().ok(),
    };
    number.ok_or_else(|| "a power of two is a number such as 0.25, or 2^-2".into())
}

/// The value of `--root`.
fn folder(path: PathBuf) -> Result<PathBuf, &'static str> {
    path.is_dir().then_some(path).ok_or("this is no folder")
}

/// The default options, changed by the given ones.
pub fn options(given: &ArgMatches) -> Options {
    let axis = |name: &String| Axis::ALL.iter().find(|(other, _)| other == name).map(|&(_, axis)| axis);
    Options {
        up: given.get_one("up").and_then(axis),
        flip: given.get_flag("flip"),
        fix_winding: given.get_flag("fix-winding"),
        two_sided: given.get_flag("two-sided"),
        objects: given.get_many("object").into_iter().flatten().cloned().collect(),
        step: given.get_one("step").copied(),
        materials_only: given.get_flag("materials-only"),
        root: given.get_one("root").cloned(),
        ..Options::default()
    }
}
