//! The inks of [`crate::shading`] that are more than a colour.

use super::{Shader, SpanShader};
use crate::clip::Barycentric;
use crate::raster::{Span, Triangle};
use crate::shading::{
    Bayer, ChannelGradients, Channels, Dithered, DitheredColor, Flat, Gouraud, Lit, Nearest,
};
use core::iter::repeat;

impl Shader for Flat {
    type Varying = ();

    fn sub_face(&self, _: [(); 3]) -> Self {
        *self
    }
}

impl<C: Channels> SpanShader<C> for Flat {
    type Setup = C;

    fn set_up(&self, _: &Triangle<'_>) -> C {
        self.nearest()
    }

    #[inline(always)]
    fn span(fill: &C, _: Span) -> impl Iterator<Item = C> {
        repeat(*fill)
    }

    #[inline(always)]
    fn solid_color(&self) -> Option<C> {
        Some(self.nearest())
    }
}

impl<I: Shader> Shader for Dithered<I> {
    type Varying = I::Varying;

    fn sub_face(&self, corners: [I::Varying; 3]) -> Self {
        Self(self.0.sub_face(corners))
    }
}

impl<C: Channels> SpanShader<C> for Dithered<Flat> {
    type Setup = DitheredColor<C>;

    fn set_up(&self, _: &Triangle<'_>) -> DitheredColor<C> {
        DitheredColor::new(self.0)
    }

    #[inline(always)]
    fn span(fill: &DitheredColor<C>, span: Span) -> impl Iterator<Item = C> {
        fill.run(span.x, span.y)
    }
}

macro_rules! smooth {
    ($($ink:ident),*) => {$(
        impl Shader for $ink {
            type Varying = Barycentric;

            fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
                self.with_weights(corners.map(|c| c.weights()))
            }
        }

        impl<C: Channels> SpanShader<C> for $ink {
            type Setup = ChannelGradients<C>;

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> ChannelGradients<C> {
                self.gradients(triangle)
            }

            #[inline(always)]
            fn span(fill: &ChannelGradients<C>, span: Span) -> impl Iterator<Item = C> {
                fill.run::<Nearest>(span.x, span.y)
            }
        }

        impl<C: Channels> SpanShader<C> for Dithered<$ink> {
            type Setup = ChannelGradients<C>;

            #[inline(always)]
            fn set_up(&self, triangle: &Triangle<'_>) -> ChannelGradients<C> {
                self.0.gradients(triangle)
            }

            #[inline(always)]
            fn span(fill: &ChannelGradients<C>, span: Span) -> impl Iterator<Item = C> {
                fill.run::<Bayer>(span.x, span.y)
            }
        }
    )*};
}

smooth!(Gouraud, Lit);
