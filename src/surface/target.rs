//! What pixels are drawn into.

use super::depth::{DepthBuffer, DepthTarget};
use super::reach;
use crate::fast::{self, table_fill::Shades};
use crate::raster::{self, DepthTriangle, Gradient, Pixel, Scissor, ScreenPoint, Span, Triangle};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// What is drawn into: any `embedded-graphics` DrawTarget, or, in a fraction of the instructions,
/// [`Pixels`](crate::Pixels) in memory, with the same picture.
///
/// A DrawTarget gets a `fill_solid` or a `fill_contiguous` for every run of pixels.
pub trait Target: sealed::Sealed {
    /// The colour of a pixel.
    type Color: PixelColor;

    /// What drawing can fail with.
    type Error;

    /// Its pixels.
    fn area(&self) -> Rectangle;

    /// Those of them that 2D drawing may reach.
    #[doc(hidden)]
    #[inline(always)]
    fn reach(&self) -> Scissor {
        reach(&self.area())
    }

    /// Draws a run of pixels in one colour; it lies in the [`area`](Self::area).
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill(&mut self, span: Span, colour: Self::Color) -> Result<(), Self::Error>;

    /// Draws a run of pixels in a row, each in a colour of its own, of which there are as many or more; it lies in the
    /// [`area`](Self::area).
    ///
    /// # Errors
    ///
    /// The target's own.
    fn fill_run(&mut self, span: Span, colours: impl Iterator<Item = Self::Color>)
        -> Result<(), Self::Error>;

    /// Draws a triangle of one colour.
    #[doc(hidden)]
    #[inline(always)]
    fn triangle(
        &mut self,
        triangle: &Triangle<'_>,
        scissor: &Scissor,
        colour: Self::Color,
    ) -> Result<(), Self::Error> {
        fast::spans(triangle, scissor).try_for_each(|span| self.fill(span, colour))
    }

    /// Draws a triangle of one colour in 2D, with its area, which is not zero.
    #[doc(hidden)]
    #[inline(always)]
    fn plain_triangle(
        &mut self,
        corners: [ScreenPoint; 3],
        area: i64,
        colour: Self::Color,
    ) -> Result<(), Self::Error> {
        let all = self.reach();
        self.triangle(&Triangle::new(corners, area, &all), &all, colour)
    }

    /// With what is tested here; worked out once, not for each triangle.
    #[doc(hidden)]
    fn against<'d, 'b>(&self, depth: &'d mut DepthBuffer<'b>) -> DepthTarget<'d, 'b> {
        DepthTarget::new(depth, None)
    }

    /// Draws it where it is nearer than what is held.
    #[doc(hidden)]
    #[inline(always)]
    fn nearer(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        against: &mut DepthTarget<'_, '_>,
        colour: Self::Color,
    ) -> Result<(), Self::Error> {
        spans_nearer(self, piece, scissor, against, colour)
    }

    /// Draws a triangle whose pixels have colours of their own.
    #[doc(hidden)]
    #[inline(always)]
    fn shaded<R: Iterator<Item = Self::Color>>(
        &mut self,
        triangle: &Triangle<'_>,
        scissor: &Scissor,
        run: impl Fn(Span) -> R,
    ) -> Result<(), Self::Error> {
        fast::spans(triangle, scissor).try_for_each(|span| self.fill_run(span, run(span)))
    }

    /// Draws it where it is nearer than what is held.
    #[doc(hidden)]
    #[inline(always)]
    fn shaded_nearer<R: Iterator<Item = Self::Color>>(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        against: &mut DepthTarget<'_, '_>,
        run: impl Fn(Span) -> R,
    ) -> Result<(), Self::Error> {
        spans_shaded_nearer(self, piece, scissor, against, run)
    }

    /// The same of colours that are looked up.
    #[doc(hidden)]
    #[inline(always)]
    fn shades_nearer(
        &mut self,
        piece: &DepthTriangle<'_>,
        scissor: &Scissor,
        against: &mut DepthTarget<'_, '_>,
        shades: &Shades<'_, Self::Color>,
    ) -> Result<(), Self::Error> {
        let shade = shades.over(&piece.triangle);
        spans_shaded_nearer(self, piece, scissor, against, |span| shade.run(span))
    }

    /// Draws a line.
    #[doc(hidden)]
    #[inline(always)]
    fn line(
        &mut self,
        from: Pixel,
        to: Pixel,
        scissor: &Scissor,
        colour: Self::Color,
    ) -> Result<(), Self::Error> {
        raster::line(from, to, scissor, |span| self.fill(span, colour))
    }
}

/// [`Target::nearer`] span by span.
#[inline(never)] // its frame is gone when it returns
pub(super) fn spans_nearer<T: Target + ?Sized>(
    target: &mut T,
    piece: &DepthTriangle<'_>,
    scissor: &Scissor,
    against: &mut DepthTarget<'_, '_>,
    colour: T::Color,
) -> Result<(), T::Error> {
    let mut spans = fast::spans(&piece.triangle, scissor);
    if spans.is_empty() {
        return Ok(());
    }
    let plane = fast::depth_gradient(&piece.triangle, &piece.depths);
    spans.try_for_each(|span| against.buffer.test(span, &plane, |visible| target.fill(visible, colour)))
}

/// [`Target::shaded_nearer`] span by span.
#[inline(never)] // its frame is gone when it returns
pub(super) fn spans_shaded_nearer<T: Target + ?Sized, R: Iterator<Item = T::Color>>(
    target: &mut T,
    piece: &DepthTriangle<'_>,
    scissor: &Scissor,
    against: &mut DepthTarget<'_, '_>,
    run: impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    let plane = fast::depth_gradient(&piece.triangle, &piece.depths);
    let mut spans = fast::spans(&piece.triangle, scissor);
    spans.try_for_each(|span| span_shaded_nearer(target, span, &plane, against, &run))
}

/// One span of that.
#[inline(never)] // what it works with is large, and is not there while the next span is found
fn span_shaded_nearer<T: Target + ?Sized, R: Iterator<Item = T::Color>>(
    target: &mut T,
    span: Span,
    plane: &Gradient,
    against: &mut DepthTarget<'_, '_>,
    run: &impl Fn(Span) -> R,
) -> Result<(), T::Error> {
    against.buffer.test(span, plane, |visible| target.fill_run(visible, run(visible)))
}

mod sealed {
    pub trait Sealed {}
    impl<D: embedded_graphics_core::draw_target::DrawTarget> Sealed for D {}
    impl<C, Cell> Sealed for super::super::pixels::Pixels<'_, C, Cell> {}
}

impl<D: DrawTarget> Target for D {
    type Color = D::Color;
    type Error = D::Error;

    fn area(&self) -> Rectangle {
        self.bounding_box()
    }

    #[inline(always)]
    fn fill(&mut self, span: Span, colour: D::Color) -> Result<(), D::Error> {
        self.fill_solid(&rectangle(span), colour)
    }

    #[inline(always)]
    fn fill_run(&mut self, span: Span, colours: impl Iterator<Item = D::Color>) -> Result<(), D::Error> {
        self.fill_contiguous(&rectangle(span), colours.take(span.width as usize))
    }
}

/// As `embedded-graphics` has it.
#[inline(always)]
fn rectangle(Span { x, y, width, height }: Span) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width as u32, height as u32)) // both positive
}
