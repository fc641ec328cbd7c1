//! Sends the areas of a frame that changed to the display, in bands.

use super::dithered::Dithered;
use embedded_graphics::mono_font::{ascii::FONT_5X8, MonoTextStyle, MonoTextStyleBuilder};
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use pinhole::{
    bands::{DirtyRegions, TransferCost},
    prelude::*,
};

pub(crate) const SIZE: Size = Size::new(128, 64);
const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
/// Two commands of three bytes set a window of the panel.
const WINDOW: u16 = 6;

/// A display that takes rectangles of pixels, two per byte with the left one in the upper half; x and width are even.
pub(crate) trait Display {
    type Error;
    fn write(&mut self, area: &Rectangle, pixels: &[u8]) -> Result<(), Self::Error>;
}

/// A display, the areas drawn on it, and the memory of a band: colours, two pixels per byte, depths, and pixels of one bit.
pub(crate) struct Screen<'a, D> {
    display: &'a mut D,
    dirty: DirtyRegions<6>,
    colours: &'a mut [u8],
    depths: &'a mut [u16],
    bits: &'a mut [u8],
    sent: usize,
}

impl<'a, D: Display> Screen<'a, D> {
    /// `colours`, `depths` and `bits` for some rows of the display, or for all of it.
    pub(crate) fn new(
        display: &'a mut D,
        colours: &'a mut [u8],
        depths: &'a mut [u16],
        bits: &'a mut [u8],
    ) -> Self {
        let dirty = DirtyRegions::new(AREA, TransferCost::new(Gray4::FORMAT.bits(), WINDOW)).with_steps(2, 1);
        Self { display, dirty, colours, depths, bits, sent: 0 }
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
        draw: impl FnMut(&mut Band<'_, Gray4>, &mut DepthBuffer<'_>),
    ) -> Result<(), D::Error> {
        let style = MonoTextStyle::new(&FONT_5X8, Gray4::new(9));
        self.show_on(Gray4::BLACK, caption, style, draw)
    }

    /// [`show`](Self::show) on a bright background, which the caption has a dark one on.
    pub(super) fn show_on_bright(
        &mut self,
        background: Gray4,
        caption: &str,
        draw: impl FnMut(&mut Band<'_, Gray4>, &mut DepthBuffer<'_>),
    ) -> Result<(), D::Error> {
        self.show_on(background, caption, on_black(Gray4::WHITE, Gray4::BLACK), draw)
    }

    fn show_on(
        &mut self,
        background: Gray4,
        caption: &str,
        style: MonoTextStyle<'_, Gray4>,
        mut draw: impl FnMut(&mut Band<'_, Gray4>, &mut DepthBuffer<'_>),
    ) -> Result<(), D::Error> {
        for &area in &self.dirty.take() {
            let mut frame = Frame::new(area, background);
            while let Some(mut band) = frame.next_band(self.colours).expect("a strip of one row or more") {
                let mut depth = DepthBuffer::new(band.area(), self.depths).expect("a depth for each pixel");
                draw(&mut band, &mut depth);
                write(caption, style, &mut band);
                self.sent += band.bytes().len();
                self.display.write(&band.area(), band.bytes())?;
            }
        }
        Ok(())
    }

    /// Draws in greys and sends in black and white, by ordered dithering, the areas that changed: whole rows.
    pub(super) fn show_dithered(
        &mut self,
        background: Gray8,
        caption: &str,
        mut draw: impl FnMut(&mut Dithered<'_, Band<'_, BinaryColor>>, &mut DepthBuffer<'_>),
    ) -> Result<(), D::Error> {
        for &area in &self.dirty.take() {
            let mut frame = Frame::new(area, BinaryColor::Off);
            while let Some(mut band) = frame.next_band(self.bits).expect("a strip of one row or more") {
                let mut depth = DepthBuffer::new(band.area(), self.depths).expect("a depth for each pixel");
                let mut greys = Dithered(&mut band);
                let Ok(()) = greys.clear(background);
                draw(&mut greys, &mut depth);
                write(caption, on_black(BinaryColor::On, BinaryColor::Off), &mut band);
                let levels = spread(band.bytes(), self.colours);
                self.sent += levels.len();
                self.display.write(&band.area(), levels)?;
            }
        }
        Ok(())
    }

    /// Bytes of pixels sent since the last call.
    pub(crate) fn sent(&mut self) -> usize {
        core::mem::take(&mut self.sent)
    }
}

/// Two pixels a byte, black or white, from eight pixels a byte.
fn spread<'l>(bits: &[u8], levels: &'l mut [u8]) -> &'l [u8] {
    for (four, byte) in levels.chunks_exact_mut(4).zip(bits) {
        for (pair, at) in four.iter_mut().zip([6, 4, 2, 0]) {
            *pair = [0x00, 0x0f, 0xf0, 0xff][usize::from(byte >> at & 3)];
        }
    }
    levels.get(..4 * bits.len()).expect("as many pixels as the strip of one bit has")
}

fn on_black<C: PixelColor>(text: C, background: C) -> MonoTextStyle<'static, C> {
    MonoTextStyleBuilder::new().font(&FONT_5X8).text_color(text).background_color(background).build()
}

/// Draws text in the lower left corner. Not inlined: its variables are not on the stack while solids are drawn.
#[inline(never)]
fn write<C: Color>(caption: &str, style: MonoTextStyle<'_, C>, band: &mut Band<'_, C>) {
    let Ok(_) = Text::new(caption, Point::new(1, 61), style).draw(band);
}
