//! What pixels are drawn into.

use super::Memory;
use crate::raster::Span;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// What pixels are drawn into: any `embedded-graphics` DrawTarget, or [`Pixels`](crate::Pixels), which lie in memory: the
/// same picture in a fraction of the instructions.
///
/// A DrawTarget gets a `fill_solid` or a `fill_contiguous` for every run of pixels.
pub trait Target: sealed::Sealed {
    /// Of its pixels.
    type Color: PixelColor;

    /// What drawing may come to.
    type Error;

    /// What memory holds for a pixel.
    #[doc(hidden)]
    type Cell: Copy;

    /// All pixels that there are.
    fn area(&self) -> Rectangle;

    /// Draws a run of pixels in one colour.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill(&mut self, span: Span, colour: Self::Color) -> Result<(), Self::Error>;

    /// Draws a run of pixels in a row, each in a colour of its own, of which there are as many.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill_run(&mut self, span: Span, colours: impl Iterator<Item = Self::Color>)
        -> Result<(), Self::Error>;

    /// Its pixels, where they lie in memory.
    #[doc(hidden)]
    fn memory(&mut self) -> Option<Memory<'_, Self::Cell>>;

    /// What memory holds for a colour.
    #[doc(hidden)]
    fn cell(colour: Self::Color) -> Option<Self::Cell>;
}

mod sealed {
    pub trait Sealed {}
    impl<D: embedded_graphics_core::draw_target::DrawTarget> Sealed for D {}
    impl<C> Sealed for crate::Pixels<'_, C> {}
}

impl<D: DrawTarget> Target for D {
    type Color = D::Color;
    type Error = D::Error;
    type Cell = ();

    fn area(&self) -> Rectangle {
        self.bounding_box()
    }

    #[inline(always)]
    fn fill(&mut self, span: Span, colour: D::Color) -> Result<(), D::Error> {
        self.fill_solid(&rectangle(span), colour)
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colours: impl Iterator<Item = D::Color>) -> Result<(), D::Error> {
        self.fill_contiguous(&rectangle(span), colours)
    }

    #[inline(always)]
    fn memory(&mut self) -> Option<Memory<'_, ()>> {
        None
    }

    #[inline(always)]
    fn cell(_: D::Color) -> Option<()> {
        None
    }
}

/// As `embedded-graphics` has it.
#[inline(always)]
fn rectangle(Span { x, y, width, height }: Span) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width as u32, height as u32)) // both positive
}
