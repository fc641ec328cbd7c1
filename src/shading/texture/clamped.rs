//! Texels of a picture that does not repeat.

use super::texels::{TexelPath, Texels};
use crate::color::Color;
use crate::math::num::leading_zeros;

/// Texels whose edge continues without end, where other [`Texels`] repeat: a coordinate beyond the picture, below 0 too, shows the
/// nearest texel of the edge. [`Texture::clamped_at`](crate::texture::Texture::clamped_at) makes it. (OpenGL: `CLAMP_TO_EDGE`.)
///
/// Costs two comparisons more for each coordinate of a pixel than a picture that repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClampedTexels<S> {
    texels: S,
    /// How many widths and heights of the picture the coordinates of [`Texels::texel`] span, as binary logarithms: see [`span`].
    sides: [u8; 2],
}

/// The binary logarithm of the number of sides that 32 bits span, 1 … 17, for the coordinates of a face's corners, in 2^`unit` of
/// 2⁻³² of the side. The picture begins in the middle of the span, at coordinate 0; coordinates from 2³¹ up are negative.
///
/// Both halves of the span reach at least twice as far as the corners, so that no error of interpolation leaves it. It does not
/// reach farther than such errors need, because the fewer sides 32 bits span, the more of them a texel has.
#[inline(never)] // called for u and for v
pub(super) fn span(corners: [i16; 3], unit: u8) -> u8 {
    let magnitude = corners.iter().fold(0, |bits, &c| bits | (c ^ (c >> 15)) as u16); // −2ⁿ counts as 2ⁿ − 1
    let bits = 32 - leading_zeros(magnitude.into()); // 0 … 15
    (bits + 2 + i32::from(unit) - 32).max(1) as u8
}

impl<S: Texels> ClampedTexels<S> {
    pub(super) const fn new(texels: S, sides: [u8; 2]) -> Self {
        Self { texels, sides }
    }

    /// u and v in 2⁻³² of the picture's sides, for coordinates that span more.
    #[inline(always)]
    fn inside(&self, u: u32, v: u32) -> [u32; 2] {
        // The lead of texels that are not filtered is 0.
        let ([a, b], [c, d]) = (Self::lead(self), S::FastPath::lead(&self.texels));
        let [u, v] = self.led_inside([u.wrapping_sub(a), v.wrapping_sub(b)]);
        [u.wrapping_add(c), v.wrapping_add(d)]
    }

    /// [`inside`](Self::inside), of coordinates less [`TexelPath::lead`] on both sides.
    #[inline(always)]
    fn led_inside(&self, [u, v]: [u32; 2]) -> [u32; 2] {
        let ([w, h], [across, down]) = (self.sides, self.texels.size_bits());
        [clamped::<S>(u, w, across), clamped::<S>(v, h, down)]
    }
}

/// The point of the picture, of 2^`bits` texels a side, that is nearest to a coordinate in 2⁻³² of 2^`sides` sides, as a coordinate in 2⁻³²
/// of one side. Of [filtered](TexelPath::IS_FILTERED) texels, which are mixed with the next, the last texel has one point.
#[inline(always)]
const fn clamped<S: Texels>(coordinate: u32, sides: u8, bits: u32) -> u32 {
    let end = u32::MAX >> (sides & 31); // 2¹⁵ − 1 … 2³¹ − 1
    let last = if S::FastPath::IS_FILTERED { end - (end >> (bits & 31)) } else { end };
    let inside = match coordinate as i32 {
        i32::MIN..=-1 => 0,
        _ if coordinate > last => last,
        _ => coordinate,
    };
    inside << (sides & 31) // no bit is lost, and all texels have at least 2⁷ of such steps
}

impl<S: Texels> Texels for ClampedTexels<S> {
    type Color = S::Color;
    type Ink = S::Ink;
    type FastPath = Self;
    const WIDE: bool = true;
    const LEVEL_BITS: u32 = S::LEVEL_BITS;

    /// The binary logarithms of the numbers of texels that coordinates span: up to 25.
    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        let ([w, h], [across, down]) = (self.texels.size_bits(), self.sides);
        [w.wrapping_add(across as u32), h.wrapping_add(down as u32)]
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> S::Ink {
        let [u, v] = self.inside(u, v);
        self.texels.texel(u, v)
    }

    #[inline(always)]
    fn lit_texel(&self, u: u32, v: u32, level: u32) -> S::Ink
    where
        S::Color: Color,
    {
        let [u, v] = self.inside(u, v);
        self.texels.lit_texel(u, v, level)
    }
}

impl<S: Texels> TexelPath<Self> for ClampedTexels<S> {
    const HAS_COPIES: bool = S::FastPath::HAS_COPIES;
    const IS_FILTERED: bool = S::FastPath::IS_FILTERED;

    #[inline(always)]
    fn covered_by(this: &Self, covered: i32) -> Self {
        Self { texels: S::FastPath::covered_by(&this.texels, covered), ..*this }
    }

    #[inline(always)]
    fn along(
        this: Self,
        [du, dv]: [u32; 2],
        coordinates: impl Fn([u32; 2]) -> [u32; 2] + Copy,
    ) -> impl FnMut([u32; 2]) -> S::Ink {
        let [w, h] = this.sides; // 1 … 17
        S::FastPath::along(this.texels, [du << (w & 31), dv << (h & 31)], move |numbers| {
            this.led_inside(coordinates(numbers))
        })
    }

    #[inline(always)]
    fn lead(this: &Self) -> [u32; 2] {
        let ([u, v], [w, h]) = (S::FastPath::lead(&this.texels), this.sides);
        [u >> (w & 31), v >> (h & 31)]
    }
}

defmt_format!(
    [S] ClampedTexels<S>, self,
    "texels that do not repeat, for coordinates of 2^{=u8} widths and 2^{=u8} heights",
    self.sides[0], self.sides[1]
);
