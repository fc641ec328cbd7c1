//! The space in which light compares normals with directions.

use super::lambert::is_conformal;
use crate::math::num::row_times;
use crate::math::unit::normalise;
use crate::math::{component_to_q15, Affine, NormalMatrix};
use crate::space::{Model, World};

/// Where an object's normals meet the directions of lights. If the model transform is conformal, directions are transformed to
/// model space at set-up, and normals stay as they are. Otherwise each normal is transformed to world space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct NormalSpace {
    matrix: NormalMatrix<Model, World>,
    /// Whether the matrix is a rotation or reflection times a factor.
    pub(super) conformal: bool,
}

impl NormalSpace {
    #[inline(never)] // set-up: code size counts
    pub(super) fn new(model: &Affine<Model, World>) -> Self {
        let matrix = model.normals();
        Self { matrix, conformal: is_conformal(matrix.rows()) }
    }

    /// Transforms a unit vector, in 2⁻³⁰, from world space to the space of normals: each component is within 2⁻²⁸.
    #[inline(never)] // set-up: code size counts
    pub(super) fn direction(&self, unit: [i32; 3]) -> [i32; 3] {
        // n·(Cᵀ·l) = (C·n)·l.
        match self.conformal {
            true => normalise(&row_times(&unit, self.matrix.rows())),
            false => unit,
        }
    }

    /// Transforms a unit normal, in 2⁻¹⁵, from model space to the space of directions.
    #[inline(always)]
    pub(super) fn normal(&self, normal: [i16; 3]) -> [i16; 3] {
        match self.conformal {
            true => normal,
            false => self.transformed(normal),
        }
    }

    #[cold]
    #[inline(never)]
    fn transformed(&self, normal: [i16; 3]) -> [i16; 3] {
        self.matrix.apply(normal)
    }
}

/// `a · b`, for components of at most 2¹⁵ of which one vector is no longer than √3·2¹⁵ and the other than 2¹⁵: below 2³¹.
#[inline(always)]
pub(super) fn dot_words([a, b, c]: [i16; 3], [x, y, z]: [i16; 3]) -> i32 {
    let product = |a: i16, b: i16| i32::from(a) * i32::from(b);
    product(a, x).wrapping_add(product(b, y)).wrapping_add(product(c, z))
}

/// Converts a unit vector from 2⁻³⁰ to 2⁻¹⁵, rounded to nearest: +1 becomes 32767.
pub(super) fn to_words(unit: [i32; 3]) -> [i16; 3] {
    unit.map(component_to_q15)
}
