//! Two strips: while DMA sends one, the next band is drawn into the other. A transfer owns its strip until it is complete, as
//! in HALs of microcontrollers.

use crate::display::Display;
use crate::scene::{Scene, STRIP};
use embedded_graphics::primitives::Rectangle;
use std::error::Error;
use std::ops::ControlFlow::Continue;
use std::thread::JoinHandle;

/// The idle bus.
struct Dma(Display);

/// A transfer in progress, which owns the bus and a strip.
struct Transfer(JoinHandle<(Dma, &'static mut [u8])>);

impl Dma {
    fn send(mut self, area: Rectangle, bytes: &'static mut [u8]) -> Transfer {
        Transfer(std::thread::spawn(move || {
            self.0.receive(&area, bytes);
            (self, bytes)
        }))
    }
}

impl Transfer {
    fn wait(self) -> Result<(Dma, &'static mut [u8]), &'static str> {
        self.0.join().map_err(|_| "the transfer failed")
    }
}

pub(crate) fn show(scene: &mut Scene, display: Display) -> Result<Display, Box<dyn Error>> {
    // In firmware these are two statics.
    let strips = [0; 2].map(|_| Vec::leak(vec![0; STRIP]));
    let [mut free, other] = strips;
    let (mut frame, mut contents) = scene.begin_frame()?;
    // The loop starts with an empty transfer.
    let nowhere = Rectangle::zero();
    let mut transfer = Dma(display).send(nowhere, other);
    // After the last band the strip comes back: `free` would be drawn into in the next frame.
    while let Continue(mut band) = frame.band_or_strip(free)? {
        contents.draw(&mut band)?;
        let area = band.area();
        let bytes = band.into_bytes();
        let (dma, sent) = transfer.wait()?;
        transfer = dma.send(area, bytes);
        free = sent;
    }
    let (dma, _) = transfer.wait()?;
    Ok(dma.0)
}
