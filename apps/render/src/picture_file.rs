//! Pictures that scenes name: PNG and BMP files.

use std::path::Path;

/// The size and the pixels of a picture, row by row: red, green, blue and opacity.
pub(crate) type Pixels = ([usize; 2], Vec<[u8; 4]>);

/// Reads a picture of at most `longest` pixels a side. The error names the file.
pub(crate) fn read(path: &Path, longest: u32) -> Result<Pixels, String> {
    let named = |problem: String| format!("{}: {problem}", path.display());
    let file = std::fs::read(path).map_err(|e| named(format!("cannot be read: {e}")))?;
    let (size, pixels) = pinhole_import::read_picture(&file).map_err(named)?;
    let [width, height] = size;
    match width.max(height) > longest as usize {
        true => Err(named(format!(
            "has {width} x {height} pixels, and may have {longest} a side: make it smaller"
        ))),
        false => Ok((size, pixels)),
    }
}
