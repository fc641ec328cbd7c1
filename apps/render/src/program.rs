//! The command: from its options to its output files.

use crate::arguments;
use crate::bands::Report;
use crate::firmware::{self, Code};
use crate::model::Look;
use crate::options::{self, Options};
use crate::paint::Subject;
use crate::quantised::{self, Quantised};
use crate::scene::Scene;
use crate::{ascii, texture, turntable};
use crate::{import, model, picture};
use clap::ArgMatches;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::{draw::Statistics, Angle};
use pinhole_apps_support::files::{self, Outputs};
use pinhole_apps_support::{canvas::Canvas, command, still};
use std::cell::LazyCell;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The bytes of a file, and the statistics of what was drawn for it.
pub type Written = (Vec<u8>, Option<Statistics>);

/// An output of a scene beside pictures, which another program adds to the command.
pub struct Output {
    /// The option that names its file.
    pub name: &'static str,
    pub help: &'static str,
    /// Whether it shows faces, and so excludes modes of lines.
    pub needs_faces: bool,
    pub bytes: fn(&Scene, &Quantised) -> Result<Written, String>,
}

/// Runs the command. `code` draws the firmware's picture.
pub fn run(code: &Code) -> ExitCode {
    command::run(|| drawn(command::installed(arguments::command(&[]).name("pinhole-render"))?, code, &[]))
}

/// Runs a parsed command line with more outputs than pictures. The error is the message to print.
pub fn drawn(given: ArgMatches, code: &Code, more: &'static [Output]) -> Result<ExitCode, String> {
    let options = options::read(given, more)?;
    match options.firmware.filter(|_| code.project.is_none()).and_then(|_| firmware::project(&options.scene))
    {
        Some(project) => firmware::run_in(&project),
        None => draw(&options, code).map(|()| ExitCode::SUCCESS),
    }
}

fn draw(options: &Options, code: &Code) -> Result<(), String> {
    let named = |e: String| format!("{}: {e}", options.scene.display());
    let apart = |input: &Path| files::apart(input, options.outputs());
    apart(&options.scene)?;
    if let (Some(frame), Some(look)) = (options.firmware, &options.look) {
        return as_firmware(options, code, frame, Size::new(look.width, look.height));
    }
    let mut outputs = Outputs::default();
    let mut imported = None;
    let scene = match &options.look {
        Some(look) => {
            let mut model = import::read(&options.scene, &options.import)?;
            model.files.iter().try_for_each(|file| apart(file))?;
            let look = &Look { up: model.up, ..*look };
            let colors = import::colors(&mut model);
            let texture = texture::of_model(&model);
            if let Some(path) = &options.gif {
                let mesh = (&model.triangles, &colors, texture.as_ref());
                let frames = options.frames.unwrap_or(36);
                outputs.stream(path, |file| {
                    let (style, format) = (&options.style, options.format);
                    turntable::gif(mesh, look, style, format, options.least_turn, frames, (path, file))
                })?;
            }
            let triangles = std::mem::take(&mut model.triangles);
            imported = Some(model);
            Scene { texture, ..model::scene(triangles, colors, look)? }
        }
        None => {
            let scene = Scene::read(&options.scene)?;
            scene.mesh_files.iter().try_for_each(|file| apart(file))?;
            scene.pictures().try_for_each(apart)?;
            scene
        }
    };
    if options.style.lit_texture && scene.texture.as_ref().is_none_or(|texture| texture.picture.is_none()) {
        match options.look {
            // The importer says why there is none.
            Some(_) if options.import.texture.is_some() => {}
            Some(_) => return Err("--lit-texture: no texture is shown: give --texture COLORS too".into()),
            None => {
                return Err("--lit-texture: the scene has no picture: give it \"uv\" and \"texture\"".into())
            }
        }
    }
    let (quantised, used) = Quantised::settle(&scene).map_err(named)?;
    // The statistics of any one output: all outputs draw the same faces or edges.
    let (mut report, mut text) = (None, None);
    for (output, path) in &options.more {
        let (bytes, drawn) = (output.bytes)(&used, &quantised).map_err(named)?;
        outputs.add(path, &bytes)?;
        report = drawn.map(|statistics| Report { statistics, ..Report::default() }).or(report);
    }
    let subject = LazyCell::new(|| Subject::with_edges(&used, &options.style, options.least_turn));
    let picture = || picture::picture(&subject, (&used, &quantised), &options.style, options.format);
    if let Some(path) = &options.png {
        let (pixels, drawn) = picture().map_err(named)?;
        let size = Size::new(used.width, used.height);
        add_png(&mut outputs, options, path, size, &pixels)?;
        report = Some(drawn);
    }
    if let Some(characters) = options.ascii {
        let from = (&used, &quantised);
        let (lines, drawn) = ascii::text(&subject, from, &options.style, characters).map_err(named)?;
        text = Some(lines);
        report = Some(drawn);
    }
    let told = options.stats || options.unasked || (outputs.is_empty() && text.is_none());
    if told && report.is_none() {
        report = Some(picture().map_err(named)?.1);
    }
    let written = outputs.settle()?;
    if let Some(text) = &text {
        command::say(text.trim_end_matches('\n'))?;
    }
    let parts = if options.style.mode.of_lines() { subject.parts.len() } else { 1 };
    tell(options, &scene, &used, parts, report.filter(|_| told), &written)?;
    if let Some(model) = &imported {
        if let Some(size) = import::size(model).filter(|_| told) {
            command::say(format_args!("{}: {size}", options.scene.display()))?;
        }
        command::warn(&options.scene, &model.warnings);
    }
    Ok(())
}

/// Adds a picture. A name that nobody asked for may lie in a folder that does not exist.
fn add_png(
    outputs: &mut Outputs,
    options: &Options,
    path: &Path,
    size: Size,
    pixels: &[Rgb888],
) -> Result<(), String> {
    let png = still::png(size, pixels).map_err(|e| e.to_string())?;
    if let Some(folder) = path.parent().filter(|_| options.unasked) {
        command::folder(folder)?;
    }
    outputs.add(path, &png)
}

/// A frame of firmware with this model, or its turn as a film.
fn as_firmware(options: &Options, code: &Code, frame: u32, size: Size) -> Result<(), String> {
    let model = &options.scene;
    let named = |e: String| format!("{}: {e}", model.display());
    let imported = pinhole_import::import(model, &firmware::options(code, &options.import));
    let imported = imported.map_err(|e| e.to_string())?;
    imported.files.iter().try_for_each(|file| files::apart(file, options.outputs()))?;
    let picture = |frame: u32, frames: u32| {
        let mut canvas = Canvas::new(size, Rgb565::MAGENTA);
        let turn = Angle::turns(frame as i32, frames); // both below 2¹⁰
        let statistics = (code.draw)(&imported, turn, &mut canvas).map_err(named)?;
        let pixels: Vec<Rgb888> = canvas.pixels().iter().map(|&colour| colour.into()).collect();
        Ok::<_, String>((pixels, statistics))
    };
    let first = picture(frame, firmware::FRAMES);
    if first.is_err() {
        command::warn(model, &imported.warnings); // they say what to do
    }
    let (pixels, statistics) = first?;
    let mut outputs = Outputs::default();
    if let Some(path) = &options.gif {
        let frames = options.frames.unwrap_or(firmware::FRAMES);
        outputs.stream(path, |file| {
            turntable::film(size, frames, (path, file), |frame| Ok(picture(frame, frames)?.0))
        })?;
    }
    if let Some(path) = &options.png {
        add_png(&mut outputs, options, path, size, &pixels)?;
    }
    for (path, bytes) in outputs.settle()? {
        command::say(format_args!("{}: {bytes} bytes", path.display()))?;
    }
    let say = |what: fmt::Arguments<'_>| command::say(format_args!("{}: {what}", model.display()));
    let Statistics { drawn, culled, clipped, outside, degenerate, .. } = statistics;
    let (frames, Size { width, height }, faces) = (firmware::FRAMES, size, imported.faces.len());
    say(format_args!(
        "frame {frame} of {frames}, {width} x {height} pixels; of {faces} faces {drawn} drawn ({clipped} of them clipped), {culled} \
         culled, {outside} outside, {degenerate} without area"
    ))?;
    say(format_args!("in firmware: {}", imported.size()))?;
    if let Some(project) = code.project {
        command::say(format_args!("{project}: drawn by its src/picture.rs and build.rs"))?;
    }
    command::warn(model, &imported.warnings);
    if options.import != pinhole_import::Options::default() {
        command::complain(format_args!(
            "{}: note: set the same in the `Options` of the project's build.rs, so that the firmware draws this picture",
            model.display()
        ));
    }
    Ok(())
}

fn tell(
    options: &Options,
    scene: &Scene,
    used: &Scene,
    parts: usize,
    report: Option<Report>,
    written: &[(PathBuf, u64)],
) -> Result<(), String> {
    let say = |what: fmt::Arguments<'_>| command::say(format_args!("{}: {what}", options.scene.display()));
    if let Some(Report { statistics, sprites, .. }) = report {
        let Statistics { drawn, culled, clipped, outside, degenerate, .. } = statistics;
        let (what, count) = match options.style.mode.of_lines() {
            false => ("triangles".into(), scene.triangles.len()),
            true => {
                let edges = match parts {
                    1 => "edges".into(),
                    // Each part draws all edges of its own faces.
                    parts => format!("edges (in {parts} parts; edges between parts count twice)"),
                };
                (edges, (drawn + outside) as usize)
            }
        };
        let (Scene { width, height, .. }, vertices) = (scene, scene.vertices.len());
        say(format_args!(
            "{width} x {height} pixels, {vertices} vertices; of {count} {what} {drawn} drawn ({clipped} of them clipped), {culled} \
             culled, {outside} outside, {degenerate} without area"
        ))?;
        let Statistics { drawn, outside, degenerate, .. } = sprites;
        let count = drawn + outside + degenerate;
        if count > 0 {
            say(format_args!(
                "of {count} sprites {drawn} drawn, {outside} outside, {degenerate} without size"
            ))?;
        }
    }
    if options.stats {
        let (part, pixels) = quantised::moved(scene, used);
        command::say(format_args!(
            "rounding to the crate's number formats moves a vertex by at most {part:.2e} of the mesh's extent, and by at \
             most {pixels:.2e} px on the screen"
        ))?;
    }
    for (path, bytes) in written {
        command::say(format_args!("{}: {bytes} bytes", path.display()))?;
    }
    if written.is_empty() && options.ascii.is_none() {
        say(format_args!("nothing was written: give --png FILE for the picture, or --ascii for text"))?;
    }
    Ok(())
}
