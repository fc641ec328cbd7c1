//! The rasteriser alone: draws triangles and lines from a JSON file and counts how often each pixel is drawn.
//!
//! ```text
//! cargo run --release -p pinhole-coverage -- IN.json OUT
//! ```

mod input;
mod picture;

use clap::{value_parser, Arg, Command};
use input::Input;
use picture::Picture;
use pinhole_apps_support::{command, files};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const FORMATS: &str = r#"IN.json ("triangles" and "lines" are optional):
  {"width": W, "height": H,                          pixels, 1 to 4096
   "triangles": [[x0, y0, x1, y1, x2, y2], ...],     in 1/256 pixel, from -2097152 to 2097152
   "lines": [[x0, y0, x1, y1], ...]}                 in whole pixels, from -32767 to 32767
All numbers are integers; 8.0 is one. x runs right, y down; pixel (i, j) has its centre
at (256 i + 128, 256 j + 128).

OUT: for each pixel, row by row from the top, a little-endian u32: how many triangles and lines drew it.

Bad input: one line on stderr, exit code 2, and OUT is not changed."#;

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        let path = |name, help| Arg::new(name).required(true).help(help).value_parser(value_parser!(PathBuf));
        let mut given = command::matches(
            Command::new("coverage")
                .about("Rasterises triangles and lines, and counts how often each pixel is drawn")
                .arg(path("IN.json", "The triangles and lines to draw"))
                .arg(path("OUT", "The file for the counts"))
                .after_help(FORMATS),
        )?;
        let mut path = |name| given.remove_one::<PathBuf>(name).unwrap_or_default();
        run(&path("IN.json"), &path("OUT"))?;
        Ok(ExitCode::SUCCESS)
    })
}

fn run(from: &Path, to: &Path) -> Result<(), String> {
    files::apart(from, [to])?;
    let text = fs::read(from).map_err(|e| format!("{}: cannot be read: {e}", from.display()))?;
    let input = Input::parse(&text).map_err(|e| format!("{}: {e}", from.display()))?;
    drop(text);
    let mut picture = Picture::new(input.width, input.height);
    for &triangle in &input.triangles {
        picture.triangle(triangle);
    }
    for &line in &input.lines {
        picture.line(line);
    }
    let counts = picture.counts();
    let bytes: Vec<u8> = counts.iter().flat_map(|count| count.to_le_bytes()).collect();
    files::write(&[(to, bytes)])?;
    command::say(format_args!(
        "{}: {} x {} pixels, {} triangles, {} lines; {} pixels drawn, each at most {} times",
        to.display(),
        input.width,
        input.height,
        input.triangles.len(),
        input.lines.len(),
        counts.iter().filter(|&&count| count > 0).count(),
        counts.iter().max().unwrap_or(&0),
    ))
}
