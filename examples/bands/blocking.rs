//! The simplest loop: draw a band, send it, draw the next band into the same strip.

use crate::display::Display;
use crate::scene::{Scene, STRIP};
use std::error::Error;

pub(crate) fn show(scene: &mut Scene, display: &mut Display) -> Result<(), Box<dyn Error>> {
    let mut strip = [0; STRIP];
    let (mut frame, mut contents) = scene.begin_frame()?;
    while let Some(mut band) = frame.next_band(&mut strip)? {
        contents.draw(&mut band)?;
        band.send(display)?;
    }
    Ok(())
}
