//! One colour in 256 levels of light, worked out once.

use super::levels::{luma, weighed};
use super::Channels;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// Colours from dark to full light, worked out once, to be looked up at every pixel: the fastest smooth light, for memory
/// of 256 colours of the target (512 bytes of `Rgb565`). [`lit`](Self::lit) makes the ink of a face, which has one plane to
/// work out and a load at each pixel in place of three channels. Light is as of [`Gouraud`](crate::Gouraud); the look-up
/// is that of renderers for displays with a table of colours.
///
/// **Error.** Light is linear on the screen; it is rounded to an entry 0 … 255: off by at most ½ + 2⁻⁹, for any
/// triangle in the guard band. In a table of [`new`](Self::new) each channel of a pixel is off by at most ½ level
/// of the target for the entry's rounding, and by `(½ + 2⁻⁹) · MAX/255` for the light's. Full light at all corners
/// gives the last entry throughout, no light the first. [`Gouraud::lit`](crate::Gouraud::lit) is finer, and can be
/// dithered.
///
/// **Cut faces.** As of [`Gouraud`](crate::Gouraud); the light at new corners is rounded to 2⁻¹⁰ of an entry.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::{Rgb565, Rgb888}, prelude::*};
/// use pinhole::{fill_triangle, raster::ScreenPoint, ShadeTable};
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
    /// Of colours of one's own: heat, heights, steps as of a cartoon. May be a constant.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray4, GrayColor};
    /// use pinhole::ShadeTable;
    /// static TWO_STEPS: ShadeTable<Gray4> = {
    ///     let mut colours = [Gray4::new(4); 256];
    ///     let mut i = 128;
    ///     while i < 256 {
    ///         colours[i] = Gray4::WHITE;
    ///         i += 1;
    ///     }
    ///     ShadeTable::from_colors(colours)
    /// };
    /// # let _ = TWO_STEPS.lit([0, 90, 256]);
    /// ```
    pub const fn from_colors(colours: [C; 256]) -> Self {
        Self(colours)
    }

    /// From no light to full light.
    pub const fn colors(&self) -> &[C; 256] {
        &self.0
    }

    /// The ink of a face by the light at each corner, 0 … 256 (more counts as 256).
    #[inline(always)]
    pub fn lit(&self, mut levels: [u16; 3]) -> TableShader<'_, C> {
        let [a, b, c] = levels;
        if a | b | c >= 256 {
            levels = levels.map(|level| level.min(256)); // of few faces
        }
        // level · 255/256, in 2⁻¹⁰.
        TableShader { colours: &self.0, light: levels.map(|level| i32::from(level) * (255 << 2)) }
    }
}

impl<C: Channels> ShadeTable<C> {
    /// The nearest colours of the target to `colour` at 0/255, 1/255 … 255/255 of its light, halves up.
    pub fn new(colour: Rgb888) -> Self {
        const WHOLE: u32 = 256 * 255 * 255;
        let [r, g, b] = [colour.r(), colour.g(), colour.b()].map(u32::from);
        let [x, y, z] = C::MAX;
        let mut light = 0;
        Self([(); 256].map(|()| {
            // All three are at most 255, the first one 2⁸ times as large: less than 2³² with the half.
            let nearest = |channel: u32, max: u8| (channel * light * u32::from(max) + WHOLE / 2) / WHOLE;
            let levels = match C::GRAY {
                true => [nearest(luma([r, g, b]), x), 0, 0],
                false => [nearest(r << 8, x), nearest(g << 8, y), nearest(b << 8, z)],
            };
            light += 1;
            C::from_channels(levels.map(|level| level as u8)) // ≤ MAX
        }))
    }
}

/// A [`ShadeTable`]'s colours, and the light at each corner of a face, in the order in which it names them.
/// It is made by [`ShadeTable::lit`].
#[derive(Clone, Copy, Debug)]
pub struct TableShader<'t, C> {
    colours: &'t [C; 256],
    /// Of an entry's number, in 2⁻¹⁰.
    light: [i32; 3],
}

impl<'t, C> TableShader<'t, C> {
    /// For a part of the face: how much of each of its corners the new ones are, in 2⁻³⁰.
    #[must_use]
    pub(crate) fn part(&self, corners: [[i32; 3]; 3]) -> Self {
        Self { light: corners.map(|weights| weighed(self.light, weights, 255 << 10)), colours: self.colours }
    }

    pub(crate) const fn colors(&self) -> &'t [C; 256] {
        self.colours
    }

    pub(crate) const fn light(&self) -> [i32; 3] {
        self.light
    }
}

// Of colours nothing is said: a colour need not have a Format.
#[cfg(feature = "defmt")]
impl<C> defmt::Format for ShadeTable<C> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "shade table");
    }
}

#[cfg(feature = "defmt")]
impl<C> defmt::Format for TableShader<'_, C> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "light {} of a shade table, in 1/1024", self.light);
    }
}
