//! A film of a mesh that turns once, as a GIF.

use crate::model::{self, Fit, Look};
use crate::paint::Subject;
use crate::picture::{picture, Format};
use crate::quantised::Quantised;
use crate::scene::{Colors, Scene};
use crate::style::Style;
use crate::texture::SceneTexture;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use indicatif::{ProgressBar, ProgressStyle};
use pinhole_apps_support::animation::{delay, Animation};
use pinhole_apps_support::files;
use pinhole_apps_support::palette::{Counts, Palette};
use pinhole_import::Triangles;
use std::error::Error;
use std::io::Write;
use std::path::Path;

/// Writes the film of a mesh to `file`, whose name is `path`.
pub(crate) fn gif(
    (mesh, colors, texture): (&Triangles, &Colors, Option<&SceneTexture>),
    look: &Look,
    style: &Style,
    format: Format,
    least_turn: Option<f64>,
    frames: u32,
    (path, file): (&Path, &mut dyn Write),
) -> Result<(), String> {
    let mut subject = None;
    film(Size::new(look.width, look.height), frames, (path, file), |frame| {
        // The camera moves left, so that the mesh appears to turn right.
        let yaw = look.yaw - 360.0 * f64::from(frame) / f64::from(frames);
        // A sphere has one size from all sides; an outline must fit from all sides.
        let fit = if look.fit == Fit::Outline { Fit::Turn } else { look.fit };
        let look = Look { yaw, fit, ..*look };
        let scene = model::scene(mesh.clone(), colors.clone(), &look)?;
        let (quantised, used) = Quantised::settle(&Scene { texture: texture.cloned(), ..scene })?;
        let subject = subject.get_or_insert_with(|| Subject::with_edges(&used, style, least_turn));
        Ok(picture(subject, (&used, &quantised), style, format)?.0)
    })
}

/// Writes a film of pictures, which lasts one turn. Each picture is drawn twice, for the palette of all and for the file, so
/// that only one is in memory at a time.
pub(crate) fn film(
    size: Size,
    frames: u32,
    (path, file): (&Path, &mut dyn Write),
    mut picture: impl FnMut(u32) -> Result<Vec<Rgb888>, String>,
) -> Result<(), String> {
    let bar = bar(2 * frames);
    let mut counts = Counts::default();
    for frame in 0..frames {
        counts.add(picture(frame)?.iter().map(channels));
        bar.inc(1);
    }
    let palette = Palette::of(counts);
    let unwritable = |e: Box<dyn Error>| files::unwritable(path, e);
    let side = |side: u32| u16::try_from(side).map_err(|e| unwritable(e.into()));
    let sides = [side(size.width)?, side(size.height)?];
    let mut film = Animation::new(file, sides, &palette.colours).map_err(|e| unwritable(e.into()))?;
    for frame in 0..frames {
        let delay = delay(frame, frames).max(2); // players take less for 10
        let pixels = picture(frame)?.iter().map(|colour| palette.index(channels(colour))).collect();
        film.add(pixels, None, delay).map_err(|e| unwritable(e.into()))?;
        bar.inc(1);
    }
    film.finish().map_err(|e| unwritable(e.into()))?;
    bar.finish_and_clear();
    Ok(())
}

/// On standard error; where that is no terminal it shows nothing.
fn bar(steps: u32) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} pictures, {eta} left");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(steps.into()).with_style(style)
}

fn channels(colour: &Rgb888) -> [u8; 3] {
    [colour.r(), colour.g(), colour.b()]
}
