//! The simulator without its window: what keys and mouse do to a [`State`], and what a [`Viewer`] shows of it. The window
//! is in `window.rs`, an example that needs SDL; all the rest is tested without.
//!
//! A model is drawn by the code of `pinhole-render`, but as firmware draws: in bands, and only
//! where a frame differs from the last one. The scenes of the firmware examples are there, too.

mod firmware;
mod frame;
mod overlay;
mod source;
mod state;

pub use frame::{Shown, Viewer};
pub use source::Source;
pub use state::{Action, State};

use pinhole_apps_support::{files, still};

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
