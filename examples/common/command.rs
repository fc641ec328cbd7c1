//! What the examples share of a command line: help, values and folders that many take, and one way to refuse.
#![allow(dead_code)] // not every example has a film's options

use clap::{value_parser, Arg, ArgMatches, Command};
use embedded_graphics::geometry::Size;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[path = "../../import/src/say.rs"]
mod say;

pub(crate) use say::{complain, say};

/// Runs an example: what is wrong with what the user gave is one line, whatever a file or its name has
/// in it, and exit code 2.
pub(crate) fn run<E: ToString>(example: impl FnOnce() -> Result<ExitCode, E>) -> ExitCode {
    example().unwrap_or_else(|problem| {
        complain(problem.to_string().replace(char::is_control, " "));
        ExitCode::from(2)
    })
}

/// The arguments; asked for help, it gives that and ends.
pub(crate) fn matches(command: Command) -> Result<ArgMatches, String> {
    command.try_get_matches().map_err(|error| {
        if error.exit_code() == 0 {
            error.exit();
        }
        // What is wrong, in the lines up to the first empty one; then come tips and usage.
        let text = error.to_string();
        let lines: Vec<_> = text.lines().take_while(|line| !line.is_empty()).map(str::trim).collect();
        lines.join(" ")
    })
}

/// `--NAME VALUE` with a default.
pub(crate) fn option(
    name: &'static str,
    value: &'static str,
    help: &'static str,
    default: &'static str,
) -> Arg {
    Arg::new(name).long(name).value_name(value).help(help).default_value(default)
}

/// What `--size WxH` gives, each from a range.
pub(crate) fn size(text: &str, range: RangeInclusive<u32>) -> Result<Size, String> {
    let size = text.split_once('x').and_then(|(w, h)| Some(Size::new(w.parse().ok()?, h.parse().ok()?)));
    size.filter(|size| range.contains(&size.width) && range.contains(&size.height)).ok_or_else(|| {
        format!("--size: {text} is not WxH, each from {} to {}, such as 320x240", range.start(), range.end())
    })
}

/// Makes a folder for what an example writes, where there is none.
pub(crate) fn folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|e| format!("{}: cannot be made: {e}", path.display()))
}

/// What every film can be told.
pub(crate) struct Film {
    pub(crate) size: u32,
    pub(crate) frames: u32,
    pub(crate) out: PathBuf,
}

impl Film {
    /// `frames` says what they are frames of.
    pub(crate) fn arguments(
        command: Command,
        frames: &'static str,
        count: &'static str,
        out: &'static str,
    ) -> Command {
        command
            .arg(
                option("size", "N", "Width and height of the picture in pixels, 16 to 2048", "240")
                    .value_parser(value_parser!(u32).range(16..=2048)),
            )
            .arg(option("frames", "N", frames, count).value_parser(value_parser!(u32).range(2..=720)))
            .arg(
                option("out", "DIR", "The folder for the pictures", out).value_parser(value_parser!(PathBuf)),
            )
    }

    pub(crate) fn from(given: &mut ArgMatches) -> Self {
        Self {
            size: given.remove_one("size").unwrap_or_default(),
            frames: given.remove_one("frames").unwrap_or_default(),
            out: given.remove_one("out").unwrap_or_default(),
        }
    }
}
