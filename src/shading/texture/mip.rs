//! Mip levels: texels with reduced copies of their picture.

use super::texels::{index, side_bits, TexelPath, Texels};
use crate::color::Color;
use crate::math::hints::opaque;
use embedded_graphics_core::pixelcolor::PixelColor;

/// Texels with mip levels: a picture and its reduced copies, so that a floor does not sparkle towards the horizon. (Williams,
/// *Pyramidal parametrics*, 1983; OpenGL: `NEAREST_MIPMAP_NEAREST`.)
///
/// Wraps [`Texels`] of twice as many rows as the picture has, at most 256: their lower half is the picture, their upper half has the copies.
/// [`MipPicture`] makes and holds both, and is the fastest; [`IndexedTexels`](crate::texture::IndexedTexels) of both take less flash.
/// Everything else, such as texture coordinates, light and fog, is as with the picture alone.
///
/// **Levels.** Level n has a row for each 2ⁿ rows of the picture, and all of its columns, each the mean of 2ⁿ columns about it: a pixel then
/// takes no instruction more than without levels. Row i of level n is row (2·i + 1)·2ⁿ⁻¹ − 1 of the upper half. Means wrap around the
/// picture's left and right edge, because it repeats.
///
/// **Error.** A triangle whose coordinates are [linear](crate::texture::Texture) on the screen has one level, otherwise each run of
/// pixels has that of the pixel after it. With c texels from a pixel to the next, in u or v, to the right or down, whichever is most, a pixel
/// shows a level n with log₂ c − 1.5 ≤ n ≤ log₂ c + 2; at c above half of the picture, any level. On a face seen nearly edge-on, where c differs
/// several times between neighbours, single pixels were seen to show up to 2 levels more. For other faces `tests/shading/mips.rs` asserts these bounds, which are met
/// to 1.25 and 1.55. On a floor to the horizon, the error of pixels with more than one texel is 17.7 of 255 (root mean square, against
/// 64 samples a pixel) in place of 29.2 without levels.
///
/// **Price.** The copies take as much flash as the picture, and code 0.9 KB on an M3. There, a run of pixels takes 100 instructions
/// more, a small face 75: 5 % of a torus of 1000 triangles, 14 to 33 % of floors and 23 % of a room (`tools/bench/run cells X1 X2 X3 X4 R1 plain mip M3`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MipTexels<S> {
    texels: S,
    /// The binary logarithm of the number of texels that a pixel covers, in 2⁻¹⁶.
    covered: i32,
}

impl<S> MipTexels<S> {
    /// From a [`MipPicture`] by reference, or other texels whose upper half has the reduced copies already.
    pub const fn new(texels: S) -> Self {
        Self { texels, covered: 0 }
    }
}

impl<S: Copy> MipTexels<S> {
    /// These texels where a pixel covers 2^(`covered`/2¹⁶) texels along each axis: those of the reduced copy to show. Shaders choose it
    /// for each triangle and for each run of pixels.
    #[must_use]
    #[inline(always)]
    pub const fn covered_by(&self, covered: i32) -> Self {
        Self { covered, ..*self }
    }
}

impl<S: Texels> MipTexels<S> {
    /// The mask and the offset of the rows of the copy to show, as [`TexelPath::finder_of_rows`] takes them.
    #[inline(always)]
    fn rows(&self) -> [u32; 2] {
        let [_, bits] = self.texels.size_bits(); // 3 … 8
        let last = (bits as i32) - 1;
        let above = 32u32.wrapping_sub(bits); // the bits below those of a row: 24 … 29
        match self.covered >> 16 {
            ..=0 => [u32::MAX, 1 << 31],
            copy => {
                let copy = copy.min(last) as u32;
                [u32::MAX << ((above + copy) & 31), ((1 << copy >> 1) - 1) << (above & 31)]
            }
        }
    }
}

/// A picture of `W` columns and `H` rows, 8 … 256 and 8 … 128, and its reduced copies: the fastest texels for [`MipTexels`].
///
/// ```
/// use embedded_graphics::pixelcolor::{Gray8, GrayColor};
/// use pinhole::{prelude::*, texture::{MipPicture, MipTexels, Texels}};
/// // Black and white rows in turn.
/// let picture = core::array::from_fn(|row| [Gray8::new(255 * (row % 2) as u8); 8]);
/// let rows: MipPicture<Gray8, 8, 8> = MipPicture::build(picture);
/// let texture = Texture::new(MipTexels::new(&rows)); // `texture.at(..)` as of any texture
/// // The lowest row, where a pixel covers one texel, and where it covers two.
/// let texel = |covered| MipTexels::new(&rows).covered_by(covered).texel(0, u32::MAX).luma();
/// assert_eq!([texel(0), texel(1 << 16)], [255, 128]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MipPicture<C, const W: usize, const H: usize>([[[C; W]; H]; 2]);

impl<C: Color, const W: usize, const H: usize> MipPicture<C, W, H> {
    /// The reduced copies of [`build`](Self::build).
    pub const fn copies(&self) -> &[[C; W]; H] {
        let Self([copies, _]) = self;
        copies
    }

    /// From [`copies`](Self::copies), and the picture that they were made from.
    pub const fn new(copies: [[C; W]; H], picture: [[C; W]; H]) -> Self {
        Self([copies, picture])
    }

    /// Computes the reduced copies of a picture, each channel rounded to nearest. Takes time in proportion to W·H², so that firmware had better
    /// contain [`copies`](Self::copies) that a build script computed. A side out of range does not compile.
    pub fn build(picture: [[C; W]; H]) -> Self {
        const { sides::<W, H>() };
        let mut copies = picture;
        for (number, row) in (1..).zip(&mut copies) {
            for (column, texel) in row.iter_mut().enumerate() {
                *texel = mean(&picture, number, column);
            }
        }
        Self([copies, picture])
    }
}

/// Binary logarithms of the width and of twice the height, as the copies lie above the picture. Wrong sides do not compile.
const fn sides<const W: usize, const H: usize>() -> [u32; 2] {
    assert!(
        H <= 128,
        "a picture with mip levels has 8, 16, 32, 64 or 128 rows, as its copies take as many more"
    );
    [side_bits(W), side_bits(H) + 1]
}

/// The copies, and below them the picture.
impl<C: PixelColor, const W: usize, const H: usize> Texels for &MipPicture<C, W, H> {
    type Color = C;
    type Ink = C;
    type FastPath = Self;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        const { sides::<W, H>() }
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        Self::finder_of_rows(self, [u32::MAX >> 1, v & 1 << 31])([u, v << 1])
    }
}

impl<C: PixelColor, const W: usize, const H: usize> TexelPath<Self> for &MipPicture<C, W, H> {
    /// Costs no more than one picture: the rows from `offset` on are an array of their own.
    #[inline(always)]
    fn finder_of_rows(picture: Self, [mask, offset]: [u32; 2]) -> impl Fn([u32; 2]) -> C + Copy {
        let [_, rows] = picture.size_bits();
        let MipPicture(both @ [first, _]) = picture;
        let below = both.as_flattened().get(index(offset, rows)..).and_then(|rows| rows.first_chunk());
        let texels: &[[C; W]; H] = below.unwrap_or(first);
        // A row's lowest bit is at W in an index.
        let rows = opaque((mask >> (32 - rows - const { side_bits(W) })) as usize & ((H - 1) * W));
        move |[u, v]| {
            let [w, h] = const { [side_bits(W), side_bits(H)] };
            let row = (v >> (32 - w - h)) as usize & (rows & (W * H - 1)); // as in `finder` of one picture
            texels.as_flattened()[row | index(u, w)]
        }
    }
}

/// A texel of the reduced copies, in their row `number` − 1. No level needs the last row, in which `half` is the picture's height.
fn mean<C: Color, const W: usize>(picture: &[[C; W]], number: usize, column: usize) -> C {
    let half = 1 << (number.trailing_zeros() & 31); // half of 2ⁿ: 1 … 128
    let (first, mut sum) = (number - half, [0u32; 3]); // at most 256 · 512 · 255
    for row in picture.iter().cycle().skip(first).take(2 * half) {
        // From `half` columns to the left to as many to the right; of these two, half.
        for x in 0..=2 * half {
            let texel = row.get((column + x).wrapping_sub(half) & (W - 1)); // W is a power of two
            let channels = texel.map_or([0; 3], |texel| texel.channels());
            let weight = if x == 0 || x == 2 * half { 1 } else { 2 };
            for (sum, channel) in sum.iter_mut().zip(channels) {
                *sum += weight * u32::from(channel);
            }
        }
    }
    let shift = 2 * half.trailing_zeros() + 3; // 2·half rows times 4·half
    C::from_channels(sum.map(|sum| ((sum + (1 << shift >> 1)) >> shift) as u8))
}

impl<S: Texels> Texels for MipTexels<S> {
    type Color = S::Color;
    type Ink = S::Ink;
    type FastPath = Self;
    const WIDE: bool = S::WIDE;
    const LEVEL_BITS: u32 = S::LEVEL_BITS;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        let [w, h] = self.texels.size_bits();
        [w, h.wrapping_sub(1)]
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> S::Ink {
        let [mask, offset] = self.rows();
        self.texels.texel(u, (v >> 1) & mask | offset)
    }

    #[inline(always)]
    fn lit_texel(&self, u: u32, v: u32, level: u32) -> S::Ink
    where
        S::Color: Color,
    {
        let [mask, offset] = self.rows();
        self.texels.lit_texel(u, (v >> 1) & mask | offset, level)
    }
}

impl<S: Texels> TexelPath<Self> for MipTexels<S> {
    const HAS_COPIES: bool = true;

    #[inline(always)]
    fn finder(this: Self) -> impl Fn([u32; 2]) -> S::Ink + Copy {
        S::FastPath::finder_of_rows(this.texels, this.rows())
    }

    #[inline(always)]
    fn covered_by(this: &Self, covered: i32) -> Self {
        this.covered_by(covered)
    }
}

defmt_format!([S] MipTexels<S>, self, "texels with mip levels, covered 2^({=i32}/65536) by a pixel", self.covered);

defmt_format!([C, const W: usize, const H: usize] MipPicture<C, W, H>, self, "{=usize} x {=usize} texels with mip levels", W, H);

#[cfg(test)]
mod tests {
    /// As the compiler says it of a picture: the limit is that of its rows, not that of a texture.
    #[test]
    #[should_panic(expected = "8, 16, 32, 64 or 128 rows")]
    fn a_picture_of_256_rows_is_refused_for_its_rows() {
        super::sides::<16, 256>();
    }
}
