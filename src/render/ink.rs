//! What a face is filled with.

use crate::clip::Carried;
use crate::output::send;
use crate::raster::{Span, Triangle};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::PixelColor;

/// What a face is filled with: a colour, or something that varies over the face. The closures that
/// shade faces return one.
///
/// Every `PixelColor` is an ink, and then nothing is computed or carried that one colour does not need.
pub trait Ink: Copy {
    /// What a corner carries when a face is cut: `()` for inks that do not vary.
    type Carried: Carried;

    /// The ink of a piece of a face, whose corners are these points of it.
    #[must_use]
    fn piece(&self, corners: [Self::Carried; 3]) -> Self;
}

/// An [`Ink`] for targets with pixels of `C`.
pub trait InkFor<C: PixelColor>: Ink {
    /// What is worked out once for each triangle.
    type Fill;

    /// Made ready for a triangle, whose corners are in the order of the face's.
    fn over(&self, triangle: &Triangle) -> Self::Fill;

    /// Sends one run of covered pixels in a row.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn send<D: DrawTarget<Color = C>>(fill: &Self::Fill, span: Span, target: &mut D) -> Result<(), D::Error>;
}

impl<C: PixelColor> Ink for C {
    type Carried = ();

    fn piece(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl<C: PixelColor> InkFor<C> for C {
    type Fill = C;

    #[inline(always)]
    fn over(&self, _: &Triangle) -> C {
        *self
    }

    #[inline(always)]
    fn send<D: DrawTarget<Color = C>>(fill: &C, span: Span, target: &mut D) -> Result<(), D::Error> {
        send(target, span, *fill)
    }
}
