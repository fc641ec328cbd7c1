//! The shader of a face, whichever the options ask for. One type for all of them, so that the code that draws faces is compiled
//! once for a pixel format, and not once more for each kind of shader.

use crate::paint::Colour;
use pinhole::clip::Barycentric;
use pinhole::raster::{Span, Triangle};
use pinhole::{
    ClampedTexels, CornerValues, Dithered, Flat, Gouraud, Lit, LitTextured, Shader, SpanShader, TexelSlice,
    Textured,
};

/// Repeated or clamped texels of a picture.
type Repeated<'t, C> = TexelSlice<'t, C>;
type Clamped<'t, C> = ClampedTexels<TexelSlice<'t, C>>;

#[derive(Clone, Copy)]
pub(crate) enum Brush<'t, C> {
    Flat(Flat),
    FlatDithered(Dithered<Flat>),
    Smooth(Lit),
    SmoothDithered(Dithered<Lit>),
    Glowing(Gouraud),
    GlowingDithered(Dithered<Gouraud>),
    Texture(Textured<Repeated<'t, C>>),
    ClampedTexture(Textured<Clamped<'t, C>>),
    LitTexture(LitTextured<Repeated<'t, C>>),
    LitClampedTexture(LitTextured<Clamped<'t, C>>),
}

impl<C: Colour> Shader for Brush<'_, C> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        match self {
            Self::Flat(_) | Self::FlatDithered(_) => *self,
            Self::Smooth(lit) => Self::Smooth(lit.sub_face(corners)),
            Self::SmoothDithered(lit) => Self::SmoothDithered(lit.sub_face(corners)),
            Self::Glowing(glowing) => Self::Glowing(glowing.sub_face(corners)),
            Self::GlowingDithered(glowing) => Self::GlowingDithered(glowing.sub_face(corners)),
            Self::Texture(textured) => Self::Texture(textured.sub_face(corners)),
            Self::ClampedTexture(textured) => Self::ClampedTexture(textured.sub_face(corners)),
            Self::LitTexture(textured) => Self::LitTexture(textured.sub_face(corners)),
            Self::LitClampedTexture(textured) => Self::LitClampedTexture(textured.sub_face(corners)),
        }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        match self {
            Self::Flat(_)
            | Self::FlatDithered(_)
            | Self::Smooth(_)
            | Self::SmoothDithered(_)
            | Self::Glowing(_)
            | Self::GlowingDithered(_) => *self,
            Self::Texture(textured) => Self::Texture(textured.with_corners(corners)),
            Self::ClampedTexture(textured) => Self::ClampedTexture(textured.with_corners(corners)),
            Self::LitTexture(textured) => Self::LitTexture(textured.with_corners(corners)),
            Self::LitClampedTexture(textured) => Self::LitClampedTexture(textured.with_corners(corners)),
        }
    }
}

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

impl<'t, C: Colour> SpanShader<C> for Brush<'t, C> {
    type Ink = C;
    type Setup = Colours<'t, C>;

    fn set_up(&self, triangle: &Triangle<'_>) -> Colours<'t, C> {
        match self {
            Self::Flat(flat) => set_up(flat, triangle),
            Self::FlatDithered(flat) => set_up(flat, triangle),
            Self::Smooth(lit) => set_up(lit, triangle),
            Self::SmoothDithered(lit) => set_up(lit, triangle),
            Self::Glowing(glowing) => set_up(glowing, triangle),
            Self::GlowingDithered(glowing) => set_up(glowing, triangle),
            Self::Texture(textured) => set_up(textured, triangle),
            Self::ClampedTexture(textured) => set_up(textured, triangle),
            Self::LitTexture(textured) => set_up(textured, triangle),
            Self::LitClampedTexture(textured) => set_up(textured, triangle),
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
