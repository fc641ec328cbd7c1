//! Pictures as firmware made from a template draws them: the build script and the drawing code of `boards/any-cortex-m` are
//! compiled here, too.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use pinhole::{Angle, Frame, Mesh, ScreenVertex, Statistics};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::Options;

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

/// Draws a frame, the mesh turned by an angle, into any target in 16-bit colour. The first frame of the firmware is at angle 0.
///
/// # Errors
///
/// What the firmware would log before it stops.
pub fn draw<D: DrawTarget<Color = Rgb565>>(
    mesh: &Mesh<'_>,
    turn: Angle,
    display: &mut D,
) -> Result<Statistics, &'static str> {
    let screen = display.bounding_box();
    let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
    let mut bins = vec![0; mesh.face_bins_len()];
    let mut strip = vec![0; Frame::<Rgb565>::strip_bytes(screen.size.width, ROWS)];
    let mut depths = vec![0; (screen.size.width * ROWS) as usize];
    let mut memory = picture::Memory::new(&mut cache, &mut bins, &mut strip, &mut depths);
    let camera = picture::camera(mesh, screen)?;
    picture::draw(mesh, &camera, turn, &mut memory, display)
}

/// The first frame on a display of a size.
///
/// # Errors
///
/// As [`draw`].
pub fn first_frame(mesh: &Mesh<'_>, size: Size) -> Result<(Canvas<Rgb565>, Statistics), &'static str> {
    let mut canvas = Canvas::new(size, Rgb565::MAGENTA);
    let statistics = draw(mesh, Angle::ZERO, &mut canvas)?;
    Ok((canvas, statistics))
}
