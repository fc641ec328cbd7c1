//! Four methods of sending a frame to a panel.

use super::films::{Recorded, Thing, BACKGROUND};
use super::screen::StoredPixel;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{Dim, DirtyRegions, Frame, PixelFormat, TransferCost};

/// A colour with all traits that these functions need.
pub trait Colour: PixelFormat + Dim + StoredPixel + From<Rgb888> {}
impl<C: PixelFormat + Dim + StoredPixel + From<Rgb888>> Colour for C {}

/// Memory for `rows` rows.
pub fn strip<C: PixelFormat>(width: u32, rows: u32) -> Vec<u8> {
    vec![0; Frame::<C>::strip_bytes(width, rows)]
}

/// A part of a frame, in bands as high as the strip has room for.
pub fn in_bands<D: DrawTarget<Color: Colour>>(
    things: &mut [Recorded<'_>],
    area: Rectangle,
    strip: &mut [u8],
    target: &mut D,
) -> Result<(), D::Error> {
    let mut frame = Frame::new(area, D::Color::from(BACKGROUND));
    while let Some(mut band) = frame.next_band(strip).expect("a strip of a row or more") {
        things.iter_mut().for_each(|thing| thing.draw(&mut band));
        band.send(target)?;
    }
    Ok(())
}

/// The tracker of the regions of a frame that changed.
pub fn dirty<C: PixelFormat>(area: Rectangle) -> DirtyRegions<4> {
    DirtyRegions::new(area, TransferCost::new(C::BITS, TransferCost::MIPI_DCS))
}

/// The rectangles of moving objects: where they were and where they are.
pub fn changes<D: DrawTarget<Color: Colour>>(
    things: &mut [Recorded<'_>],
    dirty: &mut DirtyRegions<4>,
    strip: &mut [u8],
    target: &mut D,
) -> Result<(), D::Error> {
    things.iter().filter(|it| it.thing.moves).for_each(|it| dirty.mark(it.faces.bounds()));
    for area in dirty.take() {
        in_bands(things, area, strip, target)?;
    }
    Ok(())
}

/// Draws directly onto the panel: clears it, then sends each span.
pub fn in_spans<D: DrawTarget<Color: Colour>>(things: &[Thing], target: &mut D) -> Result<(), D::Error> {
    target.clear(BACKGROUND.into())?;
    things.iter().try_for_each(|thing| thing.draw(target))
}

/// Draws directly onto the panel: clears it, then sends each pixel.
pub fn in_pixels<D: DrawTarget<Color: Colour>>(things: &[Thing], target: &mut D) -> Result<(), D::Error> {
    target.clear(BACKGROUND.into())?;
    things.iter().try_for_each(|thing| thing.draw(&mut Single(target)))
}

/// A target that is given one pixel at a time.
struct Single<'a, D>(&'a mut D);

impl<D: DrawTarget> Dimensions for Single<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.0.bounding_box()
    }
}

impl<D: DrawTarget> DrawTarget for Single<'_, D> {
    type Color = D::Color;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<D::Color>>>(&mut self, pixels: I) -> Result<(), D::Error> {
        pixels.into_iter().try_for_each(|pixel| self.0.draw_iter([pixel]))
    }
}
