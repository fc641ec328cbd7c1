//! The shader traits of [`Flat`], [`Gouraud`], [`Lit`] and [`Dithered`].

use super::{Shader, SpanShader};
use crate::clip::Barycentric;
use crate::color::Color;
use crate::raster::{Span, Triangle};
use crate::shading::{Bayer, ChannelGradients, Dithered, DitheredColor, Flat, Gouraud, Lit, Nearest};
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

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self(self.0.sub_face(corners))
    }
}

impl<C: Color> SpanShader<C> for Dithered<Flat> {
    type Ink = C;
    type Setup = DitheredColor<C>;

    fn set_up(&self, _: &Triangle<'_>) -> DitheredColor<C> {
        DitheredColor::new(self.0)
    }

    #[inline(always)]
    fn span(setup: &DitheredColor<C>, span: Span) -> impl Iterator<Item = C> {
        setup.span(span.x, span.y)
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
            type Setup = ChannelGradients<C>;

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> ChannelGradients<C> {
                self.gradients(triangle)
            }

            #[inline(always)]
            fn span(setup: &ChannelGradients<C>, span: Span) -> impl Iterator<Item = C> {
                setup.span::<Nearest>(span.x, span.y)
            }
        }

        impl<C: Color> SpanShader<C> for Dithered<$shader> {
            type Ink = C;
            type Setup = ChannelGradients<C>;

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> ChannelGradients<C> {
                self.0.gradients(triangle)
            }

            #[inline(always)]
            fn span(setup: &ChannelGradients<C>, span: Span) -> impl Iterator<Item = C> {
                setup.span::<Bayer>(span.x, span.y)
            }
        }
    )*};
}

smooth!(Gouraud, Lit);
