//! Turns the teapot once, half of the turn solid and half as a wireframe, and writes an animated GIF and a contact sheet:
//!
//! ```text
//! cargo run --release --example spin -- --help
//! ```
//!
//! Your own model: `cargo run --release -p pinhole-render -- MODEL.stl --gif turn.gif`.

mod scene;
mod terminal;

use clap::{value_parser, Command};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use pinhole::prelude::*;
use pinhole_apps_support::canvas::Canvas;
use pinhole_apps_support::command::{self, option};
use pinhole_apps_support::film;
use scene::Turntable;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use teapot::{EDGES, FACES, NORMALS, VERTICES};

const BACKGROUND: Rgb565 = Rgb565::new(1, 4, 5);
const CLAY: Rgb565 = Rgb565::new(31, 44, 14);
const WIRE: Rgb565 = Rgb565::new(14, 56, 31);
/// Ambient light, also for the inside; 256 is full.
const AMBIENT: u16 = 48;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, Box<dyn Error>> {
        let about =
            "Turns a teapot once, drawn as on a microcontroller, and writes an animated GIF and a contact sheet";
        let mut given = command::matches(
            Command::new("spin").about(about).args([
                option("size", "N", "Width and height of the picture in pixels, 16 to 2048", "240")
                    .value_parser(value_parser!(u32).range(16..=2048)),
                option("frames", "N", "Frames of the full turn, 2 to 720", "48")
                    .value_parser(value_parser!(u32).range(2..=720)),
                option("out", "DIR", "The folder for the pictures", "target/spin")
                    .value_parser(value_parser!(PathBuf)),
            ]),
        )?;
        let [size, frames] = ["size", "frames"].map(|name| given.remove_one(name).unwrap_or_default());
        film(Size::new_equal(size), frames, &given.remove_one::<PathBuf>("out").unwrap_or_default())?;
        Ok(ExitCode::SUCCESS)
    })
}

fn film(size: Size, frames: u32, out: &Path) -> Result<(), Box<dyn Error>> {
    let table = Turntable::new(size)?;

    command::folder(out)?;
    let (gif_file, sheet_file) = (out.join("spin.gif"), out.join("spin.png"));
    let mut gif = film::Gif::create(&gif_file, size, &palette())?;

    // All memory that drawing needs; firmware has smaller sizes.
    let mut painter = Box::new(Painter::<Rgb565, 65_536, 65_535>::new());
    let mut numberer = Box::new(Painter::<Rgb888, 65_536, 65_535>::new());
    let mut cache = vec![ScreenVertex::default(); VERTICES.len()];

    let (mut solid, mut wireframe) = (Sum::default(), Sum::default());
    let (mut misordered, mut worst, mut covered) = (0, 0, 0);
    let mut sheet = Vec::new();
    let mut preview = String::new();
    for frame in 0..frames {
        let mut canvas = Canvas::new(size, BACKGROUND);
        let model = Turntable::model(frame, frames);
        let instances = table.place(&model);
        let start = Instant::now();
        if frame < frames.div_ceil(2) {
            let light = Lambert::new(&model, Vector3::from_ints(-2, 3, 4), AMBIENT)?;
            let shade = |face: usize| match NORMALS.get(face) {
                Some(&normal) => CLAY.dim(light.level(normal)),
                None => CLAY.dim(AMBIENT), // the inside
            };
            let statistics = scene::paint(&mut painter, &instances, shade, &mut canvas)?;
            solid.add(statistics, start.elapsed());

            let (differing, of) = scene::misordered(&mut numberer, &instances, size)?;
            (misordered, worst, covered) = (misordered + differing, worst.max(differing), covered + of);
        } else {
            let statistics = instances[0].edges(|_| WIRE).cached(&mut cache).draw(&mut canvas)?;
            wireframe.add(statistics, start.elapsed());
        }
        gif.add(canvas.pixels())?;
        if frame == frames / 8 {
            preview = terminal::picture(canvas.pixels(), size, BACKGROUND);
        }
        if film::on_sheet(frame, frames, 12) {
            sheet.push(canvas);
        }
    }
    gif.finish()?;
    film::write_sheet(&sheet_file, size, &sheet)?;

    command::say(format_args!("{preview}{}\n{}", gif_file.display(), sheet_file.display()))?;
    command::say(format_args!(
        "{} vertices, {} faces, {} edges; {} x {} pixels",
        VERTICES.len(),
        FACES.len(),
        EDGES.len(),
        size.width,
        size.height
    ))?;
    command::say(format_args!("solid:     {solid}"))?;
    command::say(format_args!("wireframe: {wireframe}"))?;
    command::say(format_args!(
        "painter's order: {misordered} of {covered} pixels show another face than a depth buffer would; \
         {worst} in the worst frame"
    ))?;
    Ok(())
}

/// All colours of the frames.
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
