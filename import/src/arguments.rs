//! The options of command lines that decide which model is drawn: `pinhole-import` has them, and so have the programs that
//! show a model before it is in a firmware.

use clap::builder::PossibleValuesParser;
use clap::{value_parser, Arg, ArgAction, ArgMatches};
use pinhole_import::{Axis, Options};
use std::path::PathBuf;

/// The names of the options.
#[allow(dead_code)] // for programs that take no model
pub(crate) const NAMES: [&str; 5] = ["up", "flip", "fix-winding", "two-sided", "root"];

/// The options themselves.
pub(crate) fn arguments() -> [Arg; 5] {
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
        flag(
            "fix-winding",
            "Reverse faces that are wound otherwise than their neighbours, and parts that point inwards",
        ),
        flag(
            "two-sided",
            "Show the backs of faces too, except of closed bodies: these faces count, and cost, twice",
        ),
        Arg::new("root").long("root").value_name("FOLDER").value_parser(value_parser!(PathBuf)).help(
            "A folder whose material libraries and pictures the model may name, besides its own folder",
        ),
    ]
}

/// The default options, changed by the given ones.
pub(crate) fn options(given: &ArgMatches) -> Options {
    let axis = |name: &String| Axis::ALL.iter().find(|(other, _)| other == name).map(|&(_, axis)| axis);
    Options {
        up: given.get_one("up").and_then(axis),
        flip: given.get_flag("flip"),
        fix_winding: given.get_flag("fix-winding"),
        two_sided: given.get_flag("two-sided"),
        root: given.get_one("root").cloned(),
        ..Options::default()
    }
}
