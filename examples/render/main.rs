//! Draws a scene or a mesh, depth-tested, through the public interface: pictures for people, and raw
//! numbers for other programs.
//!
//! ```text
//! cargo run --release --example render -- --help
//! ```

#[path = "../common/canvas.rs"]
mod canvas;
#[path = "../common/command.rs"]
mod command;
mod draw;
#[path = "../common/files.rs"]
mod files;
#[path = "../common/json.rs"]
mod json;
mod model;
mod options;
mod quantised;
mod scene;
#[path = "../common/still.rs"]
mod still;
mod used;

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;
use options::{Mode, Options};
use pinhole::Statistics;
use quantised::Quantised;
use scene::Scene;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        run(&options::read()?)?;
        Ok(ExitCode::SUCCESS)
    })
}

fn run(options: &Options) -> Result<(), String> {
    let scene = match &options.look {
        Some(look) => model::scene(scene::read_mesh(&options.scene)?, look),
        None => Scene::read(&options.scene)?,
    };
    let named = |e: String| format!("{}: {e}", options.scene.display());
    let (quantised, used) = Quantised::settle(&scene).map_err(named)?;
    let mut outputs: Vec<(&Path, Vec<u8>)> = Vec::new();
    let statistics = match options.mode {
        Mode::Solid => {
            let solid = draw::solid(&used, &quantised).map_err(named)?;
            let ids = solid.ids.pixels();
            if let Some(path) = &options.ids {
                outputs.push((path, ids.iter().flat_map(|seen| seen.index().to_le_bytes()).collect()));
            }
            if let Some(path) = &options.depth {
                outputs.push((path, solid.depth.iter().flat_map(|d| d.to_le_bytes()).collect()));
            }
            if let Some(path) = &options.png {
                outputs.push((path, png(&used, &draw::shaded(&used, &quantised, ids))?));
            }
            solid.statistics
        }
        Mode::Wireframe | Mode::HiddenLine => {
            let hidden = options.mode == Mode::HiddenLine;
            let (picture, statistics) = draw::edges(&used, &quantised, hidden).map_err(named)?;
            if let Some(path) = &options.png {
                outputs.push((path, png(&used, &picture)?));
            }
            statistics
        }
    };
    if let Some(path) = &options.used {
        outputs.push((path, used::json(&used).into()));
    }
    files::write(&outputs)?;
    tell(options, &scene, &used, &statistics, &outputs);
    Ok(())
}

fn png(scene: &Scene, pixels: &[Rgb888]) -> Result<Vec<u8>, String> {
    still::png(Size::new(scene.width, scene.height), pixels).map_err(|e| e.to_string())
}

fn tell(
    options: &Options,
    scene: &Scene,
    used: &Scene,
    statistics: &Statistics,
    outputs: &[(&Path, Vec<u8>)],
) {
    if outputs.is_empty() || options.stats {
        let Statistics { drawn, culled, clipped, outside, degenerate, .. } = statistics;
        let (what, count) = match options.mode {
            Mode::Solid => ("triangles", scene.triangles.len()),
            Mode::Wireframe | Mode::HiddenLine => ("edges", (drawn + outside) as usize),
        };
        println!(
            "{}: {} x {} pixels, {} vertices; of {count} {what} {drawn} drawn ({clipped} of them cut), \
             {culled} culled, {outside} outside, {degenerate} without area",
            options.scene.display(),
            scene.width,
            scene.height,
            scene.vertices.len(),
        );
    }
    if options.stats {
        let (part, pixels) = quantised::moved(scene, used);
        println!(
            "in the crate's numbers a vertex moves by at most {part:.2e} of the mesh's extent; all rounding of \
             the input by at most {pixels:.2e} px"
        );
    }
    for (path, bytes) in outputs {
        println!("{}: {} bytes", path.display(), bytes.len());
    }
    if outputs.is_empty() {
        println!("nothing was written: give --png, --ids, --depth or --used");
    }
}
