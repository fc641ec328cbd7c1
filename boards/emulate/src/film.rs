//! What the display of an emulated board showed, as a GIF file.

use crate::boards::Display;
use crate::watch::Frame;
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use pinhole_apps_support::animation::Animation;
use pinhole_apps_support::files;
use pinhole_apps_support::palette::{Counts, Palette};
use std::path::Path;

/// Writes the pictures of frames at the mean rate of the frames: at an uneven one the file would depend on the compiler.
pub(crate) fn write(
    file: &Path,
    display: &Display,
    frames: &[Frame],
    pictures: &[Vec<u32>],
) -> Result<(), String> {
    let pictures: Vec<Vec<_>> = pictures.iter().map(|pixels| pixels.iter().map(color).collect()).collect();
    let mut counts = Counts::default();
    for picture in &pictures {
        counts.add(picture.iter().copied());
    }
    let palette = Palette::of(counts);
    let mut animation = Animation::new(Vec::new(), [display.width, display.height], &palette.colours)
        .map_err(|error| refused(file, &error))?;
    let time = frames.last().zip(frames.first()).map_or(0, |(last, first)| last.time - first.time);
    let steps = frames.len().saturating_sub(1).max(1) as u64;
    let delay = (time + 5_000_000 * steps) / (10_000_000 * steps); // in hundredths of a second, below PATIENCE
    for picture in &pictures {
        let pixels = picture.iter().map(|&color| palette.index(color)).collect();
        animation.add(pixels, None, delay as u16).map_err(|error| refused(file, &error))?;
    }
    files::write(&[(file, animation.finish().map_err(|error| refused(file, &error))?)])
}

fn refused(file: &Path, error: &dyn std::error::Error) -> String {
    format!("{}: {error}", file.display())
}

/// The colour of a pixel in the display's memory, of 16 bits on all emulated boards.
fn color(pixel: &u32) -> [u8; 3] {
    let color = Rgb888::from(Rgb565::from(RawU16::new(*pixel as u16)));
    [color.r(), color.g(), color.b()]
}
