//! The shader of a face that shows a texture.

use super::gradients::Gradients;
use super::line::{packed, unpacked, Line};
use super::linear::range;
use super::mapping::{FaceCoords, Textured};
use super::runs::Runs;
use super::texels::{TexelPath, Texels};
use crate::clip::Barycentric;
use crate::math::hints::opaque_next;
use crate::math::num::{dot, leading_zeros};
use crate::math::unrolled::map3;
use crate::raster::{Gradient, Span, Triangle};
use crate::shading::{CornerValues, FastPath, Shader, SpanShader};

impl<S: Texels> Shader for Textured<S> {
    type Varying = Barycentric;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        let mut own = *self;
        move_to(&mut own.coords, self.texels.size_bits(), &corners);
        own
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { coords: FaceCoords { w: corners.w, ..self.coords }, ..*self }
    }
}

/// Replaces the texture coordinates of a face's corners by those of three of its points, of a texture whose width and height have
/// these binary logarithms. The coordinates are rounded to 2⁻¹² texel, or as far as 24 bits allow, in a finer unit if need be.
#[inline(never)] // rare path: code size counts
fn move_to(coords: &mut FaceCoords, [w, h]: [u32; 2], points: &[Barycentric; 3]) {
    let FaceCoords { uv: [[ua, va], [ub, vb], [uc, vc]], unit: [u_unit, v_unit], .. } = *coords;
    let (u, u_unit) = refined([ua, ub, uc], u_unit, w);
    let (v, v_unit) = refined([va, vb, vc], v_unit, h);
    coords.unit = [u_unit, v_unit];
    let mut i = 0;
    while let (Some(own), Some(point)) = (coords.uv.get_mut(i), points.get(i)) {
        let weights = point.weights();
        *own = [mean(u, weights), mean(v, weights)];
        i = opaque_next(i);
    }
}

/// Coordinates on a side of 2^`bits` texels in a unit, 2^`unit` of 2⁻³² of the side, of at most 2⁻¹² texel, or as fine as 24 bits
/// allow: unchanged if theirs is so fine, otherwise less the sides below the least.
#[inline(never)] // rare path: code size counts
fn refined(values: [i32; 3], unit: u8, bits: u32) -> ([i32; 3], u8) {
    // A step is 2^(unit − 40 + bits) texel, and no unit is below 2¹⁶.
    let coarser = i32::from(unit) - 28 + (bits as i32).min(12);
    if coarser <= 0 {
        return (values, unit);
    }
    let (least, extent) = range(&values);
    let base = least & (-1 << (40u8.wrapping_sub(unit) & 31)); // a side has 2^(40 − unit) steps: 2⁸ … 2²³
    let finer = coarser.min(leading_zeros((least - base + extent) as u32) - 8).max(0) & 31;
    (map3(values, |value| (value - base) << finer), unit.wrapping_sub(finer as u8))
}

/// The weighted mean of values of 24 bits, with weights in 2⁻³⁰. Weights may be off by 6 units: the mean is kept between the values.
#[inline(never)] // rare path: code size counts
fn mean(values: [i32; 3], weights: [i32; 3]) -> i32 {
    let (least, extent) = range(&values);
    (((dot(&values, &weights) + (1 << 29)) >> 30) as i32).max(least).min(least + extent)
}

/// A [`Textured`] face set up for a triangle.
#[derive(Clone, Copy, Debug)]
pub struct TextureGradients<S> {
    pub(super) texels: S,
    gradients: Gradients,
}

impl<S: Texels> TextureGradients<S> {
    /// The runs of a span: their widths, the lines of their texture coordinates, and what [`TexelPath::covered_by`] takes.
    #[inline(always)]
    fn lines(&self, span: Span) -> impl Iterator<Item = (i32, Line, i32)> + use<'_, S> {
        let mut runs = Runs::new(&self.gradients, span);
        // A number that the compiler knows where texels have no copies.
        let of_row = match &self.gradients {
            _ if !S::FastPath::HAS_COPIES => 0,
            Gradients::Rows(rows) => rows.covered_in_row(span.y, self.texels.size_bits()),
            gradients => gradients.covered(self.texels.size_bits()),
        };
        core::iter::from_fn(move || {
            let (width, line) = match S::WIDE {
                true => runs.next_run::<2>(),
                false => runs.next_run::<1>(),
            }?;
            if S::FastPath::HAS_COPIES
                && let Runs::Perspective(runs) = &runs
            {
                return Some((width, line, runs.covered(self.texels.size_bits())));
            }
            Some((width, line, of_row))
        })
    }

    /// Texels for a triangle whose coordinates are linear.
    #[inline(always)]
    fn of_triangle(&self) -> S {
        match S::FastPath::HAS_COPIES {
            true => S::FastPath::covered_by(&self.texels, self.gradients.covered(self.texels.size_bits())),
            false => self.texels,
        }
    }

    /// The runs of a span: their widths, the texture coordinates of their pixels in 2⁻³² of the sides, and their texels.
    #[inline(always)]
    pub(super) fn coordinates(
        &self,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = [u32; 2]>, S)> + use<'_, S> {
        let texels = self.texels;
        self.lines(span).map(move |(width, line, covered)| {
            (width, line.map(coordinates::<S>), S::FastPath::covered_by(&texels, covered))
        })
    }
}

/// u and v in 2⁻³² of the sides, from the numbers of a line.
#[inline(always)]
const fn coordinates<S: Texels>([u, v]: [u32; 2]) -> [u32; 2] {
    match S::WIDE {
        true => [u, v],
        false => unpacked(u),
    }
}

/// The numbers of a line less u and v.
#[inline(always)]
const fn less<S: Texels>([a, b]: [u32; 2], by @ [u, v]: [u32; 2]) -> [u32; 2] {
    match S::WIDE {
        true => [a.wrapping_sub(u), b.wrapping_sub(v)],
        false => [a.wrapping_sub(packed(by)), b],
    }
}

impl<S: Texels> SpanShader<S::Color> for Textured<S> {
    type Ink = S::Ink;
    type Setup = TextureGradients<S>;
    type FastPath = Self;

    #[inline(always)]
    fn set_up(&self, triangle: &Triangle<'_>) -> TextureGradients<S> {
        let Self { texels, coords } = self;
        let gradients = Gradients::new(coords, texels.size_bits(), S::WIDE, triangle);
        TextureGradients { texels: *texels, gradients }
    }

    fn span(setup: &TextureGradients<S>, span: Span) -> impl Iterator<Item = S::Ink> {
        Self::runs(setup, span).flat_map(|(width, inks)| inks.take(width as usize))
    }
}

impl<S: Texels> FastPath<S::Color, Self> for Textured<S> {
    const ONE_NUMBER: bool = !S::WIDE && !S::FastPath::HAS_COPIES;
    const BY_RUN: bool = S::FastPath::HAS_COPIES;

    #[inline(always)]
    fn runs(
        setup: &TextureGradients<S>,
        span: Span,
    ) -> impl Iterator<Item = (i32, impl Iterator<Item = S::Ink>)> {
        setup.lines(span).map(|(width, Line { at, step }, covered)| {
            let (texels, step_of_texels) =
                (S::FastPath::covered_by(&setup.texels, covered), coordinates::<S>(step));
            let line = Line { at: less::<S>(at, S::FastPath::lead(&texels)), step };
            (width, line.map(S::FastPath::along(texels, step_of_texels, coordinates::<S>)))
        })
    }

    #[inline(always)]
    fn look_up(setup: &TextureGradients<S>) -> Option<impl Fn([u32; 2]) -> S::Ink + Copy> {
        let texel = S::FastPath::finder(setup.of_triangle());
        // Texels of 32-bit coordinates leave no number for the copy of a run.
        (!(S::FastPath::IS_FILTERED || S::FastPath::HAS_COPIES && S::WIDE))
            .then_some(move |numbers| texel(coordinates::<S>(numbers)))
    }

    #[inline(always)]
    fn look_up_in_run(
        setup: &TextureGradients<S>,
        covered: u32,
    ) -> Option<impl Fn([u32; 2]) -> S::Ink + Copy> {
        let texel = S::FastPath::finder(S::FastPath::covered_by(&setup.texels, covered as i32));
        Some(move |numbers| texel(coordinates::<S>(numbers)))
    }

    #[inline(always)]
    fn lines(setup: &TextureGradients<S>, span: Span) -> impl Iterator<Item = (i32, [[u32; 2]; 2])> {
        setup.lines(span).map(|(width, Line { at: [u, v], step }, covered)| {
            let second = if S::FastPath::HAS_COPIES { covered as u32 } else { v };
            (width, [[u, second], step])
        })
    }

    #[inline(always)]
    fn ramp(setup: &TextureGradients<S>) -> Option<&Gradient> {
        match &setup.gradients {
            Gradients::Packed(gradient) => Some(gradient),
            _ => None,
        }
    }
}
