//! The simulator without its window: what keys and mouse do to a [`State`], and what a [`Viewer`] shows of it. The window
//! is in `window.rs`, an example that needs SDL; all the rest is tested without.
//!
//! A model is drawn as `examples/render` draws it, through the same code, but as firmware does: in bands, and only
//! where a frame differs from the last one. The scenes of the firmware examples are there, too.

// What the tools share.
#[path = "../common/canvas.rs"]
mod canvas;
#[path = "../common/files.rs"]
mod files;
#[path = "../common/json.rs"]
mod json;
#[path = "../render/light.rs"]
mod light;
#[path = "../render/model.rs"]
mod model;
#[path = "../render/normals.rs"]
mod normals;
#[path = "../render/paint.rs"]
mod paint;
#[path = "../render/parts.rs"]
mod parts;
#[path = "../render/picture.rs"]
#[allow(dead_code)] // here bands are sent, and no picture is kept
mod picture;
#[path = "../render/projections.rs"]
mod projections;
#[path = "../render/quantised.rs"]
#[allow(dead_code)] // `render --stats`
mod quantised;
#[path = "../render/scene.rs"]
#[allow(dead_code)] // the same
mod scene;
#[path = "../common/still.rs"]
mod still;
#[path = "../render/style.rs"]
mod style;

mod firmware;
mod frame;
mod overlay;
mod source;
mod state;

pub use frame::{Shown, Viewer};
pub use source::Source;
pub use state::{Action, State};

/// Writes a picture as a PNG file, whole or not at all.
///
/// # Errors
///
/// A line that names the file.
pub fn write_png(
    file: &std::path::Path,
    size: embedded_graphics::geometry::Size,
    pixels: &[embedded_graphics::pixelcolor::Rgb888],
) -> Result<(), String> {
    let png = still::png(size, pixels).map_err(|e| e.to_string())?;
    files::write(&[(file, png)])
}
