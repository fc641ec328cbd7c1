//! Sends the areas of a frame that changed to the display, in bands.

use embedded_graphics::mono_font::{ascii::FONT_5X8, MonoTextStyle};
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use pinhole::{Band, DepthBuffer, DirtyRegions, Frame, PixelFormat, TransferCost};

pub(crate) const SIZE: Size = Size::new(128, 64);
const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
/// Two commands of three bytes set a window of the panel.
const WINDOW: u16 = 6;

/// A display that takes rectangles of pixels, two per byte with the left one in the upper half; x and width are even.
pub(crate) trait Display {
    type Error;
    fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), Self::Error>;
}

/// A display, the areas drawn on it, and the memory of a band: colours, two pixels per byte, and depths.
pub(crate) struct Screen<'a, D> {
    display: &'a mut D,
    dirty: DirtyRegions<6>,
    colours: &'a mut [u8],
    depths: &'a mut [u16],
    sent: usize,
}

impl<'a, D: Display> Screen<'a, D> {
    /// `colours` and `depths` for some rows of the display, or for all of it.
    pub(crate) fn new(display: &'a mut D, colours: &'a mut [u8], depths: &'a mut [u16]) -> Self {
        let dirty = DirtyRegions::new(AREA, TransferCost::new(Gray4::BITS, WINDOW)).with_steps(2, 1);
        Self { display, dirty, colours, depths, sent: 0 }
    }

    /// Marks the complete picture as changed, for a new scene.
    pub(super) fn clear(&mut self) {
        self.dirty.invalidate();
    }

    /// Marks an area in which something moves in this frame.
    pub(super) fn mark(&mut self, area: Rectangle) {
        self.dirty.mark(area);
    }

    /// Draws and sends the areas that changed. `draw` is called for every band, with depth values for it.
    pub(super) fn show(
        &mut self,
        caption: &str,
        mut draw: impl FnMut(&mut Band<'_, Gray4>, &mut DepthBuffer<'_>),
    ) -> Result<(), D::Error> {
        for &area in &self.dirty.take() {
            let mut frame = Frame::new(area, Gray4::BLACK);
            while let Some(mut band) = frame.next_band(self.colours).expect("a strip of one row or more") {
                let mut depth = DepthBuffer::new(band.area(), self.depths).expect("a depth for each pixel");
                draw(&mut band, &mut depth);
                write(caption, &mut band);
                self.sent += band.bytes().len();
                self.display.write(&band.area(), band.bytes())?;
            }
        }
        Ok(())
    }

    /// Bytes of pixels sent since the last call.
    pub(crate) fn sent(&mut self) -> usize {
        core::mem::take(&mut self.sent)
    }
}

/// Draws text in the lower left corner. Not inlined: its variables are not on the stack while solids are drawn.
#[inline(never)]
fn write(caption: &str, band: &mut Band<'_, Gray4>) {
    let style = MonoTextStyle::new(&FONT_5X8, Gray4::new(9));
    let Ok(_) = Text::new(caption, Point::new(1, 61), style).draw(band);
}
