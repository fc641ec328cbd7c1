//! The space in which light compares normals with directions.

use crate::math::hints::opaque_next;
use crate::math::num::{dot, row_times};
use crate::math::unit::normalise;
use crate::math::{Affine, NormalMatrix};
use crate::space::{Model, World};

/// Where an object's normals meet the directions of lights. If the model transform is conformal, directions are transformed to
/// model space at set-up, and normals stay as they are. Otherwise each normal is transformed to world space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct NormalSpace {
    pub(super) matrix: NormalMatrix,
    /// Whether the matrix is a rotation or reflection times a factor.
    pub(super) conformal: bool,
}

impl NormalSpace {
    pub(super) fn new(model: &Affine<Model, World>) -> Self {
        let matrix = model.normals();
        Self { matrix, conformal: is_conformal(matrix.rows()) }
    }

    /// Transforms a unit vector, in 2⁻³⁰, from world space to the space of normals: each component is within 2⁻²⁸.
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
            j = opaque_next(j); // code size counts, speed does not
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
