//! A turn of the model on the display, as a GIF file that is made a frame at a time.

use crate::choice::Choice;
use crate::palette::{Counts, Palette};
use crate::refused;
use pinhole_apps_support::animation::{delay, Animation};

/// An endless film in the making.
pub(crate) struct Film {
    /// The choice of the first frame.
    pub(crate) choice: Choice,
    file: Animation<Vec<u8>>,
    /// The number of all frames, and of those in the file.
    pub(crate) frames: u32,
    pub(crate) done: u32,
}

impl Film {
    pub(crate) fn new(choice: Choice, frames: u32) -> Result<Self, String> {
        let size = [choice.size.width, choice.size.height].map(|side| side as u16); // at most 1024
        let file = Animation::new(Vec::new(), size, &[]).map_err(refused::film)?;
        Ok(Self { choice, file, frames, done: 0 })
    }

    /// Adds the next frame, given as red, green, blue and opacity of its pixels. A frame of at most 256 colours keeps its
    /// colours; for any other one, median cut chooses 256.
    pub(crate) fn add(&mut self, pixels: &[u8]) -> Result<(), String> {
        let colors = || pixels.chunks_exact(4).filter_map(|pixel| pixel.first_chunk::<3>()).copied();
        let mut counts = Counts::default();
        counts.add(colors());
        let palette = Palette::of(counts);
        let indices = colors().map(|color| palette.index(color)).collect();
        let delay = delay(self.done, self.frames);
        self.file.add(indices, Some(&palette.colours), delay).map_err(refused::film)?;
        self.done += 1;
        Ok(())
    }

    /// The file.
    pub(crate) fn finish(self) -> Result<Vec<u8>, String> {
        self.file.finish().map_err(refused::film)
    }
}
