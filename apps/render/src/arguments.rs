//! The options and their help.

use crate::json::Names;
use crate::paint::Mode;
use crate::picture::Format;
use crate::program::Output;
use crate::projections::Named;
use crate::{firmware, import};
use clap::builder::PossibleValuesParser;
use clap::{value_parser, Arg, ArgAction, Command};
use std::path::PathBuf;

const FORMATS: &str = r#"pinhole-render MODEL.stl draws target/render/MODEL.png; add --up y if the model lies on its side. Examples:
  pinhole-render MODEL.stl --projection isometric --mode hidden-line --png OUT.png
  pinhole-render MODEL.obj --from 60,30 --colour gold --background '#203040' --size 320x240
  pinhole-render MODEL.obj --format gray4 --size 128x64        the look of an OLED
  pinhole-render MODEL.obj --gif OUT.gif                       one turn around the model
  pinhole-render firmware/model.stl --firmware                 the picture of the firmware in this folder, pixel by pixel
  pinhole-render firmware/model.stl --firmware --gif OUT.gif   its 120 frames
  pinhole-render MODEL.obj --ascii                             as text; --ascii=braille is finer

SCENE.json:
  {"mesh": "file.obj" | ".stl" | ".json" (relative to the scene's folder),  or  "vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...],
     or  "meshes": [MESH, ...],
   "camera": CAMERA,  or  "view": 4x4 rigid, "projection": 4x4 with w > 0 and z/w from -1 (near) to 1 (far) in the view volume,
   "model": 4x4 affine (default: the identity),
   "colors": [[r, g, b], ...] of the triangles, 0 to 255 (default: those of an .obj's materials),
   "emission": [[r, g, b], ...] of the light that the triangles emit, added to the lit colours (optional; not on textures),
   "uv": [[u, v], ...] of the vertices, or [[[u, v], [u, v], [u, v]], ...] of the triangles' corners, in texels, (0, 0) at the upper left,
   "texture": [W, H] or "FILE.png" or ".bmp", 8 to 256 a side, powers of two, "wrap": "repeat" | "clamp" (optional; uv and texture belong together),
   "lights": [LIGHT, ...] (default: ["key", "fill", "ambient"], lamps at the left and the right of the camera),
   "fog": [START, END] (optional: linear fog of the background's colour, between two distances before the camera),
   "sprites": [SPRITE, ...] (optional: pictures that face the viewer, drawn after faces or edges),
   "width": W, "height": H (1 to 4096), "viewport": [x, y, w, h] (default: the picture), "cull": "none" | "back",
   "name", "source", "licence": any text, ignored}
MESH:
  {"mesh" or "vertices" and "triangles", "model": 4x4 affine that places it in the scene, "colors", "emission" as those of a scene}
CAMERA:
  {"eye": [x, y, z], "target": [x, y, z], "up": [x, y, z] (default: [0, 1, 0]), "fov": DEGREES across the narrower side (default: 40),
   "near": N, "far": N (default: just around the scene)},  or one that frames the scene, with the defaults of these options:
  {"projection": "isometric" ..., "yaw": DEGREES, "pitch": DEGREES, "fov": DEGREES, "up": "x" | "y" | "z" | "-x" ... (default: "y"),
   "frame": "sphere" | "outline"}
LIGHT:
  "key" | "fill" | "ambient",  or  {"ambient": LEVEL},  or  {"towards": [x, y, z] to the lamp, "from": "world" | "camera" (the axes of
   towards; default: "world"), "level": LEVEL}, levels from 0 to 256
SPRITE:
  {"at": [x, y, z] of the world, or [[x, y, z], ...] for particles,
   "picture": "FILE.png" or ".bmp" (relative to the scene's folder), "key": [r, g, b] of transparent pixels (optional; pixels that are less
     than half opaque are transparent, too),  or  "color": [r, g, b], "picture": "square" | "disc" (default: square),
   "pixels": N for each pixel of the file, or of the side of a square or disc, 1 to 255,  or  "size": [width, height],  or  "height": H in
     world units, which shrink with distance (default: "pixels": 1),
   "anchor": the point of the picture at the point of the world: "center" (default) | "top-left" | "bottom-center" ... | [column, row],
   "alpha": N of 32 parts, mixed with what is behind, from far to near (optional), "depth": "test" (default) | "none": over everything}
Matrices are row-major and multiply column vectors. A .json mesh is {"vertices": ..., "triangles": ...}.

An .obj or .stl is drawn as the mesh that pinhole-import makes of it, and with its warnings: z of .stl and y of .obj are up, faces
are seen from their front alone (counter-clockwise) unless --two-sided, and the camera is that of the firmware templates, which
frames the bounding sphere. Faces have the diffuse and emissive colours of an OBJ's materials, unless --colour is given.

Bad input: one line on stderr, exit code 2, and no file is changed."#;

/// Options that `--firmware` excludes: the template's code decides them, or they name other outputs.
const NOT_IN_FIRMWARE: [&str; 21] = [
    "alpha",
    "ascii",
    "background",
    "colour",
    "door",
    "edges",
    "feature-angle",
    "fog",
    "format",
    "fov",
    "frame",
    "from",
    "half",
    "lit-texture",
    "mode",
    "no-dither",
    "pitch",
    "projection",
    "smooth-lines",
    "texture",
    "yaw",
];

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
    let text =
        |name: &'static str, value, help: String| Arg::new(name).long(name).value_name(value).help(help);
    let flag = |name: &'static str, help| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    let modes = Mode::list();
    let formats = Format::list();
    Command::new("render")
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
        ))
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
                .conflicts_with_all(NOT_IN_FIRMWARE)
                .conflicts_with_all(more.iter().map(|output| output.name)),
        )
        .arg(file("gif", "Write a film of one turn around the mesh"))
        .arg(
            Arg::new("frames")
                .long("frames")
                .value_name("N")
                .help("Frames of the film, 2 to 360 [default: 36; all 120 with --firmware]")
                .value_parser(value_parser!(u32).range(2..=360)),
        )
        .after_help(FORMATS)
}
