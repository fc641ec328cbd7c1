//! Smooth light by table: 256 shades of one colour, computed once.

use super::levels::mixture;
use crate::color::Color;
use crate::math::unrolled::map3;
use core::array::from_fn;
use embedded_graphics_core::pixelcolor::{PixelColor, Rgb888, RgbColor};

/// A colour in 256 levels of light, computed once and looked up at every pixel: the fastest smooth light. The table takes 256
/// colours of the target (512 bytes for `Rgb565`). [`lit`](Self::lit) makes the shader of a face, which steps one gradient and
/// loads one colour per pixel, where [`Gouraud`](crate::shading::Gouraud) steps three channels. Renderers for palette displays light
/// faces this way.
///
/// **Error.** Light is linear on the screen and is rounded to the index of an entry, 0 … 255, with an error of at most
/// ½ + 2⁻⁹, for any triangle in the guard band. With a table made by [`new`](Self::new), each channel of a pixel is off by at
/// most ½ level of the target for rounding the entry, plus `(½ + 2⁻⁹) · MAX/255` for rounding the light. A face with full light
/// at all corners has the last entry everywhere, a face without light the first. [`Gouraud::lit`](crate::shading::Gouraud::lit) is
/// finer, and can be dithered.
///
/// **Clipped faces** are treated as by [`Gouraud`](crate::shading::Gouraud). The light at new corners is rounded to 2⁻¹⁰ of an entry.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::{Rgb565, Rgb888}, prelude::*};
/// use pinhole::{draw::fill_triangle, raster::ScreenPoint, shading::ShadeTable};
/// let gold = ShadeTable::<Rgb565>::new(Rgb888::CSS_GOLD); // before the first frame
/// let corner = |x: i32, y: i32| ScreenPoint::from_subpixels(x * 256, y * 256).unwrap();
/// let mut display = MockDisplay::new();
/// fill_triangle([corner(0, 0), corner(0, 64), corner(64, 0)], gold.lit([256, 128, 40]), &mut display)?;
/// assert_eq!(display.get_pixel(Point::zero()), Some(gold.colors()[252]));
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShadeTable<C>([C; 256]);

impl<C> ShadeTable<C> {
    /// A table of any 256 colours: a heat map, colours by height, the few steps of cartoon shading. It can be a constant.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray4, GrayColor};
    /// use pinhole::shading::ShadeTable;
    /// static TWO_STEPS: ShadeTable<Gray4> = {
    ///     let mut colors = [Gray4::new(4); 256];
    ///     let mut i = 128;
    ///     while i < 256 {
    ///         colors[i] = Gray4::WHITE;
    ///         i += 1;
    ///     }
    ///     ShadeTable::from_colors(colors)
    /// };
    /// ```
    pub const fn from_colors(colors: [C; 256]) -> Self {
        Self(colors)
    }

    /// The colours of the table, from no light to full light.
    pub const fn colors(&self) -> &[C; 256] {
        &self.0
    }

    /// The shader of a face with a level of light at each corner: 0 … 256 (more counts as 256).
    #[inline(always)]
    pub fn lit(&self, mut levels: [u16; 3]) -> TableShader<'_, C> {
        let [a, b, c] = levels;
        if a | b | c >= 256 {
            levels = map3(levels, |level| level.min(256)); // few faces have such light
        }
        // level · 255/256, in 2⁻¹⁰.
        TableShader { colors: &self.0, light: map3(levels, |level| i32::from(level) * (255 << 2)) }
    }
}

impl<C: Color> ShadeTable<C> {
    /// The colours of the target nearest to `color` at 0/255, 1/255 … 255/255 of its light; halves are rounded up.
    pub fn new(color: Rgb888) -> Self {
        Self(from_fn(|light| mixture(color, light as u32, Rgb888::BLACK, 0)))
    }

    /// A table that fades `color` into `fog`: entry i is the colour of the target nearest to i/255 of `color` and the rest of
    /// `fog`; halves are rounded up. [`lit`](Self::lit) takes the factors of a [`VertexFog`](crate::fog::VertexFog) at the corners of
    /// a face.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888, RgbColor};
    /// use pinhole::shading::ShadeTable;
    /// let table = ShadeTable::<Gray8>::in_fog(Rgb888::BLACK, Rgb888::WHITE);
    /// assert_eq!([0, 55, 255].map(|i| table.colors()[i].luma()), [255, 200, 0]);
    /// let face = table.lit([256, 200, 90]); // of VertexFog::factor
    /// ```
    pub fn in_fog(color: Rgb888, fog: Rgb888) -> Self {
        Self::from_colors(from_fn(|light| mixture(color, light as u32, fog, 255 - light as u32)))
    }

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
        Self::from_colors(from_fn(|light| mixture(color, light as u32, emission, 255)))
    }
}

/// The shader of a face that looks its colours up in a [`ShadeTable`], by light that is linear between the corners.
/// [`ShadeTable::lit`] makes it.
#[derive(Clone, Copy, Debug)]
pub struct TableShader<'t, C> {
    pub(crate) colors: &'t [C; 256],
    /// The index into the table at each corner, in 2⁻¹⁰.
    pub(crate) light: [i32; 3],
}

impl<C: PixelColor> TableShader<'_, C> {
    /// The colour for a value of [`Gradient::of_light`](crate::raster::Gradient::of_light).
    #[inline(always)]
    pub(crate) fn look_up(colors: &[C; 256], light: u32) -> C {
        let [index, ..] = light.to_be_bytes();
        colors[usize::from(index)] // each of 256 indices has a colour
    }
}

// The colours are not printed: they need not implement `Format`.
defmt_format!([C] ShadeTable<C>, self, "shade table");

defmt_format!([C] TableShader<'_, C>, self, "light {} of a shade table, in 1/1024", self.light);
