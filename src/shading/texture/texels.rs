//! Where the texels of a texture come from.

use crate::color::{Color, InkKind, Unmixed};
use crate::math::hints::opaque;
use embedded_graphics_core::pixelcolor::PixelColor;

/// Texels in rows: a texture's picture, or a formula. Both sides have a power of two of texels, so that repeating the picture
/// takes no instruction.
///
/// `&[[C; W]; H]` has its size in its type, which is the fastest; [`TexelSlice`] has it at run time;
/// [`IndexedTexels`](crate::texture::IndexedTexels) looks colours up in a palette. A formula implements the trait, too:
///
/// ```
/// use embedded_graphics::pixelcolor::BinaryColor;
/// use pinhole::texture::Texels;
/// /// A chessboard of 8 × 8 texels.
/// #[derive(Clone, Copy)]
/// struct Chessboard;
/// impl Texels for Chessboard {
///     type Color = BinaryColor;
///     type Ink = BinaryColor;
///     type FastPath = ();
///     fn size_bits(&self) -> [u32; 2] {
///         [3, 3]
///     }
///     fn texel(&self, u: u32, v: u32) -> BinaryColor {
///         BinaryColor::from((u ^ v) >> 29 & 1 == 0)
///     }
/// }
/// assert_eq!(Chessboard.texel(0, 1 << 29), BinaryColor::Off);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a source of texels",
    label = "not `Texels`",
    note = "pass `&[[C; W]; H]`, a `TexelSlice` or `IndexedTexels` to `Texture::new`, or implement `Texels` for a type of your own"
)]
pub trait Texels: Copy {
    /// The colour of a texel.
    type Color: PixelColor;

    /// A texel: its colour, or `Option<Self::Color>` if some texels are transparent.
    type Ink: Unmixed<Self::Color>;

    /// Write `()`: only texels of this crate have faster twins of [`texel`](Self::texel).
    type FastPath: TexelPath<Self>;

    /// The binary logarithms of the numbers of columns and rows: 3 … 8 each.
    fn size_bits(&self) -> [u32; 2];

    /// The texel that holds a point: `u` from the left and `v` from the top, in 2⁻³² of the width and of the height. The texel's
    /// column is `u >> (32 − bits)`, rounded down.
    fn texel(&self, u: u32, v: u32) -> Self::Ink;

    /// Whether u and v take 32 bits each. If not, they have 16 bits each and lie in one word, which saves two instructions a pixel
    /// on a Cortex-M3.
    ///
    /// **Error.** In one word, coordinates are off by at most 37·2⁻¹⁶ of a side more, which is 1/27 texel of 64 and 1/6 of 256:
    /// 18 of these 37 by rounding, which adds up over at most 32 pixels, and 19 because the corners' coordinates are moved
    /// inwards, so that no pixel shows what lies beyond them. `tests/shading/textures.rs` asserts the bound, and meets 33.
    const WIDE: bool = false;

    /// The binary logarithm of the number of levels of light that [`lit_texel`](Self::lit_texel) takes: 1 … 8.
    const LEVEL_BITS: u32 = 8;

    /// The [`texel`](Self::texel) that holds a point, in `level`/(2^[`LEVEL_BITS`](Self::LEVEL_BITS) − 1) of full light, for
    /// [`Textured::lit`](crate::texture::Textured::lit). `level` is below 2^`LEVEL_BITS`. By default the texel's colour is
    /// [dimmed](Color::dim): override both to look it up in a table instead.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Gray8;
    /// use pinhole::texture::Texels;
    /// let picture = [[Gray8::new(200); 8]; 8];
    /// assert_eq!([255, 63].map(|level| (&picture).lit_texel(0, 0, level)), [200, 49].map(Gray8::new));
    /// ```
    #[inline(always)]
    fn lit_texel(&self, u: u32, v: u32, level: u32) -> Self::Ink
    where
        Self::Color: Color,
    {
        // 0 … 256, at most ½ from level·256/255 if there are 256 levels.
        let level = (level + (level >> 7)) as u16;
        self.texel(u, v).map(|color| color.dim(level))
    }
}

/// The fast paths of the texels `S`: texels equal to those of [`Texels::texel`], found in less time. `()` has none.
pub trait TexelPath<S: Texels> {
    /// [`Texels::texel`] as a function for loops, of `[u, v]`. Override it where what all pixels of a triangle need can be computed once.
    #[inline(always)]
    fn finder(texels: S) -> impl Fn([u32; 2]) -> S::Ink + Copy {
        move |[u, v]| texels.texel(u, v)
    }

    /// Whether a pixel mixes several texels, as of [`BilinearTexels`](crate::texture::BilinearTexels): shaders then call
    /// [`along`](Self::along) in place of [`finder`](Self::finder).
    const IS_FILTERED: bool = false;

    /// [`Texels::texel`] for pixels that follow each other, at `coordinates` of numbers that are linear along a run, which have
    /// [`lead`](Self::lead) subtracted and change by `step`. Override it where neighbours have something in common that takes time to
    /// compute.
    #[inline(always)]
    fn along(
        texels: S,
        step: [u32; 2],
        coordinates: impl Fn([u32; 2]) -> [u32; 2] + Copy,
    ) -> impl FnMut([u32; 2]) -> S::Ink {
        let _ = step;
        move |numbers| {
            let [u, v] = coordinates(numbers);
            texels.texel(u, v)
        }
    }

    /// What [`along`](Self::along) has subtracted from coordinates, once for each run of pixels.
    #[inline(always)]
    fn lead(texels: &S) -> [u32; 2] {
        let _ = texels;
        [0; 2]
    }

    /// Whether there are reduced copies of the picture, as in [`MipTexels`](crate::texture::MipTexels), for faces on which a pixel covers
    /// more than one texel.
    const HAS_COPIES: bool = false;

    /// The texels where a pixel covers 2^(`covered`/2¹⁶) texels along each axis: those of the reduced copy to show, if there are any.
    /// Shaders call it for each triangle and for each run of pixels.
    #[inline(always)]
    fn covered_by(texels: &S, covered: i32) -> S {
        let _ = covered;
        *texels
    }

    /// [`finder`](Self::finder) of texels at `u` and at `v/2 & mask | offset`, of `[mask, offset]`: a copy's rows in a picture of
    /// twice the height. Override it where such rows are found faster.
    #[inline(always)]
    fn finder_of_rows(texels: S, [mask, offset]: [u32; 2]) -> impl Fn([u32; 2]) -> S::Ink + Copy {
        let texel = Self::finder(texels);
        move |[u, v]| texel([u, (v >> 1) & mask | offset])
    }
}

impl<S: Texels> TexelPath<S> for () {}

/// The index of the column or row that holds `coordinate`, in 2⁻³² of a side with 2^`bits` columns or rows; `bits` is 1 … 31.
#[inline(always)]
pub(super) const fn index(coordinate: u32, bits: u32) -> usize {
    (coordinate >> (32u32.wrapping_sub(bits) & 31)) as usize // below 2^bits
}

/// The binary logarithm of a side, which the compiler checks.
pub(super) const fn side_bits(side: usize) -> u32 {
    assert!(
        side.is_power_of_two() && side >= 8 && side <= 256,
        "a texture's side is 8, 16, 32, 64, 128 or 256"
    );
    side.trailing_zeros()
}

impl<C: PixelColor, const W: usize, const H: usize> Texels for &[[C; W]; H] {
    type Color = C;
    type Ink = C;
    type FastPath = Self;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        const { [side_bits(W), side_bits(H)] }
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        let [w, h] = self.size_bits();
        // The remainders change nothing; they tell the compiler that both indices exist.
        self[index(v, h) % H][index(u, w) % W]
    }
}

impl<C: PixelColor, const W: usize, const H: usize> TexelPath<Self> for &[[C; W]; H] {
    #[inline(always)]
    fn finder(texels: Self) -> impl Fn([u32; 2]) -> C + Copy {
        let rows = opaque((H - 1) * W);
        move |[u, v]| {
            let [w, h] = const { [side_bits(W), side_bits(H)] };
            // Bits of the mask that are not known may be those of the column, so the sum of both is not split in two, and the column is
            // shifted and added by one instruction.
            let row = (v >> (32 - w - h)) as usize & (rows & (W * H - 1));
            texels.as_flattened()[row | index(u, w)]
        }
    }
}

/// Why texels do not make a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum TextureError {
    /// A side is not 8, 16, 32, 64, 128 or 256 texels.
    Side {
        /// The given number of columns or rows.
        side: usize,
    },
    /// There are fewer texels than width times height.
    Texels {
        /// How many elements of the slice the texture needs.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// The palette has fewer colours than texels can name.
    Palette {
        /// How many colours the texture needs.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// The exponent of the texture coordinates' unit is outside of −15 … 0.
    Exponent {
        /// The given exponent.
        exponent: i8,
    },
}

impl core::fmt::Display for TextureError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Side { side } => {
                write!(f, "a side of {side} texels: resize the picture to 8, 16, 32, 64, 128 or 256 a side")
            }
            Self::Texels { needed, given } => {
                write!(f, "the slice has {given} elements, but a texture of this size needs {needed}")
            }
            Self::Palette { needed, given } => {
                write!(f, "the palette has {given} colours, but the texels can name {needed}: append some")
            }
            Self::Exponent { exponent } => {
                write!(f, "texture coordinates in 2^{exponent} of a side: the exponent must be -15 to 0")
            }
        }
    }
}

impl core::error::Error for TextureError {}

/// The binary logarithms of width and height.
pub(super) const fn checked_bits(width: usize, height: usize) -> Result<[u32; 2], TextureError> {
    let sides = [width, height];
    let mut i = 0;
    while i < 2 {
        let side = sides[i];
        if !side.is_power_of_two() || side < 8 || side > 256 {
            return Err(TextureError::Side { side });
        }
        i += 1;
    }
    Ok([width.trailing_zeros(), height.trailing_zeros()])
}

/// Texels in a slice, row by row, the upper row first, with a size that is known at run time. A pixel takes two to four
/// instructions more than with `&[[C; W]; H]`.
///
/// ```
/// use embedded_graphics::pixelcolor::Gray8;
/// use pinhole::texture::{TexelSlice, Texels};
/// let picture: Vec<Gray8> = (0..8 * 16).map(Gray8::new).collect();
/// let texels = TexelSlice::new(&picture, 8, 16)?;
/// // Half of the width, a quarter of the height.
/// assert_eq!(texels.texel(1 << 31, 1 << 30), Gray8::new(4 * 8 + 4));
/// # Ok::<(), pinhole::texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelSlice<'t, C> {
    texels: &'t [C],
    bits: [u32; 2],
    /// The slice's first colour: the fallback of a look-up that never fails.
    first: C,
}

impl<'t, C: PixelColor> TexelSlice<'t, C> {
    /// Texels of a picture of `width` columns and `height` rows.
    ///
    /// # Errors
    ///
    /// [`TextureError::Side`] if a side is not 8, 16, 32, 64, 128 or 256, and [`TextureError::Texels`] if the slice is shorter
    /// than `width * height`.
    pub const fn new(texels: &'t [C], width: usize, height: usize) -> Result<Self, TextureError> {
        let bits = match checked_bits(width, height) {
            Ok(bits) => bits,
            Err(error) => return Err(error),
        };
        let (needed, given) = (width * height, texels.len());
        match texels.first() {
            Some(&first) if given >= needed => Ok(Self { texels, bits, first }),
            _ => Err(TextureError::Texels { needed, given }),
        }
    }
}

impl<C: PixelColor> Texels for TexelSlice<'_, C> {
    type Color = C;
    type Ink = C;
    type FastPath = ();

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.bits
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        let [w, h] = self.bits;
        let texel = self.texels.get(index(v, h) << (w & 31) | index(u, w));
        texel.copied().unwrap_or(self.first)
    }
}

defmt_format!([C] TexelSlice<'_, C>, self, "{=u32} x {=u32} texels", 1 << self.bits[0], 1 << self.bits[1]);
