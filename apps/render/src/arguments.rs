//! What the command line has.

use clap::{value_parser, Arg, ArgAction, Command};
use pinhole_render::paint::Mode;
use pinhole_render::picture::Format;
use pinhole_render::projections::Named;
use std::path::PathBuf;

const FORMATS: &str = r#"render MODEL.stl draws a picture to target/render/MODEL.png; --up y where the model lies on its side. More:
  render MODEL.stl --projection isometric --mode hidden-line --png OUT.png
  render MODEL.obj --from 60,30 --colour gold --background '#203040' --size 320x240
  render MODEL.obj --format gray4 --size 128x64        as on an OLED
  render MODEL.obj --gif OUT.gif                       once around
  render MODEL.obj --ascii                             in the terminal; --ascii=braille is finer

SCENE.json:
  {"mesh": "file.obj" | ".stl" | ".json" (relative to the scene),  or  "vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...],
   "model": 4x4 affine, "view": 4x4 rigid, "projection": 4x4 with w > 0 and z/w from -1 (near) to 1 (far) where it is seen,
   "width": W, "height": H (1 to 4096), "viewport": [x, y, w, h] (all, if missing), "cull": "none" | "back"}
Matrices are row-major, vectors columns. A .json mesh is {"vertices": ..., "triangles": ...}.

--ids: little-endian i32, row by row from the top: the triangle seen, -1 for none.
--depth: little-endian u16: 0 near to 65534 far, linear on the screen, 65535 for nothing.
--used: the scene in numbers as it was drawn; drawn again, it gives the same bits.
With one of these three a mesh is 320x240 and has y up, if nothing else is said.

Bad input: one line on stderr, exit code 2, and no file touched."#;

pub(crate) fn command() -> Command {
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
    let text =
        |name: &'static str, value, help: String| Arg::new(name).long(name).value_name(value).help(help);
    let flag = |name: &'static str, help| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    let modes = names(Mode::ALL.iter().map(|(name, _)| *name));
    let formats = names(Format::ALL.iter().map(|(name, _)| *name));
    Command::new("render")
        .about("Draws a model or a scene, depth-tested, as on a microcontroller")
        .arg(
            Arg::new("SCENE")
                .required(true)
                .help("A mesh (.obj, .stl), or a scene (.json)")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(file("png", "The picture"))
        .arg(
            Arg::new("ascii")
                .long("ascii")
                .value_name("CHARACTERS")
                .num_args(0..=1)
                .require_equals(true)
                .default_missing_value("ramp")
                .help("The picture as text: ramp or braille, a character for 2x4 pixels"),
        )
        .arg(file("ids", "The triangle seen in each pixel"))
        .arg(file("depth", "The depth of each pixel"))
        .arg(file("used", "The scene as it was drawn, rounded to the crate's numbers"))
        .arg(text("mode", "MODE", format!("{modes} [default: solid, smooth but for sharp edges]")))
        .arg(
            text("colour", "COLOUR", "A name of CSS, #rrggbb or #rgb: of faces, or of lines".into())
                .alias("color"),
        )
        .arg(text("background", "COLOUR", "The same, behind them".into()))
        .arg(text("format", "FORMAT", format!("The colours of a display: {formats} [default: rgb888]")))
        .arg(flag("no-dither", "The nearest colours of the format, and no pattern of them"))
        .arg(flag("stats", "Says what became of the triangles"))
        .next_help_heading("For a mesh")
        .arg(text(
            "projection",
            "NAME",
            format!("{} [default: perspective]", names(Named::ALL.iter().map(|known| known.name))),
        ))
        .arg(
            text("from", "YAW,PITCH", "Where the eye is, in degrees, such as 30,20".into())
                .allow_hyphen_values(true),
        )
        .arg(angle("yaw", "The first of these: round the mesh, to the right"))
        .arg(angle("pitch", "The second: above the horizon"))
        .arg(angle("fov", "The field of view of a perspective, upright [default: 40, of some more]"))
        .arg(text(
            "size",
            "WxH",
            "Of the picture in pixels [default: 640x480; a film's 320x240, text's 160x120]".into(),
        ))
        .arg(text("up", "AXIS", "The file's upright axis: y or z [default: y of .obj, z of .stl]".into()))
        .arg(file("gif", "A film: once around the mesh"))
        .arg(
            Arg::new("frames")
                .long("frames")
                .value_name("N")
                .help("Of the film, 2 to 360 [default: 36]")
                .value_parser(value_parser!(u32).range(2..=360)),
        )
        .after_help(FORMATS)
}

/// As a sentence lists them.
pub(crate) fn names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}
