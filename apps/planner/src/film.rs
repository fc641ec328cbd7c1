//! A turn of the model on the display, as a GIF file that is made a frame at a time.

use crate::choice::Choice;
use crate::palette::{Counts, Palette};
use gif::{Encoder, EncodingError, Frame, Repeat};

/// Duration of a turn, in hundredths of a second.
const TURN: u32 = 400;

/// An endless film in the making.
pub(crate) struct Film {
    /// The choice of the first frame.
    pub(crate) choice: Choice,
    file: Encoder<Vec<u8>>,
    /// The number of all frames, and of those in the file.
    pub(crate) frames: u32,
    pub(crate) done: u32,
}

impl Film {
    pub(crate) fn new(choice: Choice, frames: u32) -> Result<Self, String> {
        let mut file = Encoder::new(Vec::new(), side(choice.size.width), side(choice.size.height), &[])
            .map_err(failed)?;
        file.set_repeat(Repeat::Infinite).map_err(failed)?;
        Ok(Self { choice, file, frames, done: 0 })
    }

    /// Adds the next frame, given as red, green, blue and opacity of its pixels. A frame of at most 256 colours keeps its
    /// colours; for any other one, median cut chooses 256.
    pub(crate) fn add(&mut self, pixels: &[u8]) -> Result<(), String> {
        let colors = || pixels.chunks_exact(4).filter_map(|pixel| pixel.first_chunk::<3>()).copied();
        let mut counts = Counts::default();
        counts.add(colors());
        let palette = Palette::of(counts);
        // Frame times are rounded from the start of the film, so that any number of frames lasts one turn.
        let moment = |frame: u32| frame * TURN / self.frames.max(1);
        let frame = Frame {
            width: side(self.choice.size.width),
            height: side(self.choice.size.height),
            buffer: colors().map(|color| palette.index(color)).collect::<Vec<_>>().into(),
            palette: Some(palette.colours.as_flattened().to_vec()),
            delay: (moment(self.done + 1) - moment(self.done)) as u16, // at most a turn
            ..Frame::default()
        };
        self.file.write_frame(&frame).map_err(failed)?;
        self.done += 1;
        Ok(())
    }

    /// The file.
    pub(crate) fn finish(self) -> Result<Vec<u8>, String> {
        self.file.into_inner().map_err(|problem| problem.to_string())
    }
}

/// A side of a display has at most 1024 pixels.
fn side(pixels: u32) -> u16 {
    pixels as u16
}

fn failed(problem: EncodingError) -> String {
    problem.to_string()
}
