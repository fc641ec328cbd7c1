//! The inks of [`crate::shade`] that are more than a colour.

use super::{Ink, InkFor};
use crate::clip::Barycentric;
use crate::output::{Shade, Shades};
use crate::raster::{Span, Triangle};
use crate::shade::{Bayer, Channels, Dithered, Even, Flat, Gouraud, Lit, Nearest, Ramps, Shaded};
use core::iter::repeat;
use embedded_graphics_core::pixelcolor::PixelColor;

impl Ink for Flat {
    type Carried = ();

    fn piece(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl<C: Channels> InkFor<C> for Flat {
    type Fill = C;

    fn over(&self, _: &Triangle<'_>) -> C {
        self.nearest()
    }

    #[inline(always)]
    fn run(fill: &C, _: Span) -> impl Iterator<Item = C> {
        repeat(*fill)
    }

    #[inline(always)]
    fn even(&self) -> Option<C> {
        Some(self.nearest())
    }
}

impl<I: Ink> Ink for Dithered<I> {
    type Carried = I::Carried;

    fn piece(&self, corners: [I::Carried; 3]) -> Self {
        Self(self.0.piece(corners))
    }
}

impl<C: Channels> InkFor<C> for Dithered<Flat> {
    type Fill = Even<C>;

    fn over(&self, _: &Triangle<'_>) -> Even<C> {
        Even::new(self.0)
    }

    #[inline(always)]
    fn run(fill: &Even<C>, span: Span) -> impl Iterator<Item = C> {
        fill.run(span.x, span.y)
    }
}

macro_rules! smooth {
    ($($ink:ident),*) => {$(
        impl Ink for $ink {
            type Carried = Barycentric;

            fn piece(&self, corners: [Barycentric; 3]) -> Self {
                self.part(corners.map(|c| c.weights()))
            }
        }

        impl<C: Channels> InkFor<C> for $ink {
            type Fill = Ramps<C>;

            #[inline(always)]
            fn over(&self, triangle: &Triangle<'_>) -> Ramps<C> {
                self.over(triangle)
            }

            #[inline(always)]
            fn run(fill: &Ramps<C>, span: Span) -> impl Iterator<Item = C> {
                fill.run::<Nearest>(span.x, span.y)
            }
        }

        impl<C: Channels> InkFor<C> for Dithered<$ink> {
            type Fill = Ramps<C>;

            #[inline(always)]
            fn over(&self, triangle: &Triangle<'_>) -> Ramps<C> {
                self.0.over(triangle)
            }

            #[inline(always)]
            fn run(fill: &Ramps<C>, span: Span) -> impl Iterator<Item = C> {
                fill.run::<Bayer>(span.x, span.y)
            }
        }
    )*};
}

smooth!(Gouraud, Lit);

impl<C: PixelColor> Ink for Shaded<'_, C> {
    type Carried = Barycentric;

    fn piece(&self, corners: [Barycentric; 3]) -> Self {
        self.part(corners.map(|c| c.weights()))
    }
}

impl<'t, C: PixelColor> InkFor<C> for Shaded<'t, C> {
    type Fill = Shade<'t, C>;

    fn over(&self, triangle: &Triangle<'_>) -> Shade<'t, C> {
        Shades { colours: self.colours(), light: self.light() }.over(triangle)
    }

    #[inline(always)]
    fn run(fill: &Shade<'t, C>, span: Span) -> impl Iterator<Item = C> {
        fill.run(span)
    }

    #[inline(always)]
    fn shades(&self) -> Option<Shades<'_, C>> {
        Some(Shades { colours: self.colours(), light: self.light() })
    }
}
