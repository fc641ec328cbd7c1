//! Lambert light: ambient and diffuse lighting, per face or per vertex.

use crate::math::hints::opaque_next;
use crate::math::num::{dot, row_times};
use crate::math::unit::{is_zero, normalise};
use crate::math::unrolled::map3;
use crate::math::{component_to_q15, Affine, NormalMatrix, Vector3};
use crate::shading::{Light, LightError};
use crate::space::{Model, World};

/// One directional light and ambient light by Lambert's law, set up for one object. A [`level`](Light::level) is
/// `ambient + (256 − ambient) · max(0, cos)`, within 1 + κ·2⁻²², where κ is the largest scale factor of the model transform divided by its
/// smallest.
///
/// Normals are transformed by the inverse transpose of the model transform. If the transform is conformal (a rotation or
/// reflection with uniform scale), the light direction is transformed to model space instead, and a normal takes three
/// multiplications. [`RigidLambert`] takes only conformal transforms, and less flash. (Lambert's law: Foley et al., *Computer
/// Graphics*, 2nd ed., section 16.1; normals: section 5.6.)
///
/// ```
/// use pinhole::{light::LightError, prelude::*};
/// let model = Affine::<Model, World>::identity();
/// let light = Lambert::new(&model, Vector3::from_ints(0, 0, 9), 64)?;
/// assert_eq!(light.level([0, 0, 32767]), 256); // faces the light
/// assert_eq!(light.level([32767, 0, 0]), 64); // grazed: ambient only
/// assert_eq!(Lambert::new(&model, Vector3::from_ints(0, 0, 0), 64), Err(LightError::ZeroDirection));
/// # Ok::<(), LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lambert {
    /// In model space if the transform is conformal, otherwise in world space.
    light: ScaledLight,
    /// The normal matrix to world space, if the transform is not conformal.
    normal_matrix: Option<NormalMatrix<Model, World>>,
}

impl Lambert {
    /// Sets up the light on an object with the transform `model`. `towards_light` points towards the light (world space, any
    /// length). `ambient` is the ambient part in 1/256 of full light (more than 256 counts as 256).
    ///
    /// # Errors
    ///
    /// [`LightError::ZeroDirection`] if `towards_light` has length zero.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(
        model: &Affine<Model, World>,
        towards_light: Vector3<World>,
        ambient: u16,
    ) -> Result<Self, LightError> {
        let light = normalise(&towards_light.bits().map(i64::from));
        if is_zero(&light) {
            return Err(LightError::ZeroDirection);
        }
        let normals = model.normals();
        // n·(Cᵀ·l) = (C·n)·l.
        let in_model = normalise(&row_times(&light, normals.rows()));
        let conformal = is_conformal(normals.rows());
        Ok(Self {
            light: ScaledLight::new(if conformal { in_model } else { light }, ambient),
            normal_matrix: (!conformal).then_some(normals),
        })
    }

    #[cold]
    #[inline(never)]
    fn level_by_normal_matrix(
        &self,
        normal_matrix: &NormalMatrix<Model, World>,
        a: i16,
        b: i16,
        c: i16,
    ) -> u16 {
        let [a, b, c] = normal_matrix.apply([a, b, c]);
        self.light.level(a, b, c)
    }
}

impl Light for Lambert {
    #[inline(always)]
    fn level(&self, normal: [i16; 3]) -> u16 {
        let [a, b, c] = normal;
        match &self.normal_matrix {
            None => self.light.level(a, b, c),
            Some(normal_matrix) => self.level_by_normal_matrix(normal_matrix, a, b, c),
        }
    }
}

/// A light direction and ambient light, in the space of the normals that it lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct ScaledLight {
    /// The direction towards the light in 2⁻¹⁵, times the share of light that is not ambient.
    towards: [i16; 3],
    /// Ambient light in 2⁻²² of a level, plus the half that rounds.
    ambient: u32,
}

impl ScaledLight {
    /// The light from the direction `unit`, a unit vector towards the light in 2⁻³⁰, and `ambient` light, 0 … 256 (more counts as
    /// 256).
    #[inline(always)] // each light has one call
    fn new(unit: [i32; 3], ambient: u16) -> Self {
        let ambient = ambient.min(256);
        let rest = 256 - i32::from(ambient);
        let (mut towards, mut i) = ([0; 3], 0);
        while let (Some(&c), Some(to)) = (unit.get(i), towards.get_mut(i)) {
            // The product is at most 2²³, so the result fits 16 bits.
            *to = ((i32::from(component_to_q15(c)) * rest + 128) >> 8) as i16;
            i = opaque_next(i); // code size counts
        }
        Self { towards, ambient: (u32::from(ambient) << 22) + (1 << 21) }
    }

    /// The light for a normal in the space of the light direction.
    #[inline(always)]
    fn level(&self, a: i16, b: i16, c: i16) -> u16 {
        let (a, b, c) = (i32::from(a), i32::from(b), i32::from(c));
        let [x, y, z] = map3(self.towards, i32::from);
        // |n|·|l| ≤ √3·2¹⁵ · 2¹⁵ bounds every partial sum below 2³¹. The larger the ambient part, the shorter is l: so the sum with
        // the ambient part stays below 2³².
        let dot = (a * x).wrapping_add(b * y).wrapping_add(c * z);
        ((dot.max(0) as u32).wrapping_add(self.ambient) >> 22).min(256) as u16
    }
}

/// [`Lambert`] for an object that is only turned, moved, reflected or scaled uniformly: set-up transforms the light direction by
/// the transpose of the model transform, and a firmware that uses no other light has no code for normal matrices. A level is within 1.
///
/// ```
/// use pinhole::{light::{LightError, RigidLambert}, prelude::*, Angle};
/// let model = Affine::<Model, World>::rotation_y(Angle::degrees(90));
/// let light = RigidLambert::new(&model, Vector3::from_ints(9, 0, 0), 64)?;
/// assert_eq!(light.level([0, 0, 32767]), 256); // turned from +z to +x, it faces the light
/// assert_eq!(light.level([32767, 0, 0]), 64); // grazed: ambient only
/// let [one, two] = [1, 2].map(Scalar::from_int);
/// let stretched = Affine::<Model, World>::scale_axes(one, two, one);
/// assert_eq!(RigidLambert::new(&stretched, Vector3::from_ints(9, 0, 0), 64), Err(LightError::NotRigid));
/// # Ok::<(), LightError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RigidLambert {
    /// In model space.
    light: ScaledLight,
}

impl RigidLambert {
    /// Sets up the light on an object with the transform `model`. `towards_light` points towards the light (world space, any
    /// length). `ambient` is the ambient part in 1/256 of full light (more than 256 counts as 256).
    ///
    /// # Errors
    ///
    /// [`LightError::ZeroDirection`] if `towards_light` has length zero; [`LightError::NotRigid`] if `model` stretches or shears:
    /// if, relative to the squared length of its first row, the squared length of another row differs from 1 or the dot product
    /// of two rows from 0 by more than 2⁻¹⁰.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(
        model: &Affine<Model, World>,
        towards_light: Vector3<World>,
        ambient: u16,
    ) -> Result<Self, LightError> {
        let light = normalise(&towards_light.bits().map(i64::from));
        if is_zero(&light) {
            return Err(LightError::ZeroDirection);
        }
        let (rows, _) = model.linear();
        if !is_conformal(rows) {
            return Err(LightError::NotRigid);
        }
        // n·(Rᵀ·l) = (R·n)·l.
        Ok(Self { light: ScaledLight::new(normalise(&row_times(&light, rows)), ambient) })
    }
}

impl Light for RigidLambert {
    #[inline(always)]
    fn level(&self, normal: [i16; 3]) -> u16 {
        let [a, b, c] = normal;
        self.light.level(a, b, c)
    }
}

/// Whether the transform is conformal: its rows are orthogonal and of equal length within 2⁻¹⁰, so that the error in angles
/// changes light by less than a level.
pub(super) fn is_conformal(rows: &[[i32; 3]; 3]) -> bool {
    let [x, ..] = rows;
    let length = dot(x, x); // 3·2⁶⁰ at most, like the other products
    let (mut conformal, mut i) = (true, 0);
    while let Some(a) = rows.get(i) {
        let mut j = i;
        while let Some(b) = rows.get(j) {
            let wanted = if i == j { length } else { 0 };
            conformal &= (dot(a, b) - wanted).abs() <= length >> 10;
            j = opaque_next(j); // code size counts
        }
        i = opaque_next(i);
    }
    conformal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_of_any_size_are_conformal_and_stretch_and_shear_are_not() {
        const ONE: i32 = 1 << 29;
        for one in [ONE, ONE / 3, 1 << 12] {
            let turned = [[0, one, 0], [0, 0, one], [one, 0, 0]];
            assert!(is_conformal(&turned));
            // 3-4-5.
            assert!(is_conformal(&[
                [one / 5 * 3, one / 5 * 4, 0],
                [-(one / 5 * 4), one / 5 * 3, 0],
                [0, 0, one / 5 * 5]
            ]));
            for i in 0..3 {
                // Row i of `turned` has `one` in column i + 1. A stretch by 2⁻¹² changes its squared length by 2⁻¹¹, one by 2⁻⁹ changes it by
                // 2⁻⁸; the limit is 2⁻¹⁰.
                for (part, conformal) in [(one >> 12, true), (one >> 9, false), (-(one >> 9), false)] {
                    let (mut stretched, mut sheared) = (turned, turned);
                    stretched[i][(i + 1) % 3] += part;
                    sheared[i][i] += part;
                    assert_eq!(is_conformal(&stretched), conformal, "{stretched:?}");
                    assert_eq!(is_conformal(&sheared), conformal, "{sheared:?}");
                }
            }
        }
    }
}
