//! An endless animation as a GIF file.

use gif::EncodingError;
use std::io::Write;

/// Duration of a turn of a model, in hundredths of a second.
const TURN: u32 = 400;

/// How long frame `frame` of `frames` stays, in hundredths of a second. Moments are rounded from the start of the film, so that any
/// number of frames lasts one turn.
pub fn delay(frame: u32, frames: u32) -> u16 {
    let moment = |frame: u32| frame * TURN / frames.max(1);
    (moment(frame + 1) - moment(frame)) as u16 // at most a turn
}

/// A GIF file in the making.
pub struct Animation<W: Write> {
    encoder: gif::Encoder<W>,
    width: u16,
    height: u16,
}

impl<W: Write> Animation<W> {
    /// Begins a file with this width and height, whose frames take their colours from a palette of at most 256, or bring their own.
    /// Fails if `file` cannot be written.
    pub fn new(file: W, [width, height]: [u16; 2], palette: &[[u8; 3]]) -> Result<Self, EncodingError> {
        let mut encoder = gif::Encoder::new(file, width, height, palette.as_flattened())?;
        encoder.set_repeat(gif::Repeat::Infinite)?;
        Ok(Self { encoder, width, height })
    }

    /// Adds a frame, shown for `delay` hundredths of a second. `pixels` holds indices, row by row, into the palette of the file, or
    /// into the frame's own. Fails if the file cannot be written.
    pub fn add(&mut self, pixels: Vec<u8>, own: Option<&[[u8; 3]]>, delay: u16) -> Result<(), EncodingError> {
        let (width, height) = (self.width, self.height);
        let palette = own.map(|palette| palette.as_flattened().to_vec());
        let frame =
            gif::Frame { width, height, buffer: pixels.into(), palette, delay, ..gif::Frame::default() };
        self.encoder.write_frame(&frame)
    }

    /// Completes the file. Fails if the file cannot be written.
    pub fn finish(self) -> Result<W, EncodingError> {
        self.encoder.into_inner()
    }
}
