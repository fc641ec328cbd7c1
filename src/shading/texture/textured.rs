//! The shader of a face that shows a texture.

use super::gradients::Gradients;
use super::line::{unpacked, PackedLine, WideLine};
use super::linear::range;
use super::mapping::{FaceCoords, Textured};
use super::runs::{Lines, Runs, TexelRuns};
use super::texels::Texels;
use crate::clip::Barycentric;
use crate::math::hints::opaque_next;
use crate::math::num::dot;
use crate::raster::{Span, Triangle};
use crate::shading::{CornerValues, DrawRuns, Shader, SpanShader};

impl<S: Texels> Shader for Textured<S> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let mut own = *self;
        move_to(&mut own.coords.uv, &corners);
        own
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { coords: FaceCoords { w: corners.w(), ..self.coords }, ..*self }
    }
}

/// Replaces the texture coordinates of a face's corners by those of three of its points.
#[inline(never)] // rare: code size matters more than speed
fn move_to(uv: &mut [[i32; 2]; 3], points: &[Barycentric; 3]) {
    let [[ua, va], [ub, vb], [uc, vc]] = *uv;
    let mut i = 0;
    while let (Some(coords), Some(point)) = (uv.get_mut(i), points.get(i)) {
        let weights = point.weights();
        *coords = [mean([ua, ub, uc], weights), mean([va, vb, vc], weights)];
        i = opaque_next(i);
    }
}

/// The weighted mean of values of 24 bits, with weights in 2⁻³⁰. Weights may be off by 6 units: the mean is kept between the values.
#[inline(never)] // rare: code size matters more than speed
fn mean(values: [i32; 3], weights: [i32; 3]) -> i32 {
    let (least, extent) = range(&values);
    (((dot(&values, &weights) + (1 << 29)) >> 30) as i32).max(least).min(least + extent)
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
        let Self { texels, coords } = self;
        let gradients = Gradients::new(coords, texels.size_bits(), S::WIDE, triangle);
        TextureGradients { texels: *texels, gradients }
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
