//! A palette in several levels of light.

use super::indexed::IndexedTexels;
use super::mapping::Texture;
use super::texels::Texels;
use crate::color::Color;
use crate::shading::levels::mixture;
use core::array::from_fn;
use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888, RgbColor};

/// A palette in `ROWS` levels of light, computed once: the colours of a texture with a palette in any light, without a
/// multiplication. 16 colours in 32 levels take 1 KB as `Rgb565`. (Quake's *colormap* is such a table: Abrash, *Graphics
/// Programming Black Book*, chapter 68.)
///
/// `ROWS` is 2, 4, 8 … 256. Row 0 has no light, the last row full light, and a level of light is rounded to the nearest row: it
/// is off by at most 1/(2·(`ROWS` − 1)) of full light.
///
/// - **Light by face** costs no instruction a pixel: [`Texture::with_palette`] takes the [`row`](Self::row) of the face's level.
/// - **Light by vertex**, linear on the screen: [`IndexedTexels::with_lit_palette`], and [`Textured::lit`](crate::texture::Textured::lit) for
///   each face.
/// - **Fog** by face or vertex: rows from the fog's colour to the palette's, by [`in_fog`](Self::in_fog).
///
/// ```
/// use embedded_graphics::{pixelcolor::{Rgb565, Rgb888}, prelude::*};
/// use pinhole::{color::Color, texture::{IndexedTexels, LitPalette, Texture}};
/// let palette = LitPalette::<Rgb565, 2, 32>::new(&[Rgb888::BLACK, Rgb888::WHITE]); // before the first frame
/// assert_eq!(palette.row(0), &[Rgb565::BLACK; 2]);
/// assert_eq!(palette.row(256), &[Rgb565::BLACK, Rgb565::WHITE]);
/// assert_eq!(palette.row(99)[1], Rgb565::new(12, 24, 12));
///
/// let texels = IndexedTexels::<_, 1>::new(&[0x55; 8], 8, 8, palette.row(256))?;
/// // For a face whose light is 99/256.
/// let texture = Texture::new(texels).with_palette(palette.row(99));
/// let by_face = texture.at([[0, 0], [128, 0], [0, 128]]);
/// // For a face with light of its own at each corner.
/// let texture = Texture::new(texels.with_lit_palette(&palette));
/// let by_vertex = texture.at([[0, 0], [128, 0], [0, 128]]).lit([256, 99, 0]);
/// # let _ = (by_face, by_vertex);
/// # Ok::<(), pinhole::texture::TextureError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LitPalette<C, const COLORS: usize, const ROWS: usize>([[C; COLORS]; ROWS]);

impl<C, const COLORS: usize, const ROWS: usize> LitPalette<C, COLORS, ROWS> {
    /// The binary logarithm of the number of rows, which the compiler checks: 1 … 8.
    const ROW_BITS: u32 = {
        assert!(
            ROWS.is_power_of_two() && ROWS >= 2 && ROWS <= 256,
            "a palette has 2, 4, 8, 16, 32, 64, 128 or 256 levels of light"
        );
        ROWS.trailing_zeros()
    };

    /// Rows of any colours, from no light to full light, or from all fog to none. It can be a constant.
    pub const fn from_rows(rows: [[C; COLORS]; ROWS]) -> Self {
        let _ = Self::ROW_BITS;
        Self(rows)
    }

    /// The row nearest to a level of light: 0 … 256 (more counts as 256).
    #[inline]
    pub fn row(&self, level: u16) -> &[C; COLORS] {
        let rows = 1usize << Self::ROW_BITS;
        let row = (usize::from(level.min(256)) * (rows - 1) + 128) >> 8; // up to rows − 1
        &self.0[row % ROWS] // the remainder changes nothing; it tells the compiler that the row exists
    }

    /// A row by its number, modulo the number of rows.
    #[inline(always)]
    const fn numbered(&self, row: u32) -> &[C; COLORS] {
        &self.0[row as usize % ROWS]
    }
}

impl<C: Color, const COLORS: usize, const ROWS: usize> LitPalette<C, COLORS, ROWS> {
    /// The colours of the target nearest to each colour at 0/(`ROWS` − 1), 1/(`ROWS` − 1) … of its light; halves are rounded up.
    pub fn new(palette: &[Rgb888; COLORS]) -> Self {
        let steps = (1u32 << Self::ROW_BITS) - 1;
        Self(from_fn(|row| {
            palette.each_ref().map(|&color| mixture(color, row as u32, Rgb888::BLACK, 0, steps))
        }))
    }

    /// A palette that fades into fog: row i has i/(`ROWS` − 1) of the palette's colours and the rest of the fog's colour, so row
    /// 0 is fog alone; halves are rounded up. [`row`](Self::row) takes the factor of
    /// [`VertexFog::face_factor`](crate::fog::VertexFog::face_factor), [`Textured::lit`](crate::texture::Textured::lit) the factors of
    /// [`VertexFog::factor`](crate::fog::VertexFog::factor).
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Rgb565, Rgb888}, prelude::*};
    /// use pinhole::texture::LitPalette;
    /// let palette = LitPalette::<Rgb565, 2, 32>::in_fog(&[Rgb888::RED, Rgb888::BLACK], Rgb888::WHITE);
    /// assert_eq!(palette.row(0), &[Rgb565::WHITE; 2]);
    /// assert_eq!(palette.row(256), &[Rgb565::RED, Rgb565::BLACK]);
    /// ```
    pub fn in_fog(palette: &[Rgb888; COLORS], fog: Rgb888) -> Self {
        let steps = ROWS as u32 - 1; // 1 … 255: the compiler checks the number of rows
        Self::from_rows(from_fn(|row| {
            let row = row as u32;
            palette.each_ref().map(|&color| mixture(color, row, fog, steps.saturating_sub(row), steps))
        }))
    }

    /// A palette of texels that emit light of their own, such as the digits of a dial: row i has i/(`ROWS` − 1) of the palette's
    /// colours plus `emission`, so row 0 is the emission alone; channels saturate at full, halves are rounded up. The emission of
    /// a colour that emits nothing is black.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Rgb565, Rgb888}, prelude::*};
    /// use pinhole::texture::LitPalette;
    /// let palette = LitPalette::<Rgb565, 2, 32>::emitting(&[Rgb888::BLUE, Rgb888::WHITE], &[Rgb888::RED, Rgb888::BLACK]);
    /// assert_eq!(palette.row(0), &[Rgb565::RED, Rgb565::BLACK]);
    /// assert_eq!(palette.row(256), &[Rgb565::MAGENTA, Rgb565::WHITE]);
    /// ```
    pub fn emitting(palette: &[Rgb888; COLORS], emission: &[Rgb888; COLORS]) -> Self {
        let steps = ROWS as u32 - 1; // 1 … 255: the compiler checks the number of rows
        Self::from_rows(from_fn(|row| {
            let mut emission = emission.iter();
            palette.each_ref().map(|&color| {
                let emission = emission.next().copied().unwrap_or(Rgb888::BLACK);
                mixture(color, row as u32, emission, steps, steps)
            })
        }))
    }
}

impl<'t, C: PixelColor, const BITS: u32> Texture<IndexedTexels<'t, C, BITS>> {
    /// This texture with the colours of another palette, such as a [row](LitPalette::row) of a [`LitPalette`]. A palette with fewer
    /// than 2^`BITS` colours does not compile.
    #[must_use]
    #[inline]
    pub const fn with_palette<const COLORS: usize>(self, palette: &'t [C; COLORS]) -> Self {
        Self { texels: self.texels.with_colors(palette), ..self }
    }
}

/// Texels of `BITS` bits each, 1, 2, 4 or 8, that name colours of a [`LitPalette`]: for light by vertex.
/// [`IndexedTexels::with_lit_palette`] makes them. Without [`Textured::lit`](crate::texture::Textured::lit) they show full light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LitIndexedTexels<'t, C, const BITS: u32, const COLORS: usize, const ROWS: usize> {
    texels: IndexedTexels<'t, C, BITS>,
    palette: &'t LitPalette<C, COLORS, ROWS>,
}

impl<'t, C: PixelColor, const BITS: u32> IndexedTexels<'t, C, BITS> {
    /// These texels in the colours of a palette in several levels of light. A palette with fewer than 2^`BITS` colours does not
    /// compile.
    pub const fn with_lit_palette<const COLORS: usize, const ROWS: usize>(
        self,
        palette: &'t LitPalette<C, COLORS, ROWS>,
    ) -> LitIndexedTexels<'t, C, BITS, COLORS, ROWS> {
        LitIndexedTexels { texels: self.with_colors(palette.numbered(u32::MAX)), palette }
    }
}

impl<C: PixelColor, const BITS: u32, const COLORS: usize, const ROWS: usize> Texels
    for LitIndexedTexels<'_, C, BITS, COLORS, ROWS>
{
    type Color = C;
    type Ink = C;

    #[inline(always)]
    fn size_bits(&self) -> [u32; 2] {
        self.texels.size_bits()
    }

    #[inline(always)]
    fn texel(&self, u: u32, v: u32) -> C {
        self.texels.texel(u, v)
    }

    const LEVEL_BITS: u32 = LitPalette::<C, COLORS, ROWS>::ROW_BITS;

    #[inline(always)]
    fn lit_texel(&self, u: u32, v: u32, level: u32) -> C {
        // The remainder changes nothing, as there are 2^BITS colours or more.
        self.palette.numbered(level)[self.texels.index_at(u, v) as usize % COLORS]
    }
}

defmt_format!(
    [C, const COLORS: usize, const ROWS: usize] LitPalette<C, COLORS, ROWS>, self,
    "{=usize} colours in {=usize} levels of light", COLORS, ROWS
);

defmt_format!(
    [C, const BITS: u32, const COLORS: usize, const ROWS: usize] LitIndexedTexels<'_, C, BITS, COLORS, ROWS>, self,
    "{} of {}",
    self.texels, self.palette
);
