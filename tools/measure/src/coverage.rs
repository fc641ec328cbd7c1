//! The rasteriser alone: draws triangles and lines from a JSON file and counts how often each pixel is drawn.

use crate::bridge::{line_spans, triangle_spans};
use crate::oracle::coverage::Area;
use clap::{value_parser, Arg, ArgMatches, Command};
use pinhole::raster::Span;
use pinhole_apps_support::{command, files};
use pinhole_render::json::{self, Whole};
use serde::Deserialize;
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

/// A coordinate of a triangle.
type Subpixels = Whole<-2_097_152, 2_097_152>;
/// A coordinate of a line: inside the range that `draw_line` does not clamp.
type Pixels = Whole<-32_767, 32_767>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    width: Whole<1, 4096>,
    height: Whole<1, 4096>,
    #[serde(default)]
    triangles: Vec<[Subpixels; 6]>,
    #[serde(default)]
    lines: Vec<[Pixels; 4]>,
}

pub(crate) fn command() -> Command {
    let path = |name, help| Arg::new(name).required(true).help(help).value_parser(value_parser!(PathBuf));
    Command::new("coverage")
        .about("Rasterises triangles and lines, and counts how often each pixel is drawn")
        .arg(path("IN.json", "The triangles and lines to draw"))
        .arg(path("OUT", "The file for the counts"))
        .after_help(FORMATS)
}

pub(crate) fn run(mut given: ArgMatches) -> Result<ExitCode, String> {
    let mut path = |name| given.remove_one::<PathBuf>(name).unwrap_or_default();
    draw(&path("IN.json"), &path("OUT")).map(|()| ExitCode::SUCCESS)
}

fn draw(from: &Path, to: &Path) -> Result<(), String> {
    files::apart(from, [to])?;
    let Input { width, height, triangles, lines } = json::read(from)?;
    let (width, height) = (width.0 as usize, height.0 as usize); // at most 4096
    let area = Area::new(0, 0, width as i64, height as i64);
    // How often each pixel was drawn, as the differences between neighbouring pixels, row by row, and one more for what ends with the
    // last row: a span then costs two additions a row, however wide it is.
    let mut counts = vec![0u32; width * height + 1];
    let point = |x: i32, y: i32| (i64::from(x), i64::from(y));
    for [x0, y0, x1, y1, x2, y2] in &triangles {
        let corners = [point(x0.0, y0.0), point(x1.0, y1.0), point(x2.0, y2.0)];
        triangle_spans(corners, area).into_iter().for_each(|span| add(&mut counts, width, span));
    }
    for [x0, y0, x1, y1] in &lines {
        let spans = line_spans(point(x0.0, y0.0), point(x1.0, y1.0), area);
        spans.into_iter().for_each(|span| add(&mut counts, width, span));
    }
    counts.pop();
    let mut sum = 0u32; // a file cannot hold enough triangles and lines for a count to pass 32 bits
    for count in &mut counts {
        sum = sum.wrapping_add(*count);
        *count = sum;
    }
    let bytes: Vec<u8> = counts.iter().flat_map(|count| count.to_le_bytes()).collect();
    files::write(&[(to, bytes)])?;
    command::say(format_args!(
        "{}: {width} x {height} pixels, {} triangles, {} lines; {} pixels drawn, each at most {} times",
        to.display(),
        triangles.len(),
        lines.len(),
        counts.iter().filter(|&&count| count > 0).count(),
        counts.iter().max().unwrap_or(&0),
    ))
}

/// Panics if the span leaves the picture: the rasteriser keeps to its scissor.
fn add(differences: &mut [u32], stride: usize, span: Span) {
    let Span { x, y, width, height } = span;
    assert!(x >= 0 && y >= 0 && width >= 1 && height >= 1, "{span:?}");
    let (x, y, width, height) = (x as usize, y as usize, width as usize, height as usize);
    assert!(x + width <= stride && (y + height) * stride < differences.len(), "{span:?}");
    for start in (y..y + height).map(|row| row * stride + x) {
        differences[start] = differences[start].wrapping_add(1);
        differences[start + width] = differences[start + width].wrapping_sub(1);
    }
}
