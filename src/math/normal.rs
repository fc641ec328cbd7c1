//! The normal matrix of an affine transform.

use super::affine::{cofactors, matrix_product};
use super::hints::opaque_next;
use super::num::dot;
use super::unit::normalise;
use super::Affine;
use crate::space::SceneSpace;
use core::marker::PhantomData;

/// The normal matrix: the inverse transpose of a transform's linear part, up to a positive factor. It maps normals of surfaces.
///
/// It is computed from the cofactors, so it exists even for singular transforms. Under a reflection normals keep pointing
/// outwards. (Turkowski, *Transformations of surface normal vectors*, 1990.)
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct NormalMatrix<A, B> {
    /// The rows of the normal matrix, 30 bits, times an unknown positive factor.
    rows: [[i32; 3]; 3],
    ends: PhantomData<(A, B)>,
}

impl<A, B> Clone for NormalMatrix<A, B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<A, B> Copy for NormalMatrix<A, B> {}

impl<A: SceneSpace, B: SceneSpace> Affine<A, B> {
    /// The normal matrix of this transform.
    #[inline(never)] // set-up: code size counts
    pub(crate) fn normals(&self) -> NormalMatrix<A, B> {
        let (linear, _) = self.linear();
        let (mut rows, _) = cofactors(linear);
        // The sign of the determinant: three products of at most 2⁶⁰.
        if dot(&linear[0], &rows[0]) < 0 {
            let mut i = 0;
            while let Some(c) = rows.as_flattened_mut().get_mut(i) {
                *c = -*c;
                i = opaque_next(i);
            }
        }
        NormalMatrix { rows, ends: PhantomData }
    }
}

impl<A, B> NormalMatrix<A, B> {
    /// Maps a normal (2⁻¹⁵, any length) to a unit normal (2⁻¹⁵, 32767 stands for 1), each component within 2⁻¹⁵ and
    /// κ·2⁻³⁰, where κ is the transform's largest stretch over its smallest; zero where the image has no direction.
    pub(crate) fn apply(&self, normal: [i16; 3]) -> [i16; 3] {
        let ([x, y, z], normal) = (&self.rows, normal.map(i32::from)); // three products of at most 2⁴⁵
        let image = [dot(x, &normal), dot(y, &normal), dot(z, &normal)];
        to_q15(normalise(&image))
    }

    /// The transform of normals from `A` to `C`: this one, then the rotation with these rows, in 2⁻³⁰.
    #[inline(never)] // set-up: code size counts
    pub(crate) fn rotated<C>(&self, rotation: &[[i32; 3]; 3]) -> NormalMatrix<A, C> {
        let mut rows = [[0; 3]; 3];
        matrix_product(rotation, 0, &self.rows, 0, &mut rows); // the factor of all rows does not matter
        NormalMatrix { rows, ends: PhantomData }
    }

    pub(crate) const fn rows(&self) -> &[[i32; 3]; 3] {
        &self.rows
    }
}

/// A unit vector in 2⁻³⁰ as Q0.15, rounded to nearest; +1 becomes 32767.
fn to_q15(unit: [i32; 3]) -> [i16; 3] {
    unit.map(component_to_q15)
}

/// A component of a unit vector in 2⁻³⁰ as Q0.15, rounded to nearest; +1 becomes 32767.
pub(crate) fn component_to_q15(c: i32) -> i16 {
    ((c + (1 << 14)) >> 15).min(32_767) as i16
}

#[cfg(feature = "defmt")]
impl<A, B> defmt::Format for NormalMatrix<A, B> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "normals {}", self.rows);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Scalar;
    use crate::space::{Model, World};

    /// The direction that is left, or none.
    #[test]
    fn s2_normals_of_flattened_models() {
        let flat = Affine::<Model, World>::scale_axes(Scalar::ONE, Scalar::ONE, Scalar::ZERO).normals();
        assert_eq!(flat.apply([100, 0, 30_000]), [0, 0, 32_767]);
        assert_eq!(Affine::<Model, World>::scale(Scalar::ZERO).normals().apply([1, 2, 3]), [0; 3]);
    }
}
