//! Pictures that scenes name: PNG and BMP files.

use image::ImageDecoder;
use std::fmt::Display;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The size and the pixels of a picture, row by row: red, green, blue and opacity.
pub(crate) type Pixels = ([usize; 2], Vec<[u8; 4]>);

/// Reads a picture of at most `longest` pixels a side. The error names the file.
pub(crate) fn read(path: &Path, longest: u32) -> Result<Pixels, String> {
    let unreadable = |e: &dyn Display| format!("{}: cannot be read: {e}", path.display());
    let file = File::open(path).map_err(|e| unreadable(&e))?;
    // By its first bytes, not by its name.
    let reader = image::ImageReader::new(BufReader::new(file));
    let reader = reader.with_guessed_format().map_err(|e| unreadable(&e))?;
    if !matches!(reader.format(), Some(image::ImageFormat::Png | image::ImageFormat::Bmp)) {
        return Err(format!("{}: is neither PNG nor BMP: convert it", path.display()));
    }
    let decoder = reader.into_decoder().map_err(|e| unreadable(&e))?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > longest {
        return Err(format!(
            "{}: has {width} x {height} pixels, and may have {longest} a side: make it smaller",
            path.display()
        ));
    }
    let picture = image::DynamicImage::from_decoder(decoder).map_err(|e| unreadable(&e))?;
    let pixels = picture.to_rgba8().pixels().map(|pixel| pixel.0).collect();
    Ok(([width as usize, height as usize], pixels))
}
