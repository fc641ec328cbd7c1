//! The simulator: a window that shows a model on a small display, drawn as firmware draws it.
//!
//! ```text
//! cargo run --release -p pinhole-viewer -- MODEL.stl
//! ```

mod window;

use clap::{value_parser, Arg, ArgMatches, Command};
use embedded_graphics::prelude::*;
use pinhole_apps_support::command;
use pinhole_render::import;
use pinhole_viewer::{write_png, Action, Source, State, Viewer};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        let mut given = command::installed(arguments())?;
        let options = import::options(&given);
        let typed = import::typed(&given, &pinhole_import::arguments::NAMES);
        let source = match given.remove_one::<PathBuf>("FILE") {
            Some(file) => {
                if let Some(name) = typed.filter(|_| !import::is_model(&file)) {
                    return Err(format!(
                        "--{name}: a scene is drawn as it stands; use this option with .obj and .stl"
                    ));
                }
                if !import::is_model(&file) {
                    import::refuse_texture(&given)?;
                }
                Source::read(&file, &options)?
            }
            None if typed.is_some() || given.contains_id("texture") => {
                return Err(
                    "--up, --flip, --fix-winding, --two-sided, --root, --texture: are for a FILE".into()
                )
            }
            None => Source::built_in(),
        };
        let screenshot: Option<PathBuf> = given.remove_one("screenshot");
        screenshot.as_deref().map_or(Ok(()), |file| source.apart_from(file))?;
        let size = given.remove_one::<String>("size").map(|text| command::size(&text, SIDES)).transpose()?;
        let mut state = source.state();
        let mut viewer = open(source, size)?;
        viewer.draw(&state)?;
        tell(viewer.source())?;
        for action in actions(&mut given)? {
            state.apply(action);
            viewer.draw(&state)?; // so that what changes is what the last key changed
        }
        let stay = given.remove_one("stay").map(Duration::from_millis);
        if let Some(file) = &screenshot {
            write_png(file, viewer.size(), &viewer.picture(&state, None))?;
        }
        // A script shows no time, so that its pictures can be compared.
        if screenshot.is_none() || stay.is_some() {
            let scale = given.remove_one::<u32>("scale").unwrap_or(2);
            window::run(viewer, state, window::Settings { options, size, scale, stay })?;
        }
        Ok(ExitCode::SUCCESS)
    })
}

/// A viewer of a model or a scene, on a display of the given size or the scene's own.
fn open(source: Source, size: Option<Size>) -> Result<Viewer, String> {
    let size = size.map_or_else(|| own_size(&source), Ok)?;
    Ok(Viewer::new(source, size))
}

/// Prints what is known about a model.
fn tell(source: &Source) -> Result<(), String> {
    let file = source.file().map(Path::to_path_buf).unwrap_or_default();
    if let Some(size) = source.size_in_firmware() {
        command::say(format_args!("{}: {size}", file.display()))?;
    }
    command::warn(&file, source.warnings());
    Ok(())
}

fn arguments() -> Command {
    let text = |name: &'static str, value, help| Arg::new(name).long(name).value_name(value).help(help);
    Command::new("pinhole-viewer")
        .about("Shows a model in a window, as on the display of a microcontroller; press h for the keys. A file that is dropped on the \
             window is shown, and a file that changes is read again")
        .arg(
            Arg::new("FILE")
                .help("A mesh (.obj, .stl) or a scene (.json) [default: a teapot]")
                .value_parser(value_parser!(PathBuf)),
        )
        .args(import::arguments())
        .arg(import::texture_argument())
        .arg(text(
            "size",
            "WxH",
            "Size of the display in pixels, 16 to 1024 each [default: the scene's, or 320x240]",
        ))
        .arg(
            text("scale", "N", "Magnification of the display in the window, 1 to 8 [default: 2]")
                .value_parser(value_parser!(u32).range(1..=8)),
        )
        .arg(
            text("keys", "KEYS", "Pressed at the beginning, such as \"w b p left\"")
                .allow_hyphen_values(true),
        )
        .arg(
            text("screenshot", "FILE", "Writes what the window would show, as a PNG file, and opens none")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            text("stay", "MS", "With --screenshot: opens the window, for so many milliseconds")
                .value_parser(value_parser!(u64).range(..=600_000))
                .requires("screenshot"),
        )
}

/// Width and height of a display.
const SIDES: RangeInclusive<u32> = 16..=1024;

fn own_size(source: &Source) -> Result<Size, String> {
    let size = source.size().unwrap_or(Size::new(320, 240));
    if SIDES.contains(&size.width) && SIDES.contains(&size.height) {
        return Ok(size);
    }
    let Size { width, height } = size;
    let (low, high) = (SIDES.start(), SIDES.end());
    Err(source
        .named(&format!("is of {width} x {height} pixels, but a display has {low} to {high} on a side: state its size by --size")))
}

fn actions(given: &mut ArgMatches) -> Result<Vec<Action>, String> {
    let keys: String = given.remove_one("keys").unwrap_or_default();
    let action =
        |name| State::key(name).ok_or_else(|| format!("--keys: {name} is not a key; h shows the keys"));
    keys.split_whitespace().map(action).collect()
}
