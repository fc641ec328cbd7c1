//! The simulator without its window: a [`State`] that keys and mouse change, a [`Viewer`] that draws it, and a [`Placement`] of its
//! pixels in a window of any size. `main.rs` has the command line, `window.rs` the window; everything else is tested without it.
//!
//! A model is drawn by the code of `pinhole-render`, but as firmware draws: in bands, and only
//! where a frame differs from the last one.

mod frame;
mod overlay;
mod placement;
mod source;
mod state;
mod watch;

pub use frame::{Shown, Viewer};
pub use placement::Placement;
pub use source::Source;
pub use state::{Action, State};

use pinhole_apps_support::{files, still};

/// Writes a picture as a PNG file, completely or not at all. The error names the file.
pub fn write_png(
    file: &std::path::Path,
    size: embedded_graphics::geometry::Size,
    pixels: &[embedded_graphics::pixelcolor::Rgb888],
) -> Result<(), String> {
    let png = still::png(size, pixels).map_err(|e| e.to_string())?;
    files::write(&[(file, png)])
}
