//! Pictures as firmware made from a template draws them: the build script and the drawing code of `boards/any-cortex-m` are
//! compiled here, too.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use pinhole::{Angle, Frame, ScreenVertex, Statistics};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{ImportedMesh, Options};

#[allow(unreachable_pub)] // as a file of its own it is right
#[path = "../../../boards/any-cortex-m/src/picture.rs"]
mod picture;
#[allow(dead_code, unreachable_pub)] // its `main` is for cargo
#[path = "../../../boards/any-cortex-m/build.rs"]
mod script;

/// Rows of a band. Any number gives the same pixels.
const ROWS: u32 = 8;

/// The display for which the template is written.
pub const SIZE: Size = Size::new(240, 240);

/// What the template's build script asks of the importer, with the axis, the winding and the sides that were asked for here.
pub fn options(given: &Options) -> Options {
    let Options { up, flip, fix_winding, two_sided, .. } = *given;
    Options { up, flip, fix_winding, two_sided, ..script::options() }
}

/// Draws a frame, the model turned by an angle, into any target in 16-bit colour. The first frame of the firmware is at angle 0.
///
/// # Errors
///
/// What the firmware would log before it stops.
pub fn draw<D: DrawTarget<Color = Rgb565>>(
    model: &ImportedMesh,
    turn: Angle,
    display: &mut D,
) -> Result<Statistics, String> {
    let mesh = model.mesh().map_err(|e| e.to_string())?;
    let colors = model.colors().map_err(|e| e.to_string())?;
    let screen = display.bounding_box();
    let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
    let mut bins = vec![0; mesh.face_bins_len()];
    let mut strip = vec![0; Frame::<Rgb565>::strip_bytes(screen.size.width, ROWS)];
    let mut depths = vec![0; (screen.size.width * ROWS) as usize];
    let mut memory = picture::Memory::new(&mut cache, &mut bins, &mut strip, &mut depths);
    let camera = picture::camera(&mesh, screen)?;
    let color = |face: usize| colors.map_or(picture::COLOR, |colors| colors.color(face));
    Ok(picture::draw(&mesh, color, &camera, turn, &mut memory, display)?)
}

/// The frame at an angle, on a display of a size.
///
/// # Errors
///
/// As [`draw`].
pub fn frame(model: &ImportedMesh, turn: Angle, size: Size) -> Result<(Canvas<Rgb565>, Statistics), String> {
    let mut canvas = Canvas::new(size, Rgb565::MAGENTA);
    let statistics = draw(model, turn, &mut canvas)?;
    Ok((canvas, statistics))
}
