//! Frames to files: an animated GIF and a contact sheet.

use crate::still;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes the frames as an endless animation. All their colours must be in `palette`, of at most 256: nothing is
/// approximated.
pub(crate) fn write_gif(
    file: &Path,
    size: Size,
    frames: &[Vec<Rgb565>],
    palette: &[Rgb565],
) -> Result<(), Box<dyn Error>> {
    let (width, height) = (u16::try_from(size.width)?, u16::try_from(size.height)?);
    let colours: Vec<u8> = palette.iter().flat_map(|&c| rgb(c)).collect();
    let index: HashMap<u16, u8> = (0..=255).zip(palette).map(|(i, c)| (c.into_storage(), i)).collect();
    let mut out = BufWriter::new(File::create(file)?);
    {
        let mut encoder = gif::Encoder::new(&mut out, width, height, &colours)?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        for pixels in frames {
            let indexed = pixels
                .iter()
                .map(|c| index.get(&c.into_storage()).copied())
                .collect::<Option<Vec<u8>>>()
                .ok_or("a colour is missing in the palette")?;
            encoder.write_frame(&gif::Frame {
                width,
                height,
                buffer: Cow::Owned(indexed),
                delay: 6, // in 1/100 s
                ..gif::Frame::default()
            })?;
        }
    }
    Ok(out.flush()?)
}

/// Writes frames side by side, `columns` in a row.
pub(crate) fn write_contact_sheet(
    file: &Path,
    size: Size,
    frames: &[&Vec<Rgb565>],
    columns: usize,
) -> Result<(), Box<dyn Error>> {
    let (width, height) = (size.width as usize, size.height as usize);
    let rows = frames.len().div_ceil(columns);
    let mut sheet = vec![Rgb888::BLACK; columns * width * rows * height];
    for (place, frame) in frames.iter().enumerate() {
        for (y, row) in frame.chunks_exact(width).enumerate() {
            let start = (((place / columns) * height + y) * columns + place % columns) * width;
            for (pixel, &c) in sheet[start..].iter_mut().zip(row) {
                *pixel = c.into();
            }
        }
    }
    let size = Size::new(u32::try_from(columns * width)?, u32::try_from(rows * height)?);
    Ok(std::fs::write(file, still::png(size, &sheet)?)?)
}

fn rgb(colour: Rgb565) -> [u8; 3] {
    let c = Rgb888::from(colour);
    [c.r(), c.g(), c.b()]
}
