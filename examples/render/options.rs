//! The command line.

use crate::command;
use crate::model::{Look, Named};
use crate::scene::LARGEST;
use clap::{value_parser, Arg, ArgAction, ArgMatches, Command};
use std::path::{Path, PathBuf};

pub(crate) struct Options {
    pub(crate) scene: PathBuf,
    pub(crate) png: Option<PathBuf>,
    pub(crate) ids: Option<PathBuf>,
    pub(crate) depth: Option<PathBuf>,
    pub(crate) used: Option<PathBuf>,
    pub(crate) mode: Mode,
    pub(crate) stats: bool,
    /// For a mesh; `None` where the scene has a camera.
    pub(crate) look: Option<Look>,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mode {
    Solid,
    Wireframe,
    HiddenLine,
}

const FORMATS: &str = r#"SCENE.json:
  {"mesh": "file.obj" | ".stl" | ".json" (relative to the scene),  or  "vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...],
   "model": 4x4 affine, "view": 4x4 rigid, "projection": 4x4 with w > 0 and z/w from -1 (near) to 1 (far) where it is seen,
   "width": W, "height": H (1 to 4096), "viewport": [x, y, w, h] (all, if missing), "cull": "none" | "back"}
Matrices are row-major, vectors columns. A .json mesh is {"vertices": ..., "triangles": ...}.

--ids: little-endian i32, row by row from the top: the triangle seen, -1 for none.
--depth: little-endian u16: 0 near to 65534 far, linear on the screen, 65535 for nothing.
--used: the scene in numbers as it was drawn; drawn again, it gives the same bits.

Bad input: one line on stderr, exit code 2, and no file touched."#;

/// What is asked for; the error is one line.
pub(crate) fn read() -> Result<Options, String> {
    let mut given = command::matches(command())?;
    let scene: PathBuf = given.remove_one("SCENE").unwrap_or_default();
    let mode = match given.remove_one::<String>("mode").as_deref() {
        None | Some("solid") => Mode::Solid,
        Some("wireframe") => Mode::Wireframe,
        Some("hidden-line") => Mode::HiddenLine,
        Some(other) => return Err(format!("--mode: {other} is not solid, wireframe or hidden-line")),
    };
    let look = look(&mut given, &scene)?;
    let mut file = |name: &str| given.remove_one::<PathBuf>(name);
    let [png, ids, depth, used] = ["png", "ids", "depth", "used"].map(&mut file);
    let files = [("--png", &png), ("--ids", &ids), ("--depth", &depth), ("--used", &used)];
    for (place, (flag, file)) in files.iter().enumerate() {
        let same = |earlier: &Option<PathBuf>| file.is_some() && place_of(earlier) == place_of(file);
        if let Some((other, _)) = files[..place].iter().find(|(_, earlier)| same(earlier)) {
            return Err(format!("{flag}: names the same file as {other}"));
        }
        if mode != Mode::Solid && file.is_some() && matches!(*flag, "--ids" | "--depth") {
            return Err(format!("{flag}: needs --mode solid"));
        }
    }
    Ok(Options { scene, png, ids, depth, used, mode, stats: given.get_flag("stats"), look })
}

/// Where a file is or would be, whatever links and dots its name has.
fn place_of(file: &Option<PathBuf>) -> Option<PathBuf> {
    let file = file.as_ref()?;
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = || Some(folder.canonicalize().ok()?.join(file.file_name()?));
    file.canonicalize().ok().or_else(beside).or_else(|| Some(file.clone()))
}

fn command() -> Command {
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
    let text = |name: &'static str, value, help| Arg::new(name).long(name).value_name(value).help(help);
    Command::new("render")
        .about("Draws a scene, depth-tested, as on a microcontroller")
        .arg(
            Arg::new("SCENE")
                .required(true)
                .help("A scene (.json), or a mesh (.obj, .stl)")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(file("png", "The picture"))
        .arg(file("ids", "The triangle seen in each pixel"))
        .arg(file("depth", "The depth of each pixel"))
        .arg(file("used", "The scene as it was drawn, rounded to the crate's numbers"))
        .arg(text("mode", "MODE", "solid (the usual), wireframe or hidden-line"))
        .arg(
            Arg::new("stats")
                .long("stats")
                .action(ArgAction::SetTrue)
                .help("Says what became of the triangles"),
        )
        .next_help_heading("For a mesh")
        .arg(text(
            "projection",
            "NAME",
            "perspective (the usual), orthographic, isometric, cavalier or cabinet",
        ))
        .arg(angle("yaw", "The camera's way round the mesh from +z towards +x [default: 30]"))
        .arg(angle("pitch", "The camera's height over the horizon [default: 20]"))
        .arg(angle("fov", "The field of view of a perspective, upright [default: 40]"))
        .arg(text("size", "WxH", "Of the picture in pixels [default: 320x240]"))
        .after_help(FORMATS)
}

/// The options for a mesh, which a scene must not have.
fn look(given: &mut ArgMatches, scene: &Path) -> Result<Option<Look>, String> {
    let is = |extension: &str| scene.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    if !(is("obj") || is("stl")) {
        for name in ["projection", "yaw", "pitch", "fov", "size"] {
            if given.contains_id(name) {
                return Err(format!("--{name}: a scene has its own camera; this is for .obj and .stl"));
            }
        }
        return match is("json") {
            true => Ok(None),
            false => Err(format!("{}: is neither a scene (.json) nor a mesh (.obj, .stl)", scene.display())),
        };
    }
    let projection = match given.remove_one::<String>("projection") {
        None => Named::Perspective,
        Some(name) => match Named::ALL.iter().find(|(known, _)| *known == name) {
            Some((_, projection)) => *projection,
            None => {
                let names: Vec<_> = Named::ALL.iter().map(|(name, _)| *name).collect();
                return Err(format!("--projection: {name} is none of {}", names.join(", ")));
            }
        },
    };
    let mut angle = |name: &str, usual: f64, low: f64, high: f64| {
        let value = given.remove_one::<f64>(name).unwrap_or(usual);
        if !(low..=high).contains(&value) {
            return Err(format!("--{name}: {value} is not from {low} to {high}"));
        }
        Ok(value)
    };
    let (yaw, pitch) = projection.usual();
    let (yaw, pitch) = (angle("yaw", yaw, -360.0, 360.0)?, angle("pitch", pitch, -90.0, 90.0)?);
    let field_of_view = angle("fov", 40.0, 1.0, 170.0)?;
    let size = given.remove_one::<String>("size").unwrap_or("320x240".into());
    let (width, height) = parse_size(&size)
        .ok_or_else(|| format!("--size: {size} is not WxH, each from 1 to {LARGEST}, such as 320x240"))?;
    Ok(Some(Look { projection, yaw, pitch, field_of_view, width, height }))
}

fn parse_size(text: &str) -> Option<(u32, u32)> {
    let (width, height) = text.split_once('x')?;
    let extent = |text: &str| text.parse().ok().filter(|v| (1..=LARGEST).contains(&i64::from(*v)));
    Some((extent(width)?, extent(height)?))
}
