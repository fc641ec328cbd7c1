//! The shader traits of [`Flat`], [`Gouraud`], [`Lit`] and [`Dithered`].

use super::gouraud::SpanColors;
use super::levels::{align, levels};
use super::shader::inner_with_corners;
use super::{CornerValues, Shader, SpanShader};
use crate::clip::Barycentric;
use crate::color::Color;
use crate::raster::{Gradient, Span, Triangle};
use crate::shading::{Bayer, Dithered, Flat, Gouraud, Lit, Nearest};
use core::iter::repeat;

impl Shader for Flat {
    type Varying = ();

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl<C: Color> SpanShader<C> for Flat {
    type Ink = C;
    type Setup = C;
    type FastPath = ();

    fn set_up(&self, _: &Triangle<'_>) -> C {
        self.nearest()
    }

    #[inline(always)]
    fn span(setup: &C, _: Span) -> impl Iterator<Item = C> {
        repeat(*setup)
    }

    #[inline(always)]
    fn solid(&self) -> Option<C> {
        Some(self.nearest())
    }
}

impl<S: Shader> Shader for Dithered<S> {
    type Varying = S::Varying;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self(self.0.sub_face(corners))
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self(inner_with_corners(&self.0, corners))
    }
}

impl<C: Color> SpanShader<C> for Dithered<Flat> {
    type Ink = C;
    /// The levels of the channels.
    type Setup = [u32; 3];
    type FastPath = ();

    fn set_up(&self, _: &Triangle<'_>) -> [u32; 3] {
        levels::<C>(self.0).map(align)
    }

    #[inline(always)]
    fn span(levels: &[u32; 3], Span { x, y, .. }: Span) -> impl Iterator<Item = C> {
        SpanColors::<C, Bayer>::new(*levels, [0; 3], (x, y))
    }
}

macro_rules! smooth {
    ($($shader:ident),*) => {$(
        impl Shader for $shader {
            type Varying = Barycentric;

            fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
                self.with_weights(corners.map(|c| c.weights()))
            }
        }

        impl<C: Color> SpanShader<C> for $shader {
            type Ink = C;
            type Setup = [Gradient; 3];
            type FastPath = ();

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> [Gradient; 3] {
                self.gradients::<C>(triangle)
            }

            #[inline(always)]
            fn span(gradients: &[Gradient; 3], span: Span) -> impl Iterator<Item = C> {
                SpanColors::<C, Nearest>::along(gradients, span)
            }
        }

        impl<C: Color> SpanShader<C> for Dithered<$shader> {
            type Ink = C;
            type Setup = [Gradient; 3];
            type FastPath = ();

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> [Gradient; 3] {
                self.0.gradients::<C>(triangle)
            }

            #[inline(always)]
            fn span(gradients: &[Gradient; 3], span: Span) -> impl Iterator<Item = C> {
                SpanColors::<C, Bayer>::along(gradients, span)
            }
        }
    )*};
}

smooth!(Gouraud, Lit);
