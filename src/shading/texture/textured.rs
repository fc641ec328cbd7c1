//! The shader of a face that shows a texture.

use super::gradients::Gradients;
use super::line::{unpacked, PackedLine, WideLine};
use super::mapping::Textured;
use super::runs::{Lines, Runs, TexelRuns};
use super::texels::Texels;
use crate::clip::Barycentric;
use crate::raster::{Span, Triangle};
use crate::shading::{CornerValues, DrawRuns, Shader, SpanShader};

impl<S: Texels> Shader for Textured<S> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let uv = corners.map(|corner| {
            let weights = corner.weights();
            [0, 1].map(|axis| {
                let [a, b, c] = self.uv.map(|uv| uv.get(axis).copied().unwrap_or(0));
                // Three products of 24 and 31 bits. Weights may be off by 6 units: the mean is kept between the corners'.
                let sum: i64 = [a, b, c].iter().zip(weights).map(|(&c, w)| i64::from(c) * i64::from(w)).sum();
                (((sum + (1 << 29)) >> 30) as i32).clamp(a.min(b).min(c), a.max(b).max(c))
            })
        });
        Self { uv, ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { w: corners.w(), ..*self }
    }
}

/// A [`Textured`] face set up for a triangle.
#[derive(Clone, Copy, Debug)]
pub struct TextureGradients<S> {
    texels: S,
    gradients: Gradients,
}

impl<S: Texels> TextureGradients<S> {
    #[inline(always)]
    pub(super) const fn texels(&self) -> &S {
        &self.texels
    }

    /// The runs of a span: their widths, and the texture coordinates of their pixels in 2⁻³² of the sides.
    #[inline(always)]
    pub(super) fn coordinates(
        &self,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = [u32; 2]>)> + use<'_, S> {
        TexelRuns::<S>::new(&self.gradients, span)
    }
}

impl<S: Texels> SpanShader<S::Color> for Textured<S> {
    type Setup = TextureGradients<S>;
    const LEAVES_OUT: bool = S::KEYED;

    fn set_up(&self, triangle: &Triangle<'_>) -> TextureGradients<S> {
        TextureGradients { texels: self.texture.texels, gradients: Gradients::new(self, triangle) }
    }

    fn span(setup: &TextureGradients<S>, span: Span) -> impl Iterator<Item = S::Color> {
        Self::runs(setup, span).flat_map(|(width, colors)| colors.take(width as usize))
    }

    #[inline(always)]
    fn runs(
        setup: &TextureGradients<S>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Color>)> {
        let texels = setup.texels;
        setup.coordinates(span).map(move |(width, line)| (width, line.map(move |[u, v]| texels.texel(u, v))))
    }

    #[inline(always)]
    fn kept(
        setup: &TextureGradients<S>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = Option<S::Color>>)> {
        let texels = setup.texels;
        setup
            .coordinates(span)
            .map(move |(width, line)| (width, line.map(move |[u, v]| texels.kept_texel(u, v))))
    }

    #[inline(always)]
    fn draw_runs<D: DrawRuns<S::Color>>(setup: &TextureGradients<S>, mut draw: D) {
        let texel = setup.texels.finder();
        if let Gradients::Packed(gradient) = &setup.gradients
            && draw.packed(gradient, move |word| texel(unpacked(word)))
        {
            return;
        }
        // One loop over rows for triangles of all kinds: another for each takes 2 KB of flash, with depth 3 KB.
        match S::WIDE {
            true => draw.lines(|span| Lines::<_, WideLine>::new(Runs::new(&setup.gradients, span)), texel),
            false => draw.lines(|span| Lines::<_, PackedLine>::new(Runs::new(&setup.gradients, span)), texel),
        }
    }
}
