//! Turns a mesh once round, half of the turn solid and half of it as a wireframe, and writes an animated GIF and a
//! contact sheet:
//!
//! ```text
//! cargo run --release --example spin -- --help
//! ```

#[path = "../common/canvas.rs"]
mod canvas;
mod depth;
#[path = "../common/film.rs"]
mod film;
mod scene;
#[path = "../common/still.rs"]
mod still;
mod terminal;

use canvas::Canvas;
use clap::Parser;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use indicatif::{ProgressBar, ProgressStyle};
use pinhole::{Corner, Dim, Lambert, Painter, Statistics, Vector3};
use pinhole_import::ImportedMesh;
use scene::Turntable;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

const BACKGROUND: Rgb565 = Rgb565::new(1, 4, 5);
const CLAY: Rgb565 = Rgb565::new(31, 44, 14);
const WIRE: Rgb565 = Rgb565::new(14, 56, 31);

/// Turn a mesh once round: an animated GIF and a contact sheet, drawn as on a microcontroller
#[derive(Parser)]
struct Arguments {
    /// The mesh to turn (default: the teapot)
    #[arg(long, value_name = "FILE.obj")]
    mesh: Option<PathBuf>,
    /// Width and height of the picture in pixels, 16 to 2048
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u32).range(16..=2048))]
    size: u32,
    /// Frames of the full turn, 2 to 720
    #[arg(long, value_name = "N", default_value_t = 48, value_parser = clap::value_parser!(u32).range(2..=720))]
    frames: u32,
    /// Folder for the pictures
    #[arg(long, value_name = "DIR", default_value = "target/spin")]
    out: PathBuf,
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(help) if help.exit_code() == 0 => help.exit(),
        Err(error) => return refuse(error.to_string().lines().next().unwrap_or_default()),
    };
    let teapot = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/teapot.obj");
    let mesh = match pinhole_import::read(arguments.mesh.as_ref().unwrap_or(&teapot)) {
        Ok(mesh) => mesh,
        Err(error) => return refuse(&error.to_string()),
    };
    match film(&mesh, &arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => refuse(&error.to_string()),
    }
}

/// One line that says what is wrong with what the user gave.
fn refuse(problem: &str) -> ExitCode {
    eprintln!("{problem}");
    ExitCode::from(2)
}

fn film(mesh: &ImportedMesh, arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let (size, frames) = (Size::new_equal(arguments.size), arguments.frames);
    let out = &arguments.out;
    let unwritable = |e: std::io::Error| format!("{}: cannot be written: {e}", out.display());
    std::fs::create_dir_all(out).map_err(unwritable)?;
    let table = Turntable::new(mesh, size)?;

    // All the memory that drawing needs; a firmware would put its own, smaller sizes here.
    let mut painter = Box::new(Painter::<Rgb565, 65_536, 65_535>::new());
    let mut numberer = Box::new(Painter::<Rgb888, 65_536, 65_535>::new());
    let mut corners = vec![Corner::default(); mesh.vertices.len()];

    let mut solid = Sum::default();
    let mut wireframe = Sum::default();
    let mut misordered = Misordered::default();
    let mut pictures = Vec::new();
    let bar = ProgressBar::new(frames.into())
        .with_style(ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left")?);
    for frame in 0..frames {
        let mut canvas = Canvas::new(size, BACKGROUND);
        let model = Turntable::model(frame, frames);
        let placed = table.place(&model);
        let start = Instant::now();
        if frame < frames.div_ceil(2) {
            let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), 48)?;
            let shade = |face: usize| CLAY.dim(light.level(mesh.normals[face]));
            painter.add(&placed, shade)?;
            solid.add(painter.draw(&mut canvas)?, start.elapsed());

            let mut numbers = Canvas::new(size, depth::face_colour(depth::NOTHING as usize));
            numberer.add(&placed, depth::face_colour)?;
            numberer.draw(&mut numbers)?;
            misordered.add(&numbers, depth::nearest_faces(&placed, size));
        } else {
            let statistics = placed.wireframe(WIRE, &mut corners, &mut canvas)?;
            wireframe.add(statistics, start.elapsed());
        }
        pictures.push(canvas.pixels().to_vec());
        bar.inc(1);
    }
    bar.finish_and_clear();

    let (gif, sheet) = (out.join("spin.gif"), out.join("contact-sheet.png"));
    film::write_gif(&gif, size, &pictures, &palette())?;
    let shown = pictures.len().min(12);
    let sample: Vec<_> = (0..shown).map(|i| &pictures[i * pictures.len() / shown]).collect();
    film::write_contact_sheet(&sheet, size, &sample, 4.min(shown))?;

    print!("{}", terminal::picture(&pictures[pictures.len() / 8], size, 72));
    println!("{}", gif.display());
    println!("{}", sheet.display());
    println!(
        "{} vertices, {} faces, {} edges; {size} pixels",
        mesh.vertices.len(),
        mesh.faces.len(),
        mesh.edges.len(),
    );
    println!("solid:     {solid}");
    println!("wireframe: {wireframe}");
    println!("painter's order: {misordered}");
    Ok(())
}

/// Every colour that a frame can have.
fn palette() -> Vec<Rgb565> {
    let mut palette = vec![BACKGROUND, WIRE];
    palette.extend((0..=256).map(|level| CLAY.dim(level)));
    palette.sort_unstable_by_key(|c| c.into_storage());
    palette.dedup();
    palette
}

/// Statistics of several frames.
#[derive(Default)]
struct Sum {
    frames: u32,
    total: Statistics,
    time: Duration,
}

impl Sum {
    fn add(&mut self, frame: Statistics, time: Duration) {
        self.frames += 1;
        self.total = self.total.and(frame);
        self.time += time;
    }
}

impl std::fmt::Display for Sum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Statistics { drawn, culled, clipped, outside, degenerate } = self.total;
        write!(
            f,
            "{} frames, {drawn} drawn, {culled} culled, {clipped} clipped, {outside} outside, \
             {degenerate} degenerate; {:.2} ms a frame here",
            self.frames,
            self.time.as_secs_f64() * 1e3 / f64::from(self.frames.max(1)),
        )
    }
}

/// Pixels in which painter's order shows another face than a depth buffer.
#[derive(Default)]
struct Misordered {
    pixels: usize,
    worst: usize,
    of: usize,
}

impl Misordered {
    fn add(&mut self, painted: &Canvas<Rgb888>, nearest: Option<Vec<u32>>) {
        let Some(nearest) = nearest else { return };
        let count = depth::differing(painted, &nearest);
        self.pixels += count;
        self.worst = self.worst.max(count);
        self.of += nearest.iter().filter(|&&face| face != depth::NOTHING).count();
    }
}

impl std::fmt::Display for Misordered {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} of {} pixels show another face than a depth buffer would; {} in the worst frame",
            self.pixels, self.of, self.worst,
        )
    }
}
