//! Colours on their way into the fog: for fog by face and by vertex.

use crate::color::Color;
use crate::shading::levels::mixture;
use crate::shading::{Flat, LitPalette, ShadeTable};
use core::array::from_fn;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

impl Flat {
    /// This colour mixed with the fog's colour `fog`: `factor`/256 of this colour and the rest of `fog`. A
    /// [`VertexFog`](crate::fog::VertexFog) computes the factor (more than 256 counts as 256). Each channel is rounded to the nearest
    /// 1/256 of a step of `Rgb888`.
    ///
    /// Light and fog at each corner, interpolated between them:
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb888, WebColors};
    /// use pinhole::shading::{Flat, Gouraud};
    /// let (light, fog) = ([256, 128, 40], [256, 200, 90]); // of Lambert::levels and VertexFog::factors
    /// let corner = |i: usize| Flat::lit(Rgb888::CSS_GOLD, light[i]).in_fog(Rgb888::CSS_LIGHT_STEEL_BLUE, fog[i]);
    /// let face = Gouraud::new([0, 1, 2].map(corner));
    /// assert_eq!(corner(0), Flat::from(Rgb888::CSS_GOLD));
    /// # let _ = face;
    /// ```
    #[must_use]
    pub fn in_fog(self, fog: Rgb888, factor: u16) -> Self {
        let factor = u32::from(factor.min(256));
        let Self([r, g, b]) = self;
        let mix = |own: u16, fog: u8| {
            // 255·256 of 256 parts, and a half: below 2²⁴ + 2⁸.
            let sum = u32::from(own) * factor + (u32::from(fog) << 8) * (256 - factor);
            ((sum + 128) >> 8) as u16
        };
        Self([mix(r, fog.r()), mix(g, fog.g()), mix(b, fog.b())])
    }
}

impl<C: Color> ShadeTable<C> {
    /// A table that fades `color` into `fog`: entry i is the colour of the target nearest to i/255 of `color` and the rest of
    /// `fog`; halves are rounded up. [`lit`](Self::lit) takes the factors of a [`VertexFog`](crate::fog::VertexFog) at the corners of
    /// a face.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888, RgbColor};
    /// use pinhole::shading::ShadeTable;
    /// let table = ShadeTable::<Gray8>::in_fog(Rgb888::BLACK, Rgb888::WHITE);
    /// assert_eq!([0, 55, 255].map(|i| table.colors()[i].luma()), [255, 200, 0]);
    /// let face = table.lit([256, 200, 90]); // of VertexFog::factors
    /// # let _ = face;
    /// ```
    pub fn in_fog(color: Rgb888, fog: Rgb888) -> Self {
        Self::from_colors(from_fn(|light| mixture(color, light as u32, fog, 255 - light as u32, 255)))
    }
}

impl<C: Color, const COLORS: usize, const ROWS: usize> LitPalette<C, COLORS, ROWS> {
    /// A palette that fades into fog: row i has i/(`ROWS` − 1) of the palette's colours and the rest of the fog's colour, so row
    /// 0 is fog alone; halves are rounded up. [`row`](Self::row) takes the factor of
    /// [`VertexFog::face_factor`](crate::fog::VertexFog::face_factor), [`Textured::lit`](crate::texture::Textured::lit) the factors of
    /// [`VertexFog::factors`](crate::fog::VertexFog::factors).
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
}
