//! The pictures of the crate's documentation, as data URLs: docs.rs shows no file of the repository. Colours are rounded to 6 levels
//! a channel, so that all pictures together take less than 30 KB.

use base64::prelude::*;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;
use pinhole_apps_support::{still, testing};
use std::error::Error;
use std::fmt::Write;

/// The folder of the book's cookbook, all of whose pictures are shown.
const COOKBOOK: &str = "docs/cookbook";

pub(crate) fn definitions() -> Result<String, String> {
    let folder = std::fs::read_dir(super::root().join(COOKBOOK));
    let entries = folder.map_err(|e| format!("{COOKBOOK}: cannot be read: {e}"))?;
    let names = entries.flatten().map(|entry| format!("{COOKBOOK}/{}", entry.file_name().to_string_lossy()));
    let mut paths: Vec<String> = names.chain(["docs/part.png".to_string()]).collect();
    paths.sort();
    let mut text = String::new();
    for path in paths {
        let small = small(&path).map_err(|e| format!("{path}: {e}"))?;
        let _ = writeln!(text, "[{path}]: data:image/png;base64,{}", BASE64_STANDARD.encode(&small));
    }
    text.push('\n');
    Ok(text)
}

/// A PNG file of fewer colours.
fn small(path: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let ([width, height], colors) = testing::picture(&super::root().join(path));
    let level = |byte: u8| ((u16::from(byte) * 5 + 127) / 255 * 51) as u8;
    let pixels: Vec<Rgb888> =
        colors.iter().map(|color| color.map(level)).map(|[r, g, b]| Rgb888::new(r, g, b)).collect();
    still::png(Size::new(width as u32, height as u32), &pixels)
}
