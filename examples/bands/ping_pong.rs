//! Two strips in turn: while DMA sends one, the next band is drawn into the other. The transfer owns what it sends, as
//! the drivers of microcontrollers have it, and gives it back.

use crate::display::Display;
use crate::scene::{Scene, STRIP};
use embedded_graphics::primitives::Rectangle;
use std::error::Error;
use std::thread::JoinHandle;

/// The bus, free.
struct Dma(Display);

/// The bus and a strip, on their way.
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
    // On a microcontroller: two statics, taken once.
    let strips = [0; 2].map(|_| Vec::leak(vec![0; STRIP]));
    let [mut free, other] = strips;
    let (mut frame, mut recorded) = scene.record()?;
    // Nothing is on its way yet: an empty transfer.
    let nowhere = Rectangle::zero();
    let mut transfer = Dma(display).send(nowhere, other);
    while let Some(mut band) = frame.next_band(free)? {
        recorded.draw(&mut band)?;
        let area = band.area();
        let bytes = band.into_bytes();
        let (dma, sent) = transfer.wait()?;
        transfer = dma.send(area, bytes);
        free = sent;
    }
    let (dma, _) = transfer.wait()?;
    Ok(dma.0)
}
