//! The parsed command line.

use crate::ascii::Characters;
use crate::colours;
use crate::fog::FogStyle;
use crate::import;
use crate::json::Names;
use crate::model::{Fit, Look};
use crate::picture::Format;
use crate::program::Output;
use crate::projections::Named;
use crate::scene::LARGEST;
use crate::style::{Mode, Style, Translucency};
use clap::ArgMatches;
use embedded_graphics::geometry::Size;
use pinhole_import::Axis;
use std::path::{Path, PathBuf};

pub(crate) struct Options {
    pub(crate) scene: PathBuf,
    pub(crate) png: Option<PathBuf>,
    pub(crate) gif: Option<PathBuf>,
    pub(crate) frames: Option<u32>,
    /// The outputs that the calling program adds, and their files.
    pub(crate) more: Vec<(&'static Output, PathBuf)>,
    pub(crate) ascii: Option<Characters>,
    pub(crate) style: Style,
    pub(crate) format: Format,
    /// The degrees by which the surface turns at an edge that is drawn, at least; `None` draws all edges.
    pub(crate) least_turn: Option<f64>,
    pub(crate) stats: bool,
    /// How the model is imported.
    pub(crate) import: pinhole_import::Options,
    /// The camera for a mesh; `None` for a scene, which has its own.
    pub(crate) look: Option<Look>,
    /// The frame of the firmware that is drawn in place of the program's own picture.
    pub(crate) firmware: Option<u32>,
    /// Whether no output was named, so that the picture goes to the default file.
    pub(crate) unasked: bool,
}

impl Options {
    /// The files to write.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = &Path> {
        let more = self.more.iter().map(|(_, file)| file);
        self.png.iter().chain(&self.gif).chain(more).map(PathBuf::as_path)
    }
}

/// Checks the parsed command line, in which `more` are outputs beside pictures. The error is one line.
pub(crate) fn read(mut given: ArgMatches, more: &'static [Output]) -> Result<Options, String> {
    // The options that name files to write.
    let outputs: Vec<&str> =
        ["png", "gif"].into_iter().chain(more.iter().map(|output| output.name)).collect();
    let scene: PathBuf = given.remove_one("SCENE").unwrap_or_default();
    let is_dash = |path: &PathBuf| path.as_os_str() == "-";
    if is_dash(&scene) {
        return Err(
            "-: standard input is not read, as the name tells the format: name a file (.obj, .stl, .json)"
                .into(),
        );
    }
    if let Some(name) = outputs.iter().find(|name| given.get_one(name).is_some_and(is_dash)) {
        return Err(format!("--{name}: - is no file, and standard output has the messages: name a file"));
    }
    let ascii = choice::<Characters>(&mut given, "ascii")?;
    let painted = [
        "colour",
        "background",
        "format",
        "door",
        "alpha",
        "fog",
        "no-dither",
        "half",
        "lit-texture",
        "smooth-lines",
        "smooth-faces",
    ];
    let painted = import::typed(&given, &painted);
    let (style, format) = style(&mut given)?;
    let least_turn = edges(&given, style.mode)?;
    let import = import::options(&given);
    if !import::is_model(&scene) {
        import::refuse_texture(&given)?;
    }
    let firmware: Option<u32> = given.get_one("firmware").copied();
    if firmware.is_some() && !import::is_model(&scene) {
        return Err("--firmware: draws a model: use it with .obj and .stl".into());
    }
    let is_raw = more.iter().any(|output| given.contains_id(output.name));
    let look = look(&mut given, &scene, ascii.is_some(), is_raw)?;
    let files: Vec<_> = outputs.iter().map(|name| given.remove_one::<PathBuf>(name)).collect();
    let frames = given.remove_one("frames");
    if frames.is_some() && files[1].is_none() {
        return Err("--frames: only a film has frames: give --gif FILE too".into());
    }
    let stats = given.get_flag("stats");
    for (place, (name, file)) in outputs.iter().zip(&files).enumerate() {
        let same = |earlier: &Option<PathBuf>| file.is_some() && canonical(earlier) == canonical(file);
        if let Some(other) = files[..place].iter().position(same) {
            return Err(format!("--{name}: names the same file as --{}", outputs[other]));
        }
        let of_faces = more.iter().any(|output| output.name == *name && output.needs_faces);
        if style.mode.of_lines() && file.is_some() && of_faces {
            return Err(format!("--{name}: needs --mode solid"));
        }
    }
    let nothing = files.iter().all(Option::is_none) && ascii.is_none() && !stats;
    let mut files = files.into_iter();
    let (mut png, gif) = (files.next().flatten(), files.next().flatten());
    let unasked = nothing && look.is_some();
    if unasked {
        let mut name = scene.file_stem().unwrap_or_default().to_os_string();
        name.push(".png"); // with_extension would make a.png of the stem a.v2
        png = Some(Path::new("target/render").join(name));
    }
    if let Some(name) = painted.filter(|_| png.is_none() && gif.is_none()) {
        return Err(format!("--{name}: applies to pictures alone: give --png FILE too"));
    }
    Ok(Options {
        scene,
        png,
        gif,
        frames,
        more: more.iter().zip(files).filter_map(|(output, file)| Some((output, file?))).collect(),
        ascii,
        style,
        format,
        least_turn,
        stats,
        import,
        look,
        firmware,
        unasked,
    })
}

/// The canonical path of a file that exists or would be created.
fn canonical(file: &Option<PathBuf>) -> Option<PathBuf> {
    let file = file.as_ref()?;
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = || Some(folder.canonicalize().ok()?.join(file.file_name()?));
    file.canonicalize().ok().or_else(beside).or_else(|| Some(file.clone()))
}

/// The value that an option's name stands for. The error lists the known names.
fn choice<T: Names>(given: &mut ArgMatches, option: &str) -> Result<Option<T>, String> {
    let chosen = given.remove_one::<String>(option).map(|name| T::named(&name)).transpose();
    chosen.map_err(|problem| format!("--{option}: {problem}"))
}

fn style(given: &mut ArgMatches) -> Result<(Style, Format), String> {
    let mode = choice(given, "mode")?.unwrap_or(Mode::Solid);
    let format = choice(given, "format")?.unwrap_or(Format::Rgb888);
    let mut colour = |option: &str| match given.remove_one::<String>(option) {
        None => Ok(None),
        Some(text) => colours::parse(&text).map(Some).map_err(|e| format!("--{option}: {e}")),
    };
    let (colour, background) = (colour("colour")?, colour("background")?);
    let dither = format.wants_dither() && !given.get_flag("no-dither");
    let translucency = match (given.get_one::<u8>("door"), given.get_one::<u8>("alpha")) {
        (Some(&of_64), _) => Translucency::Door(of_64),
        (_, Some(&of_32)) => Translucency::Alpha(of_32),
        _ if given.get_flag("half") => Translucency::Half,
        _ => Translucency::Opaque,
    };
    let (lit_texture, smooth_lines) = (given.get_flag("lit-texture"), given.get_flag("smooth-lines"));
    if smooth_lines && !mode.of_lines() {
        return Err("--smooth-lines: needs --mode wireframe or hidden-line".into());
    }
    let smooth_faces = given.get_flag("smooth-faces");
    if smooth_faces && format == Format::Mono {
        return Err(
            "--smooth-faces: mono has no mixed colours: give --format gray2 or one of more colours".into()
        );
    }
    if let Some(name) = import::typed(given, &["door", "alpha", "half"]).filter(|_| smooth_faces) {
        return Err(format!("--smooth-faces: is for opaque faces: omit --{name}"));
    }
    let of_faces = import::typed(given, &["door", "alpha", "half", "lit-texture", "texture", "smooth-faces"]);
    if let Some(name) = of_faces.filter(|_| mode.of_lines()) {
        return Err(format!("--{name}: is for faces: needs --mode solid, flat or gouraud"));
    }
    if colour.is_some() && given.contains_id("texture") {
        return Err("--texture: is hidden by --colour: omit one of them".into());
    }
    let fog = given.get_one::<String>("fog").map(|text| FogStyle::parse(text)).transpose();
    let fog = fog.map_err(|e| format!("--fog: {e}"))?;
    if fog.is_some() && mode.of_lines() {
        return Err("--fog: is for faces: needs --mode solid, flat or gouraud".into());
    }
    let usual = Style::chosen(mode, format, colour, background, dither);
    Ok((Style { fog, lit_texture, translucency, smooth_lines, smooth_faces, ..usual }, format))
}

/// The edges that a mode of lines draws.
fn edges(given: &ArgMatches, mode: Mode) -> Result<Option<f64>, String> {
    let angle = given.get_one::<f64>("feature-angle").copied();
    let edges = given.get_one::<String>("edges").map(String::as_str);
    if let Some(name) = import::typed(given, &["edges", "feature-angle"]).filter(|_| !mode.of_lines()) {
        return Err(format!("--{name}: needs --mode wireframe or hidden-line"));
    }
    if edges == Some("all") && angle.is_some() {
        return Err("--feature-angle: is that of --edges feature".into());
    }
    if let Some(angle) = angle.filter(|angle| !(0.0..=180.0).contains(angle)) {
        return Err(format!("--feature-angle: {angle} is not from 0 to 180"));
    }
    Ok(match edges {
        Some("all") => None,
        Some(_) => angle.or(Some(30.0)),
        None => angle.or(mode.least_turn()),
    })
}

/// The options of the camera, which are for meshes alone.
fn look(given: &mut ArgMatches, scene: &Path, ascii: bool, is_raw: bool) -> Result<Option<Look>, String> {
    if !import::is_model(scene) {
        if !scene.extension().is_some_and(|e| e.eq_ignore_ascii_case("json")) {
            return Err(format!(
                "{}: is neither a scene (.json) nor a mesh (.obj, .stl): export .stl or .obj",
                scene.display()
            ));
        }
        let of_camera = ["projection", "from", "yaw", "pitch", "fov", "frame", "size", "gif", "frames"];
        if let Some(name) = import::typed(given, &of_camera) {
            return Err(format!("--{name}: a scene has its own camera; use this option with .obj and .stl"));
        }
        if let Some(name) = import::typed(given, &pinhole_import::arguments::NAMES) {
            return Err(format!(
                "--{name}: a scene is drawn as it stands; use this option with .obj and .stl"
            ));
        }
        return Ok(None);
    }
    let projection = choice(given, "projection")?.unwrap_or(Named::ALL[0]);
    let from = match given.remove_one::<String>("from") {
        None => [None; 2],
        Some(_) if given.contains_id("yaw") || given.contains_id("pitch") => {
            return Err("--from: sets yaw and pitch: omit --yaw and --pitch".into())
        }
        Some(text) => {
            let pair =
                text.split_once(',').and_then(|(yaw, pitch)| Some([yaw.parse().ok()?, pitch.parse().ok()?]));
            let [yaw, pitch] =
                pair.ok_or_else(|| format!("--from: {text} is not YAW,PITCH in degrees, such as 30,20"))?;
            [Some(yaw), Some(pitch)]
        }
    };
    let given_fov = given.contains_id("fov");
    let mut angle = |name: &str, from: Option<f64>, usual: f64, low: f64, high: f64| {
        let value = given.remove_one::<f64>(name).or(from).unwrap_or(usual);
        if !(low..=high).contains(&value) {
            let option = if from.is_some() { format!("from: {name}") } else { name.into() };
            return Err(format!("--{option}: {value} is not from {low} to {high}"));
        }
        Ok(value)
    };
    let yaw = angle("yaw", from[0], projection.yaw, -360.0, 360.0)?;
    let pitch = angle("pitch", from[1], projection.pitch, -90.0, 90.0)?;
    if given_fov && !projection.kind.meets_in_the_eye() {
        return Err(format!("--fov: {} has no field of view", projection.name));
    }
    let field_of_view = angle("fov", None, projection.field_of_view(), 1.0, 170.0)?;
    let usual = match (ascii, is_raw || given.contains_id("gif")) {
        _ if given.contains_id("firmware") => "240x240",
        (true, _) => "160x120",
        (false, true) => "320x240",
        (false, false) => "640x480",
    };
    let size = given.remove_one::<String>("size").unwrap_or(usual.into());
    let Size { width, height } = pinhole_apps_support::command::size(&size, 1..=LARGEST)?;
    let fit = choice(given, "frame")?.unwrap_or(Fit::Sphere { zoom: 1.0 });
    let up = Axis::of_file(scene); // unless the importer says otherwise
    Ok(Some(Look { projection, yaw, pitch, field_of_view, width, height, up, fit }))
}
