//! The shader of a face, whichever the options ask for. One type for all of them, so that the code that draws faces is compiled
//! once for a pixel format, and not once more for each kind of shader.

use crate::bands::Colour;
use pinhole::raster::{Span, Triangle};
use pinhole::shading::{Barycentric, Lit};
use pinhole::{
    prelude::*,
    shading::{CornerValues, Dithered, Shader, SpanShader},
    texture::{ClampedTexels, LitTextured, TexelSlice, Textured},
};

/// Repeated or clamped texels of a picture.
type Repeated<'t, C> = TexelSlice<'t, C>;
type Clamped<'t, C> = ClampedTexels<TexelSlice<'t, C>>;

/// The colours of a span.
type Colours<'t, C> = Box<dyn Fn(Span) -> Vec<C> + 't>;

/// Sets up a shader for a triangle.
fn set_up<'t, C: Colour, S: SpanShader<C, Ink = C, Setup: 't>>(
    shader: &S,
    triangle: &Triangle<'_>,
) -> Colours<'t, C> {
    let setup = shader.set_up(triangle);
    Box::new(move |span| S::span(&setup, span).take(span.width as usize).collect())
}

/// Defines the type of its variants: those of one colour a face, and those that vary over it.
macro_rules! brush {
    ($($flat:ident($of_flat:ty),)* ; $($varying:ident($of_varying:ty),)*) => {
        #[derive(Clone, Copy)]
        pub(crate) enum Brush<'t, C> {
            $($flat($of_flat),)*
            $($varying($of_varying),)*
        }

        impl<C: Colour> Shader for Brush<'_, C> {
            type Varying = Barycentric;
            const NEEDS_W: bool = true;

            fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
                match self {
                    $(Self::$flat(_) => *self,)*
                    $(Self::$varying(shader) => Self::$varying(shader.sub_face(corners)),)*
                }
            }

            fn with_corners(&self, corners: &CornerValues) -> Self {
                match self {
                    $(Self::$flat(_) => *self,)*
                    $(Self::$varying(shader) => Self::$varying(shader.with_corners(corners)),)*
                }
            }
        }

        impl<'t, C: Colour> SpanShader<C> for Brush<'t, C> {
            type Ink = C;
            type Setup = Colours<'t, C>;
            type FastPath = ();

            fn set_up(&self, triangle: &Triangle<'_>) -> Colours<'t, C> {
                match self {
                    $(Self::$flat(shader) => set_up(shader, triangle),)*
                    $(Self::$varying(shader) => set_up(shader, triangle),)*
                }
            }

            fn span(colours: &Colours<'t, C>, span: Span) -> impl Iterator<Item = C> {
                colours(span).into_iter()
            }

            fn solid(&self) -> Option<C> {
                match self {
                    Self::Flat(flat) => flat.solid(),
                    _ => None,
                }
            }
        }
    };
}

brush! {
    Flat(Flat),
    FlatDithered(Dithered<Flat>),
    ;
    Smooth(Lit),
    SmoothDithered(Dithered<Lit>),
    Glowing(Gouraud),
    GlowingDithered(Dithered<Gouraud>),
    Texture(Textured<Repeated<'t, C>>),
    ClampedTexture(Textured<Clamped<'t, C>>),
    LitTexture(LitTextured<Repeated<'t, C>>),
    LitClampedTexture(LitTextured<Clamped<'t, C>>),
}
