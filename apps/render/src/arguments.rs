//! The options and their help.

use crate::json::Names;
use crate::picture::Format;
use crate::program::Output;
use crate::projections::Named;
use crate::style::Mode;
use crate::{firmware, import};
use clap::builder::PossibleValuesParser;
use clap::{value_parser, Arg, ArgAction, Command, Id};
use pinhole_import::arguments::NAMES;
use std::path::PathBuf;

/// Examples, and the format of scenes.
const FORMATS: &str = include_str!("help.txt");

/// Options beside those of the importer that `--firmware` permits: the template's code decides the others, or they name other outputs.
const IN_FIRMWARE: [&str; 7] = ["SCENE", "png", "stats", "size", "firmware", "gif", "frames"];

/// The command line, with outputs beside pictures.
pub fn command(more: &'static [Output]) -> Command {
    let file = |name: &'static str, help| {
        Arg::new(name).long(name).value_name("FILE").help(help).value_parser(value_parser!(PathBuf))
    };
    let angle = |name: &'static str, help| {
        Arg::new(name)
            .long(name)
            .value_name("DEGREES")
            .help(help)
            .allow_negative_numbers(true)
            .value_parser(value_parser!(f64))
    };
    let text = |name: &'static str, value, help: String| {
        Arg::new(name).long(name).value_name(value).help(help).allow_negative_numbers(true)
    };
    let flag = |name: &'static str, help| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    let modes = Mode::list();
    let formats = Format::list();
    let command = Command::new("render")
        .about("Draws a model or a scene with depth test, as on a microcontroller")
        .arg(
            Arg::new("SCENE")
                .required(true)
                .value_name("MODEL|SCENE")
                .help("A mesh (.obj, .stl), or a scene (.json)")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(file("png", "Write the picture as PNG"))
        .arg(
            Arg::new("ascii")
                .long("ascii")
                .value_name("CHARACTERS")
                .num_args(0..=1)
                .require_equals(true)
                .default_missing_value("ramp")
                .help("Print the picture as text: ramp or braille, one character for 2x4 pixels"),
        )
        .args(more.iter().map(|output| file(output.name, output.help)))
        .arg(text(
            "mode",
            "MODE",
            format!("{modes} [default: solid: smooth shading, except over sharp edges]"),
        ))
        .arg(
            text(
                "edges",
                "EDGES",
                "Lines to draw: all edges of all triangles, or feature, those where the surface turns by more than \
                 --feature-angle, or ends; hidden-line draws silhouettes, too [default: all; in hidden-line those where it turns by \
                 more than 1 degree, so that flat faces show no diagonals]"
                    .into(),
            )
            .value_parser(PossibleValuesParser::new(["all", "feature"])),
        )
        .arg(angle("feature-angle", "How far the surface turns at a feature edge, 0 to 180 [default: 30]"))
        .arg(
            text(
                "colour",
                "COLOUR",
                "Colour of faces or lines: a CSS name, #rrggbb or #rgb [default: the model's materials']".into(),
            )
                .alias("color"),
        )
        .arg(text("background", "COLOUR", "Background colour: a CSS name, #rrggbb or #rgb".into()))
        .arg(text("format", "FORMAT", format!("Pixel format: {formats} [default: rgb888]")))
        .arg(flag("lit-texture", "Light the texture as a face without one"))
        .arg(
            text("door", "N", "Screen door: draw N of 64 pixels of each face, 0 to 64".into())
                .value_parser(value_parser!(u8).range(..=64)),
        )
        .arg(
            flag("half", "Mix each face half and half with what is behind it, from far to near")
                .conflicts_with("door"),
        )
        .arg(
            text("alpha", "N", "Mix N of 32 parts of each face with what is behind it, from far to near, 0 to 32".into())
                .value_parser(value_parser!(u8).range(..=32))
                .conflicts_with_all(["door", "half"]),
        )
        .arg(
            text(
                "fog",
                "RANGE",
                "Fog of the background's colour: START,END, distances before the camera, or auto, from the nearest vertex to the \
                 farthest; linear, or with ,exponential or ,squared behind it"
                    .into(),
            )
            .allow_hyphen_values(true),
        )
        .arg(flag("smooth-lines", "Anti-aliased lines in wireframe and hidden-line"))
        .arg(flag("smooth-faces", "Anti-aliased edges of faces: silhouettes, and creases between faces of different light or colour"))
        .arg(flag("no-dither", "Round to the nearest colours of the format instead of dithering"))
        .arg(flag("stats", "Print how many triangles were drawn, culled and clipped"))
        .next_help_heading("For a mesh")
        .arg(text(
            "projection",
            "NAME",
            format!("{} [default: perspective]", Named::list()),
        ))
        .arg(
            text("from", "YAW,PITCH", "Direction to the eye in degrees, such as 30,20".into())
                .allow_hyphen_values(true),
        )
        .arg(angle("yaw", "Angle of the eye around the mesh, to the right"))
        .arg(angle("pitch", "Angle of the eye above the horizon"))
        .arg(angle("fov", "Field of view of a perspective across the narrower side [default: 40, more for some]"))
        .arg(text(
            "size",
            "WxH",
            "Size of the picture in pixels [default: 640x480; 320x240 for films, 160x120 for text]".into(),
        ).allow_hyphen_values(true))
        .arg(text(
            "frame",
            "WHAT",
            "What fills the picture: sphere, about the mesh, as in firmware, or outline, larger [default: sphere]".into(),
        ))
        .arg(import::texture_argument())
        .args(import::arguments())
        .arg(
            Arg::new("firmware")
                .long("firmware")
                .value_name("FRAME")
                .num_args(0..=1)
                .require_equals(true)
                .default_missing_value("0")
                .value_parser(value_parser!(u32).range(..i64::from(firmware::FRAMES)))
                .help(
                    "Draw frame FRAME, 0 to 119 of a turn, of firmware with this model: by the src/picture.rs of the project that it \
                     lies in, else by that of boards/any-cortex-m [default --size: 240x240]",
                )
        )
        .arg(file("gif", "Write a film of one turn around the mesh"))
        .arg(
            Arg::new("frames")
                .long("frames")
                .value_name("N")
                .help("Frames of the film, 2 to 360 [default: 36; all 120 with --firmware]")
                .value_parser(value_parser!(u32).range(2..=360)),
        )
        .after_help(FORMATS.trim_end());
    let ids: Vec<_> = command.get_arguments().map(|argument| argument.get_id().clone()).collect();
    let is_excluded = |id: &Id| ![&IN_FIRMWARE[..], &NAMES].concat().contains(&id.as_str());
    let excluded: Vec<_> = ids.into_iter().filter(is_excluded).collect();
    command.mut_arg("firmware", |argument| argument.conflicts_with_all(excluded))
}
