//! The simulator without its window: a [`State`] that keys and mouse change, and a [`Viewer`] that draws it. `main.rs` has
//! the window, which needs SDL; everything else is tested without it.
//!
//! A model is drawn by the code of `pinhole-render`, but as firmware draws: in bands, and only
//! where a frame differs from the last one. The scenes of the firmware examples are included.

mod firmware;
mod frame;
mod overlay;
mod source;
mod state;

pub use frame::{Shown, Viewer};
pub use source::Source;
pub use state::{Action, State};

use pinhole_apps_support::{files, still};

/// Writes a picture as a PNG file, completely or not at all.
///
/// # Errors
///
/// A message that names the file.
pub fn write_png(
    file: &std::path::Path,
    size: embedded_graphics::geometry::Size,
    pixels: &[embedded_graphics::pixelcolor::Rgb888],
) -> Result<(), String> {
    let png = still::png(size, pixels).map_err(|e| e.to_string())?;
    files::write(&[(file, png)])
}
