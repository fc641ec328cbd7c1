//! An endless animation as a GIF file.

use embedded_graphics::geometry::Size;
use gif::EncodingError;
use std::error::Error;
use std::io::Write;

pub(crate) struct Animation<W: Write> {
    encoder: gif::Encoder<W>,
    width: u16,
    height: u16,
}

impl<W: Write> Animation<W> {
    /// Begins a file whose frames take their colours from a palette of at most 256.
    pub(crate) fn new(file: W, size: Size, palette: &[[u8; 3]]) -> Result<Self, Box<dyn Error>> {
        let (width, height) = (u16::try_from(size.width)?, u16::try_from(size.height)?);
        let mut encoder = gif::Encoder::new(file, width, height, palette.as_flattened())?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        Ok(Self { encoder, width, height })
    }

    /// A frame that stays for `delay` hundredths of a second: for each pixel, row by row, the place of its colour in
    /// the palette.
    pub(crate) fn add(&mut self, pixels: Vec<u8>, delay: u16) -> Result<(), EncodingError> {
        let (width, height) = (self.width, self.height);
        self.encoder.write_frame(&gif::Frame {
            width,
            height,
            buffer: pixels.into(),
            delay,
            ..gif::Frame::default()
        })
    }

    /// The file, complete.
    pub(crate) fn finish(self) -> Result<W, EncodingError> {
        self.encoder.into_inner()
    }
}
