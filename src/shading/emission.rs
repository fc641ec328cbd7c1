//! Light that faces emit themselves: a colour that is added after light.

use super::levels::mixture;
use super::{Flat, Gouraud, Lit, LitPalette, ShadeTable};
use crate::color::Color;
use crate::scene::FaceColors;
use core::array::from_fn;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

impl FaceColors<'_> {
    /// The colour of a face at a level of light, 0 … 256, and the light that it emits: [`color`](Self::color),
    /// [dimmed](Color::dim), plus [`emission`](Self::emission).
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Rgb565;
    /// use pinhole::mesh::FaceColors;
    /// let colors = FaceColors::new(&[[0, 0, 255]], &[0])?.with_emission(&[[255, 0, 0]])?;
    /// assert_eq!(colors.lit::<Rgb565>(0, 128), Rgb565::new(31, 0, 16));
    /// # Ok::<(), pinhole::mesh::MeshError>(())
    /// ```
    pub fn lit<C: From<Rgb888> + Color>(&self, face: usize, level: u16) -> C {
        let lit = self.color::<C>(face).dim(level);
        match self.emissions().is_empty() {
            true => lit,
            false => lit.emitting(self.emission(face)),
        }
    }
}

impl Flat {
    /// This colour plus `emission`, each channel saturating at full: the colour of a face that emits light of its own, such as a
    /// lamp or a display. Exact.
    ///
    /// Emission is not dimmed, so light comes first:
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Rgb888;
    /// use pinhole::shading::Flat;
    /// let glowing = |level| Flat::lit(Rgb888::new(200, 100, 40), level).emitting(Rgb888::new(90, 0, 0));
    /// assert_eq!(glowing(0), Flat::from(Rgb888::new(90, 0, 0)));
    /// assert_eq!(glowing(128), Flat::from(Rgb888::new(190, 50, 20)));
    /// assert_eq!(glowing(256), Flat::from(Rgb888::new(255, 100, 40)));
    /// ```
    #[must_use]
    pub fn emitting(self, emission: Rgb888) -> Self {
        let Self([r, g, b]) = self;
        // At most 255·2⁸ twice, below 2¹⁷.
        let sum = |own: u16, emission: u8| own.saturating_add(u16::from(emission) << 8).min(255 << 8);
        Self([sum(r, emission.r()), sum(g, emission.g()), sum(b, emission.b())])
    }
}

impl Lit {
    /// The shader of a face that emits light of its own: `emission` is added at each corner, each channel saturating at full, and
    /// the sums are interpolated. A channel that saturates at only some of the corners is darker between them than light plus
    /// emission would be.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb888, WebColors};
    /// use pinhole::shading::{Flat, Gouraud};
    /// let (levels, emission) = ([256, 128, 40], Rgb888::new(60, 0, 0)); // of Lambert::levels
    /// let face = Gouraud::lit(Rgb888::CSS_TEAL, levels).emitting(emission);
    /// assert_eq!(face, Gouraud::new(levels.map(|level| Flat::lit(Rgb888::CSS_TEAL, level).emitting(emission))));
    /// ```
    #[must_use]
    pub fn emitting(self, emission: Rgb888) -> Gouraud {
        let (color, levels) = self.parts();
        Gouraud::new(levels.map(|level| Flat::lit(color, level).emitting(emission)))
    }
}

impl<C: Color> ShadeTable<C> {
    /// A table for faces that emit light of their own: entry i is the colour of the target nearest to i/255 of `color` plus
    /// `emission`, each channel saturating at full; halves are rounded up. A face takes no more instructions than with
    /// [`new`](Self::new).
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888};
    /// use pinhole::shading::ShadeTable;
    /// let table = ShadeTable::<Gray8>::emitting(Rgb888::new(200, 200, 200), Rgb888::new(90, 90, 90));
    /// assert_eq!([0, 51, 255].map(|i| table.colors()[i].luma()), [90, 130, 255]);
    /// ```
    pub fn emitting(color: Rgb888, emission: Rgb888) -> Self {
        Self::from_colors(from_fn(|light| mixture(color, light as u32, emission, 255, 255)))
    }
}

impl<C: Color, const COLORS: usize, const ROWS: usize> LitPalette<C, COLORS, ROWS> {
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
