//! An endless animation as a GIF file.

use embedded_graphics::geometry::Size;
use gif::EncodingError;
use std::error::Error;
use std::io::Write;

/// A GIF file in the making.
pub struct Animation<W: Write> {
    encoder: gif::Encoder<W>,
    width: u16,
    height: u16,
}

impl<W: Write> Animation<W> {
    /// Begins a file whose frames take their colours from a palette of at most 256.
    ///
    /// # Errors
    ///
    /// The picture has a side above 65535 pixels, or `file` cannot be written.
    pub fn new(file: W, size: Size, palette: &[[u8; 3]]) -> Result<Self, Box<dyn Error>> {
        let (width, height) = (u16::try_from(size.width)?, u16::try_from(size.height)?);
        let mut encoder = gif::Encoder::new(file, width, height, palette.as_flattened())?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        Ok(Self { encoder, width, height })
    }

    /// Adds a frame, shown for `delay` hundredths of a second. `pixels` holds palette indices, row by row.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub fn add(&mut self, pixels: Vec<u8>, delay: u16) -> Result<(), EncodingError> {
        let (width, height) = (self.width, self.height);
        self.encoder.write_frame(&gif::Frame {
            width,
            height,
            buffer: pixels.into(),
            delay,
            ..gif::Frame::default()
        })
    }

    /// Completes the file.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub fn finish(self) -> Result<W, EncodingError> {
        self.encoder.into_inner()
    }
}
