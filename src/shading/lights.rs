//! Several directional lights, summed for a face or a vertex.

use super::normal_space::{dot_words, NormalSpace};
use crate::math::num::{mul_called, scale};
use crate::math::unit::{is_zero, normalise};
use crate::math::{Affine, Vector3};
use crate::shading::{Light, LightError};
use crate::space::{Model, World};

/// Any number of directional lights, and ambient light by Lambert's law, summed, set up for one object:
/// `ambient + Σ strengthᵢ · max(0, cosᵢ)`, at most 256. A main light, a weaker one from the other side and a little ambient light
/// show a shape better than one light does.
///
/// Normals are transformed as by [`Lambert`](crate::light::Lambert): by the inverse transpose of the model transform, or not at all if
/// the transform is conformal. A normal then takes three multiplications for each light.
///
/// **Error.** A level is within ½ + (1/64 + κ·2⁻²²)·N of the exact sum for N lights, where κ is the largest scale factor of the
/// model transform divided by its smallest.
///
/// ```
/// use pinhole::{light::Lights, prelude::*};
/// let model = Affine::<Model, World>::identity();
/// let (key, fill) = (Vector3::from_ints(0, 0, 1), Vector3::from_ints(-1, 0, 0));
/// let lights = Lights::new(&model, &[(key, 160), (fill, 64)], 32)?;
/// assert_eq!(lights.level([0, 0, 32767]), 192); // the main light and ambient light
/// assert_eq!(lights.level([-32767, 0, 0]), 96); // the other light and ambient light
/// assert_eq!(lights.level([32767, 0, 0]), 32);
/// # Ok::<(), pinhole::light::LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lights<const N: usize> {
    space: NormalSpace,
    /// The directions towards the lights in 2⁻¹⁵, times their strengths.
    towards: [[i16; 3]; N],
    /// Ambient light in 2⁻²² of a level, plus the half that rounds.
    ambient: u32,
}

impl<const N: usize> Lights<N> {
    /// Sets up the lights on an object with the transform `model`: of each light the direction towards it, in world space and of any
    /// length, and the light that it adds to a face that it meets at a right angle. That and `ambient` are in 1/256 of full light (more
    /// than 256 counts as 256).
    ///
    /// # Errors
    ///
    /// [`LightError::ZeroDirection`] if a direction has length zero.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(
        model: &Affine<Model, World>,
        lights: &[(Vector3<World>, u16); N],
        ambient: u16,
    ) -> Result<Self, LightError> {
        let space = NormalSpace::new(model);
        let mut towards = [[0; 3]; N];
        for (towards, (direction, strength)) in towards.iter_mut().zip(lights) {
            let unit = normalise(&direction.bits().map(i64::from));
            if is_zero(&unit) {
                return Err(LightError::ZeroDirection);
            }
            let strength = i32::from((*strength).min(256));
            for (to, c) in towards.iter_mut().zip(space.direction(unit)) {
                // |c · strength| ≤ 2³⁸, so at most 2¹⁵ after the shift.
                *to = scale(mul_called(c, strength), -23).min(32_767) as i16;
            }
        }
        Ok(Self { space, towards, ambient: (u32::from(ambient.min(256)) << 22) + (1 << 21) })
    }
}

impl<const N: usize> Light for Lights<N> {
    #[inline(always)]
    fn level(&self, normal: [i16; 3]) -> u16 {
        let normal = self.space.normal(normal);
        let mut sum = self.ambient;
        for &towards in &self.towards {
            // At most 2³⁰·⁸ each: saturates beyond full light only.
            sum = sum.saturating_add(dot_words(normal, towards).max(0) as u32);
        }
        (sum >> 22).min(256) as u16
    }
}
