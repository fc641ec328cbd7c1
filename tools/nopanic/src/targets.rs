//! Two ways to be a `DrawTarget`, neither with a panic of its own: a display behind a wire that may fail, and the least the trait
//! allows.

use crate::inputs::{area, size};
use core::hint::black_box;
use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Dimensions, OriginDimensions, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
    Pixel,
};

/// Sends areas and colours; every call may fail.
pub(crate) struct Wire<C>(pub(crate) C);

/// The wire is broken.
pub(crate) struct Broken;

impl<C> Wire<C> {
    fn send<T>(&mut self, word: T) -> Result<(), Broken> {
        black_box(word);
        if crate::any() == 0 {
            Ok(())
        } else {
            Err(Broken)
        }
    }
}

impl<C> OriginDimensions for Wire<C> {
    fn size(&self) -> Size {
        size()
    }
}

impl<C: PixelColor> DrawTarget for Wire<C> {
    type Color = C;
    type Error = Broken;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Broken> {
        pixels.into_iter().try_for_each(|pixel| self.send(pixel))
    }

    fn fill_solid(&mut self, area: &Rectangle, colour: C) -> Result<(), Broken> {
        self.send((*area, colour))
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Broken> {
        self.send(*area)?;
        colours.into_iter().try_for_each(|colour| self.send(colour))
    }
}

/// Draws pixel by pixel, with a bounding box anywhere; all other methods are the trait's.
pub(crate) struct Least<C>(pub(crate) C);

impl<C> Dimensions for Least<C> {
    fn bounding_box(&self) -> Rectangle {
        area()
    }
}

impl<C: PixelColor> DrawTarget for Least<C> {
    type Color = C;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        pixels.into_iter().for_each(|pixel| {
            black_box(pixel);
        });
        Ok(())
    }
}
