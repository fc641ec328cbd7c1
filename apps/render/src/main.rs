//! Draws a model or a scene with depth test, through the library's public interface: pictures for people, raw numbers for
//! other programs.
//!
//! ```text
//! cargo run --release -p pinhole-render -- MODEL.stl
//! cargo run --release -p pinhole-render -- --help
//! ```

mod arguments;
mod ascii;
mod colours;
mod draw;
mod options;
mod palette;
mod turntable;
mod used;

use embedded_graphics::{geometry::Size, pixelcolor::Rgb888};
use options::Options;
use pinhole::{Angle, Statistics};
use pinhole_apps_support::{command, files, still};
use pinhole_render::model::Look;
use pinhole_render::paint::Subject;
use pinhole_render::quantised::{self, Quantised};
use pinhole_render::scene::Scene;
use pinhole_render::{firmware, import, model, picture};
use std::cell::LazyCell;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        run(&options::read()?)?;
        Ok(ExitCode::SUCCESS)
    })
}

fn run(options: &Options) -> Result<(), String> {
    let named = |e: String| format!("{}: {e}", options.scene.display());
    let apart = |input: &Path| files::apart(input, options.outputs());
    apart(&options.scene)?;
    if let Some(look) = options.look.as_ref().filter(|_| options.firmware) {
        return firmware(options, Size::new(look.width, look.height));
    }
    let mut outputs: Vec<(&Path, Vec<u8>)> = Vec::new();
    let mut imported = None;
    let scene = match &options.look {
        Some(look) => {
            let mut model = import::read(&options.scene, &options.import)?;
            model.libraries.iter().try_for_each(|library| apart(library))?;
            let look = &Look { up: model.up, ..*look };
            if let Some(path) = &options.gif {
                let mesh = (&model.triangles, &model.colors[..]);
                let film = turntable::gif(mesh, look, &options.style, options.format, options.frames);
                outputs.push((path, film.map_err(named)?));
            }
            let triangles = std::mem::take(&mut model.triangles);
            let colors = std::mem::take(&mut model.colors);
            imported = Some(model);
            model::scene(triangles, colors, look)?
        }
        None => {
            let scene = Scene::read(&options.scene)?;
            scene.mesh_file.as_deref().map_or(Ok(()), apart)?;
            scene
        }
    };
    let (quantised, used) = Quantised::settle(&scene).map_err(named)?;
    // The statistics of any one output: all outputs draw the same faces or edges.
    let (mut statistics, mut text) = (None, None);
    if options.ids.is_some() || options.depth.is_some() {
        let solid = draw::solid(&used, &quantised).map_err(named)?;
        if let Some(path) = &options.ids {
            let ids = solid.ids.pixels().iter().flat_map(|seen| seen.index().to_le_bytes());
            outputs.push((path, ids.collect()));
        }
        if let Some(path) = &options.depth {
            outputs.push((path, solid.depth.iter().flat_map(|d| d.to_le_bytes()).collect()));
        }
        statistics = Some(solid.statistics);
    }
    let subject = LazyCell::new(|| Subject::new(&used, options.style.mode));
    let picture = || picture::picture(&subject, (&used, &quantised), &options.style, options.format);
    if let Some(path) = &options.png {
        let (pixels, drawn) = picture().map_err(named)?;
        let size = Size::new(used.width, used.height);
        outputs.push((path, still::png(size, &pixels).map_err(|e| e.to_string())?));
        statistics = Some(drawn);
    }
    if let Some(characters) = options.ascii {
        let from = (&used, &quantised);
        let (lines, drawn) = ascii::text(&subject, from, &options.style, characters).map_err(named)?;
        text = Some(lines);
        statistics = Some(drawn);
    }
    if let Some(path) = &options.used {
        outputs.push((path, used::json(&used).into()));
    }
    let told = options.stats || options.unasked || (outputs.is_empty() && text.is_none());
    if told && statistics.is_none() {
        statistics = Some(picture().map_err(named)?.1);
    }
    if let Some(folder) = options.png.as_deref().and_then(Path::parent).filter(|_| options.unasked) {
        command::folder(folder)?;
    }
    files::write(&outputs)?;
    if let Some(text) = &text {
        command::say(text.trim_end_matches('\n'))?;
    }
    let parts = if options.style.mode.of_lines() { subject.parts.len() } else { 1 };
    tell(options, &scene, &used, parts, statistics.filter(|_| told), &outputs)?;
    if let Some(model) = &imported {
        if let Some(size) = import::size(model).filter(|_| told) {
            command::say(format_args!("{}: {size}", options.scene.display()))?;
        }
        command::warn(&options.scene, &model.warnings);
    }
    Ok(())
}

/// The first frame of firmware that was made from the template with this model.
fn firmware(options: &Options, size: Size) -> Result<(), String> {
    let model = &options.scene;
    let imported = pinhole_import::import(model, &firmware::options(&options.import));
    let imported = imported.map_err(|e| e.to_string())?;
    let (canvas, statistics) =
        firmware::frame(&imported, Angle::ZERO, size).map_err(|e| format!("{}: {e}", model.display()))?;
    if let Some(path) = &options.png {
        let pixels: Vec<Rgb888> = canvas.pixels().iter().map(|&colour| colour.into()).collect();
        let png = still::png(size, &pixels).map_err(|e| e.to_string())?;
        if let Some(folder) = path.parent().filter(|_| options.unasked) {
            command::folder(folder)?;
        }
        command::say(format_args!("{}: {} bytes", path.display(), png.len()))?;
        files::write(&[(&**path, png)])?;
    }
    let Statistics { drawn, culled, clipped, outside, degenerate, .. } = statistics;
    command::say(format_args!(
        "{}: {} x {} pixels; of {} faces {drawn} drawn ({clipped} of them clipped), {culled} culled, {outside} outside, \
         {degenerate} without area",
        model.display(),
        size.width,
        size.height,
        imported.faces.len(),
    ))?;
    command::say(format_args!("{}: in firmware: {}", model.display(), imported.size()))?;
    command::warn(model, &imported.warnings);
    Ok(())
}

fn tell(
    options: &Options,
    scene: &Scene,
    used: &Scene,
    parts: usize,
    statistics: Option<Statistics>,
    outputs: &[(&Path, Vec<u8>)],
) -> Result<(), String> {
    if let Some(Statistics { drawn, culled, clipped, outside, degenerate, .. }) = statistics {
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
        command::say(format_args!(
            "{}: {} x {} pixels, {} vertices; of {count} {what} {drawn} drawn ({clipped} of them clipped), \
             {culled} culled, {outside} outside, {degenerate} without area",
            options.scene.display(),
            scene.width,
            scene.height,
            scene.vertices.len(),
        ))?;
    }
    if options.stats {
        let (part, pixels) = quantised::moved(scene, used);
        command::say(format_args!(
            "rounding to the crate's number formats moves a vertex by at most {part:.2e} of the mesh's extent, and by at \
             most {pixels:.2e} px on the screen"
        ))?;
    }
    for (path, bytes) in outputs {
        command::say(format_args!("{}: {} bytes", path.display(), bytes.len()))?;
    }
    if outputs.is_empty() && options.ascii.is_none() {
        command::say("nothing was written: give --png, --ids, --depth or --used")?;
    }
    Ok(())
}
