//! Light with a highlight, by Blinn's version of Phong's model.

use super::levels::{each, scaled};
use super::normal_space::{dot_words, to_words, NormalSpace};
use super::ShadeTable;
use crate::color::Color;
use crate::math::unit::{is_zero, normalise};
use crate::math::{Affine, Vector3};
use crate::shading::{Light, LightError};
use crate::space::{Model, World};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// One directional light with a highlight, set up for one object: the light of a shiny surface, per face or per vertex. Its
/// levels are for [`ShadeTable::with_highlight`], whose colours go from black through the surface's colour to the highlight's.
///
/// With unit normal n, l towards the light, v towards the viewer and the half vector h = (l + v)/|l + v|, a level is
///
/// ```text
/// d = ¾ · (ambient + (256 − ambient) · max(0, n·l))     diffuse: Lambert's law, as `Lambert` has it
/// s = max(0, n·h)^shininess where n·l > 0, otherwise 0
/// level = d + (256 − d)·s
/// ```
///
/// so full diffuse light is level 192, and the middle of a highlight is 256. Both the light and the viewer are far away: h is
/// one vector for all of an object, and a normal takes six multiplications and one for each doubling of the shininess. (Blinn,
/// *Models of light reflection for computer synthesized pictures*, 1977; Foley et al., *Computer Graphics*, 2nd ed., section
/// 16.1.4.)
///
/// Highlights per vertex look right only where faces are small beside the highlight: choose a low shininess for coarse meshes.
/// Normals are transformed as by [`Lambert`](crate::light::Lambert).
///
/// **Error.** A level is within 5/8 + shininess/64 of the exact one: raising the cosine of the half vector to a power multiplies
/// its error. Where the light grazes the surface to within 2⁻¹³ rad, the highlight may be there or not. κ, the largest scale
/// factor of the model transform divided by its smallest, adds κ·shininess·2⁻²².
///
/// ```
/// use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor, WebColors};
/// use pinhole::{light::BlinnPhong, prelude::*};
/// let table = ShadeTable::<Rgb565>::with_highlight(Rgb888::CSS_TEAL, Rgb888::WHITE);
/// let up = Vector3::from_ints(0, 0, 1);
/// let light = BlinnPhong::new(&Affine::<Model, World>::identity(), up, up, 0, 16)?;
/// assert_eq!(light.level([0, 0, 32767]), 256);
/// assert_eq!(light.level([28377, 0, 16384]), 96); // 60°: half of the diffuse light
/// assert_eq!(table.colors()[255], Rgb565::WHITE);
/// # Ok::<(), pinhole::light::LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BlinnPhong {
    space: NormalSpace,
    /// Towards the light in 2⁻¹⁵.
    towards: [i16; 3],
    /// The half vector in 2⁻¹⁵.
    half: [i16; 3],
    /// Ambient light in levels, 0 … 256.
    ambient: u16,
    /// How often the cosine is squared: 0 … 8.
    squarings: u8,
}

impl BlinnPhong {
    /// Sets up the light on an object with the transform `model`. `towards_light` and `towards_viewer` point to the light and to
    /// the viewer (world space, any length); for the viewer, take the eye minus the target, as
    /// [`ViewTransform::look_at`](crate::ViewTransform::look_at) takes them, or the eye minus the object's position. `ambient` is the ambient part of the diffuse light in 1/256 (more than 256 counts as 256).
    /// `shininess` is the exponent, rounded down to a power of two of 1 … 256: 4 looks like rubber, 32 like plastic, 128 like
    /// polished metal. If the light is straight behind the object, there is no highlight.
    ///
    /// # Errors
    ///
    /// [`LightError::ZeroDirection`] if one of the vectors has length zero.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(
        model: &Affine<Model, World>,
        towards_light: Vector3<World>,
        towards_viewer: Vector3<World>,
        ambient: u16,
        shininess: u16,
    ) -> Result<Self, LightError> {
        let light = normalise(&towards_light.bits().map(i64::from));
        let viewer = normalise(&towards_viewer.bits().map(i64::from));
        if is_zero(&light) || is_zero(&viewer) {
            return Err(LightError::ZeroDirection);
        }
        let ([a, b, c], [x, y, z]) = (light.map(i64::from), viewer.map(i64::from));
        let half = normalise(&[a + x, b + y, c + z]);
        let space = NormalSpace::new(model);
        Ok(Self {
            space,
            towards: to_words(space.direction(light)),
            half: to_words(space.direction(half)),
            ambient: ambient.min(256),
            squarings: 15 - shininess.clamp(1, 256).leading_zeros() as u8, // 0 … 8
        })
    }
}

impl Light for BlinnPhong {
    #[inline(always)]
    fn level(&self, normal: [i16; 3]) -> u16 {
        let normal = self.space.normal(normal);
        let cosine = dot_words(normal, self.towards); // in 2⁻³⁰
        let ambient = u32::from(self.ambient);
        // In 2⁻¹⁵; at most 1, although rounding may make a normal longer than 1.
        let shade = ((cosine.max(0) as u32) >> 15).min(1 << 15);
        // ¾ of a level in 2⁻⁸: 2¹⁵ · 2⁸ at most before the shifts, 3·2¹⁴ at most after them.
        let diffuse = (((ambient << 15) + (256 - ambient) * shade) * 3) >> 9;
        let mut level = diffuse;
        if cosine > 0 {
            // A normal's 1 is 32767, so the product is 2⁻¹⁵ of itself too small: below 2³¹ + 2¹⁶ with the correction.
            let cosine = dot_words(normal, self.half).max(0) as u32;
            // In 2⁻¹⁶; 65535 stands for 1.
            let mut power = ((cosine + (cosine >> 15)) >> 14).min(0xffff);
            let mut left = self.squarings;
            while left != 0 {
                // Times 65536/65535 for numbers above ½, so that 1 stays 1: below 2³².
                power = (power * (power + (power >> 15))) >> 16;
                left -= 1;
            }
            level += ((65_536 - diffuse) * power) >> 16; // 2¹⁶ · (2¹⁶ − 1) at most
        }
        ((level + 128) >> 8) as u16
    }
}

impl<C: Color> ShadeTable<C> {
    /// The table for the levels of [`BlinnPhong`]: black to `color` over the first three quarters, `color` to `highlight` over
    /// the last one. Entry i is the colour at i/255 of the table, each channel within ½ + 2⁻⁷ level of the target.
    ///
    /// [`BlinnPhong`] has an example.
    pub fn with_highlight(color: Rgb888, highlight: Rgb888) -> Self {
        Self::from_colors(core::array::from_fn(|index| {
            // In 1/765: 4·index for `color` up to three quarters of 255, then less of it, and `highlight` instead.
            let index = 4 * index as u32;
            let rest = index.saturating_sub(765); // 0 … 255
            let weights = [index.min(765) - 3 * rest, 3 * rest];
            let mix = |a: u8, b: u8| {
                let [x, y] = weights; // their sum is at most 765
                u32::from(a) * x + u32::from(b) * y
            };
            let mixed =
                [mix(color.r(), highlight.r()), mix(color.g(), highlight.g()), mix(color.b(), highlight.b())];
            // In units of 1/(255·765·2⁸) of full: at most 255·765·2⁸ < 2²⁶.
            C::from_channels(each::<C, _, _>(scaled::<C>(mixed), nearest))
        }))
    }
}

/// `value / (2⁸·765·255)` of `max`, rounded to nearest, for values up to 255·765·2⁸.
fn nearest(value: u32, max: u8) -> u8 {
    const UNIT: u64 = 256 * 765 * 255;
    // At most `max`, as the value is at most UNIT.
    ((u64::from(value) * u64::from(max) + UNIT / 2) / UNIT) as u8
}
