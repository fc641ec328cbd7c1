//! One colour, in finer steps than the target's.

use crate::color::Color;
use crate::scene::FaceColors;
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// One colour for a face, with red, green and blue in 1/256 of the steps of `Rgb888`.
///
/// As a shader it fills a face with the nearest colour of the target, computed once per face. The target may have any colour
/// type with [`Color`](crate::color::Color), so one closure works for all of them. [`Dithered`](crate::shading::Dithered) also shows the
/// fraction that rounding drops.
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
/// use pinhole::shading::Flat;
/// assert_eq!(Flat::from(Rgb888::RED), Flat::lit(Rgb888::RED, 256));
/// assert_ne!(Flat::lit(Rgb888::new(9, 9, 9), 255), Flat::from(Rgb888::new(9, 9, 9))); // 8.96
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Flat(pub(super) [u16; 3]);

impl Flat {
    /// `color` times `level`/256, exact with its 8 fractional bits; levels above 256 count as 256.
    pub fn lit(color: Rgb888, level: u16) -> Self {
        // ≤ 255·256.
        Self([color.r(), color.g(), color.b()].map(|channel| u16::from(channel) * level.min(256)))
    }

    /// This colour mixed with the fog's colour `fog`: `factor`/256 of this colour and the rest of `fog`. A
    /// [`VertexFog`](crate::fog::VertexFog) computes the factor (more than 256 counts as 256). Each channel is rounded to the nearest
    /// 1/256 of a step of `Rgb888`.
    ///
    /// Light and fog at each corner, interpolated between them:
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Rgb888, WebColors};
    /// use pinhole::shading::{Flat, Gouraud};
    /// let (light, fog) = ([256, 128, 40], [256, 200, 90]); // of Light::levels and VertexFog::factor
    /// let corner = |i: usize| Flat::lit(Rgb888::CSS_GOLD, light[i]).in_fog(Rgb888::CSS_LIGHT_STEEL_BLUE, fog[i]);
    /// let face = Gouraud::new([0, 1, 2].map(corner));
    /// assert_eq!(corner(0), Flat::from(Rgb888::CSS_GOLD));
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

impl From<Rgb888> for Flat {
    fn from(color: Rgb888) -> Self {
        Self::lit(color, 256)
    }
}

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
