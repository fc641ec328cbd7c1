//! Gouraud shading of one colour: only the light is interpolated.

use super::flat::Flat;
use super::gouraud::Gouraud;
use super::levels::{aligned_max, each, fraction_bits, scaled, weighted_mean};
use crate::color::Color;
use crate::math::num::mul_wide;
use crate::raster::{Gradient, GradientSetup, Triangle};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// Gouraud shading of one colour: a light level at each corner of a face, in the order of the face's vertices, interpolated
/// linearly on the screen. [`Gouraud::lit`] makes it. It is faster than [`Gouraud::new`] with three dimmed colours, as it sets up one
/// gradient instead of three.
///
/// **Error.** As for [`Gouraud`], each channel of a pixel is the exact value at the pixel's centre, rounded to the nearest
/// level of the target: off by at most ½ + 2⁻⁹ level.
///
/// **Clipped faces** are treated as by [`Gouraud`]. The light at new corners is rounded to 2⁻²² of full light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lit {
    color: [u8; 3],
    /// In 2⁻²² / 255 of a level: the product with a channel of the colour is at most 2³⁰.
    light: [i32; 3],
}

/// The light of level 256.
const FULL: i32 = light(256);

/// `level · 2²² / 255`, off by less than 1.
const fn light(level: u16) -> i32 {
    ((level as u32 * 65_793 + 2) >> 2) as i32 // 2²⁴ / 255, up to 2⁸ times: below 2²⁵
}

impl Gouraud {
    /// The shader of a face in one colour, with a light level at each corner: 0 … 256 (more counts as 256).
    /// [`Light::levels`](crate::light::Light::levels) computes levels, [`Mesh::corners_of`](crate::Mesh::corners_of) picks those
    /// of a face.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb888, WebColors};
    /// use pinhole::shading::{Gouraud, Lit};
    /// let face: Lit = Gouraud::lit(Rgb888::CSS_GOLD, [256, 128, 40]);
    /// ```
    pub fn lit(color: Rgb888, levels: [u16; 3]) -> Lit {
        Lit { color: [color.r(), color.g(), color.b()], light: levels.map(|level| light(level.min(256))) }
    }
}

impl Lit {
    /// The shader of a sub-face, given the barycentric weights of its corners, in 2⁻³⁰.
    #[must_use]
    pub(crate) fn with_weights(&self, corners: [[i32; 3]; 3]) -> Self {
        Self { light: corners.map(|weights| weighted_mean(self.light, weights, FULL)), ..*self }
    }

    /// The shader of a face that emits light of its own: `emission` is added at each corner, each channel saturating at full, and
    /// the sums are interpolated. A channel that saturates at only some of the corners is darker between them than light plus
    /// emission would be.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb888, WebColors};
    /// use pinhole::shading::{Flat, Gouraud};
    /// let (levels, emission) = ([256, 128, 40], Rgb888::new(60, 0, 0)); // of Light::levels
    /// let face = Gouraud::lit(Rgb888::CSS_TEAL, levels).emitting(emission);
    /// assert_eq!(face, Gouraud::new(levels.map(|level| Flat::lit(Rgb888::CSS_TEAL, level).emitting(emission))));
    /// ```
    #[must_use]
    pub fn emitting(self, emission: Rgb888) -> Gouraud {
        let [r, g, b] = self.color;
        Gouraud::new(self.light.map(|light| {
            // 0 … 256: exact for `Gouraud::lit`, the nearest level for a sub-face. Up to `FULL`, which is less than 2²²·256/255 + 1: the
            // product is less than 2³⁰ + 2⁸.
            let level = ((light as u32 * 255 + (1 << 21)) >> 22) as u16;
            Flat::lit(Rgb888::new(r, g, b), level).emitting(emission)
        }))
    }

    /// The gradients of the channels over a triangle.
    #[inline(always)]
    pub(super) fn gradients<C: Color>(&self, triangle: &Triangle<'_>) -> [Gradient; 3] {
        let setup = GradientSetup::new(triangle);
        let Some(light) = (if C::FORMAT.is_gray() { None } else { setup.slope_through(&self.light) }) else {
            return self.per_channel::<C>(&setup);
        };
        // `slope_through` returns `None` for steep light, which is all light beyond 512 pixels. Up to there, it is off by less
        // than 512 + 34 + 2¹⁰·⁶ of 2³⁰, which is 2⁻¹¹ of 255 levels; rounding down adds 1024 · 2⁻²⁴.
        let times =
            |channel: u8, max: u8| light.times(i32::from(channel) * i32::from(max), 38 - fraction_bits(max));
        each::<C, _, _>(self.color, times)
    }

    /// The gradients computed channel by channel: for greys, and if light changes fast from pixel to pixel.
    #[inline(never)]
    fn per_channel<C: Color>(&self, setup: &GradientSetup<'_>) -> [Gradient; 3] {
        let through = |factor: u32, max: u8| {
            let factor = (factor * u32::from(aligned_max(max))) as i32; // ≤ 255² · 2⁸
            setup.through(&self.light.map(|light| ((mul_wide(light, factor) + (1 << 21)) >> 22) as i32))
        };
        each::<C, _, _>(scaled::<C>(self.color.map(u32::from)), through)
    }
}
