//! A turn of the model on the display, as a GIF file.

use crate::palette::Palette;
use embedded_graphics_core::geometry::Size;
use gif::{Encoder, EncodingError, Frame, Repeat};

/// Duration of a turn, in hundredths of a second.
const TURN: u32 = 400;

/// An endless film of frames, each of red, green, blue and opacity of its pixels. A frame of at most 256 colours has its own ones;
/// another one those that median cut chooses.
pub(crate) fn gif(
    size: Size,
    frames: u32,
    mut frame: impl FnMut(u32) -> Result<Vec<u8>, String>,
) -> Result<Vec<u8>, String> {
    let (width, height) = (size.width as u16, size.height as u16); // a display has sides of at most 1024 pixels
    let failed = |problem: EncodingError| problem.to_string();
    let mut file = Encoder::new(Vec::new(), width, height, &[]).map_err(failed)?;
    file.set_repeat(Repeat::Infinite).map_err(failed)?;
    // Frame times are rounded from the start of the film, so that any number of frames lasts one turn.
    let moment = |frame: u32| frame * TURN / frames.max(1);
    for number in 0..frames {
        let pixels = frame(number)?;
        let colors = || pixels.chunks_exact(4).filter_map(|pixel| pixel.first_chunk::<3>()).copied();
        let palette = Palette::of(colors());
        let frame = Frame {
            width,
            height,
            buffer: colors().map(|color| palette.index(color)).collect::<Vec<_>>().into(),
            palette: Some(palette.colours.as_flattened().to_vec()),
            delay: (moment(number + 1) - moment(number)) as u16, // at most a turn
            ..Frame::default()
        };
        file.write_frame(&frame).map_err(failed)?;
    }
    file.into_inner().map_err(|problem| problem.to_string())
}
