//! Texels that are mixed of four neighbours.

use super::texels::{TexelPath, Texels};
use crate::color::{Color, Mixer};
use crate::math::hints::{keep_rolled, opaque};

/// Texels mixed of the four around a point, so that a magnified picture is smooth. (OpenGL: `GL_LINEAR` as magnification filter, `GL_NEAREST`
/// as minification filter.) Wraps [`Texels`] of any kind without transparent ones, which are repeated or clamped as without it.
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray8, GrayColor};
/// use pinhole::{prelude::*, texture::{BilinearTexels, Texels}};
/// let picture = [[0, 32, 64, 96, 128, 160, 192, 224].map(Gray8::new); 8];
/// let texels = BilinearTexels::new(&picture);
/// let texture = Texture::new(texels); // `texture.at(..)` as of any texture
/// // At the centre of the second texel, and where the second and the third meet.
/// assert_eq!([3 << 28, 2 << 29].map(|u| texels.texel(u, 0).luma()), [32, 48]);
/// ```
///
/// **Definition.** The centre of a texel is half a texel from its left and upper edge, and shows the texel alone. Between four centres, the
/// shares of the right and of the lower texels are the distances from the left and from the upper centres, rounded to 1/32 in formats of 15 and
/// 16 bits and to 1/256 in others; the share of the lower right texel is their product, rounded alike. A channel is rounded once, to the
/// nearest level. A run of pixels along which u or v changes by a texel or more from a pixel to the next shows the nearest texels; in
/// [light at corners](crate::texture::Textured::lit) all pixels are mixed.
///
/// **Error** of a channel: half a level and 1/16 of the highest level, in other than 15 and 16 bits 1/128, if all four texels differ most;
/// `tests/shading/bilinear.rs` asserts it. Coordinates that are off by e texels add e times the difference of neighbours, so
/// [`Accuracy::Sixteenth`](crate::texture::Accuracy) suits large perspective faces.
///
/// **Price.** A pixel takes 23 instructions more than one of the nearest texel on an M3 and, for each texel that is met along a row,
/// 40 more: a floor magnified 5 to 28 times takes 31 in place of 8.5 a pixel, a room 63 in place of 29
/// (`tools/bench/run cells X5 R1 plain bilinear M3`).
///
/// **Mip levels** belong inside: `BilinearTexels::new(MipTexels::new(&picture))` of a [`MipPicture`](crate::texture::MipPicture) mixes where it is
/// magnified and shows its levels elsewhere. [`ColorKeyed`](crate::texture::ColorKeyed) texels cannot be mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BilinearTexels<S> {
    texels: S,
}

impl<S> BilinearTexels<S> {
    /// From texels without transparent ones.
    pub const fn new(texels: S) -> Self {
        Self { texels }
    }
}

/// One texel in 2⁻³² of a side of 2^`bits` texels; `bits` is 3 … 8; any other overflows nothing.
#[inline(always)]
const fn texel_of(bits: u32) -> u32 {
    1 << (32u32.wrapping_sub(bits) & 31)
}

/// Whether the magnitude of a wrapping difference is below `texel`.
#[inline(always)]
const fn is_below(difference: u32, texel: u32) -> bool {
    difference.wrapping_add(texel - 1) < (texel << 1).wrapping_sub(1)
}

/// How far a coordinate is behind the centre of its texel, a share of the next texel.
#[inline(always)]
const fn share<C: Color>(coordinate: u32, bits: u32) -> u32 {
    coordinate << (bits & 31) >> (32 - C::SHARE_BITS)
}

impl<C: Color, S: Texels<Color = C, Ink = C>> Texels for BilinearTexels<S> {
    type Color = C;
    type Ink = C;
    type FastPath = Self;
    const WIDE: bool = S::WIDE;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.texels.size_bits()
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        let [a, b] = Self::lead(self);
        Self::along(*self, [0; 2], |at| at)([u.wrapping_sub(a), v.wrapping_sub(b)])
    }
}

impl<C: Color, S: Texels<Color = C, Ink = C>> TexelPath<Self> for BilinearTexels<S> {
    const HAS_COPIES: bool = S::FastPath::HAS_COPIES;
    const IS_FILTERED: bool = true;

    #[inline(always)]
    fn along(
        this: Self,
        [du, dv]: [u32; 2],
        coordinates: impl Fn([u32; 2]) -> [u32; 2] + Copy,
    ) -> impl FnMut([u32; 2]) -> C {
        let (texels, [w, h], lead) = (this.texels, this.texels.size_bits(), Self::lead(&this));
        let is_magnified = is_below(du, texel_of(w)) && is_below(dv, texel_of(h));
        let columns = |bits: u32| u32::MAX << (32u32.wrapping_sub(bits) & 31);
        // No cell has the lowest bit.
        let (mask, mut last) = (opaque(C::MASK), 1);
        let mut mix = C::bilinear([C::from_bits(0); 4], mask);
        move |numbers| {
            let [u, v] = coordinates(numbers);
            keep_rolled();
            if !is_magnified {
                let [a, b] = lead;
                return texels.texel(u.wrapping_add(a), v.wrapping_add(b));
            }
            let cell = u & columns(w) | (v & columns(h)) >> 16;
            if last != cell {
                last = cell;
                // Otherwise LLVM keeps v in a register of its own from pixel to pixel.
                let [u, v] = coordinates(opaque(numbers));
                let (right, below) = (u.wrapping_add(texel_of(w)), v.wrapping_add(texel_of(h)));
                let at = [(u, v), (right, v), (u, below), (right, below)];
                mix = C::bilinear(at.map(|(u, v)| texels.texel(u, v)), mask);
            }
            mix([share::<C>(u, w), share::<C>(v, h)])
        }
    }

    #[inline(always)]
    fn lead(this: &Self) -> [u32; 2] {
        // Half of a texel and, so that shares are rounded to nearest, half of a step less.
        this.texels.size_bits().map(|bits| (texel_of(bits) >> 1) - (texel_of(bits) >> C::SHARE_BITS >> 1))
    }

    #[inline(always)]
    fn covered_by(this: &Self, covered: i32) -> Self {
        Self { texels: S::FastPath::covered_by(&this.texels, covered) }
    }
}

defmt_format!([S] BilinearTexels<S>, self, "texels mixed of four");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use embedded_graphics_core::pixelcolor::{Bgr555, Gray8, Rgb888};

    /// Where a pixel is a texel or more from the next, it is the nearest one.
    fn nearest_far_apart<C: Color>(random: &mut Random) {
        let picture: [[C; 8]; 16] = [[(); 8]; 16].map(|row| row.map(|()| C::from_bits(random.bits() >> 8)));
        let (plain, mixed) = (&picture, BilinearTexels::new(&picture));
        for _ in 0..500 {
            let ([u, v], [a, b]) = ([random.bits(), random.bits()], BilinearTexels::lead(&mixed));
            for step in [[1 << 29, 0], [0, (1u32 << 28).wrapping_neg()]] {
                let nearest =
                    BilinearTexels::along(mixed, step, |at| at)([u.wrapping_sub(a), v.wrapping_sub(b)]);
                assert!(nearest == plain.texel(u, v));
            }
        }
    }

    #[test]
    fn pixels_that_are_a_texel_apart_show_the_nearest_texel() {
        let random = &mut Random(17);
        nearest_far_apart::<Bgr555>(random);
        nearest_far_apart::<Gray8>(random);
        nearest_far_apart::<Rgb888>(random);
    }
}
