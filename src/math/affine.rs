//! Affine transforms between the spaces a scene is set up in.

use super::num::{add, row_times, scale};
use super::row::{block, Row};
use super::{Angle, Point3, Scalar, Vector3};
use crate::space::SetUp;
use core::marker::PhantomData;

/// An affine map from space `A` to space `B`:
///
/// ```text
///     | a b c ox |   columns a, b, c: where A's axes go, 30 bits with one exponent;
///     | a b c oy |   column o: where A's origin goes, in 2⁻³² world units
///     | a b c oz |
///     | 0 0 0 1  |
/// ```
///
/// Vectors are columns, so `M · p`; [`then`](Self::then) reads left to right. Coefficients are
/// rounded to 2⁻³¹ of the largest one at each composition and translations to 2⁻³³; translations
/// saturate at ±2³⁰ world units. Build transforms anew from angles every frame rather than
/// accumulating them: then nothing drifts.
///
/// ```
/// use pinhole::{space::{Model, World}, Affine, Angle, Point3, Vector3};
/// let place = Affine::<Model, World>::rotation_z(Angle::QUARTER_TURN)
///     .then(&Affine::translation(Vector3::from_ints(0, 0, -5)));
/// assert_eq!(place.apply(Point3::from_ints(2, 0, 0)), Point3::<World>::from_ints(0, 2, -5));
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Affine<A, B> {
    linear: [[i32; 3]; 3],
    exponent: i32,
    offset: [i64; 3],
    ends: PhantomData<(A, B)>,
}

impl<A, B> Clone for Affine<A, B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<A, B> Copy for Affine<A, B> {}

const ONE: i32 = 1 << 30;

impl<A: SetUp, B: SetUp> Affine<A, B> {
    const fn from_parts(linear: [[i32; 3]; 3], exponent: i32, offset: [i64; 3]) -> Self {
        Self { linear, exponent, offset, ends: PhantomData }
    }

    /// Coordinates stay as they are: `B` coincides with `A`.
    pub const fn identity() -> Self {
        Self::from_parts([[ONE, 0, 0], [0, ONE, 0], [0, 0, ONE]], 0, [0; 3])
    }

    /// A shift by `t`, exact.
    pub const fn translation(t: Vector3<B>) -> Self {
        let [x, y, z] = t.bits();
        // 2⁻¹⁶ to 2⁻³²: 48 bits.
        let offset = [(x as i64) << 16, (y as i64) << 16, (z as i64) << 16];
        Self::from_parts(Self::identity().linear, 0, offset)
    }

    /// The same factor along all axes, exact. Zero flattens everything into the origin, which
    /// draws nothing.
    pub fn scale(factor: Scalar) -> Self {
        Self::scale_axes(factor, factor, factor)
    }

    /// A factor for each axis; exact where the factors span no more than 30 bits. A negative one
    /// mirrors, and a mirrored mesh shows the inner sides of its faces.
    pub fn scale_axes(x: Scalar, y: Scalar, z: Scalar) -> Self {
        let [x, y, z] = [x, y, z].map(|f| i64::from(f.to_bits()));
        // Value = bits · 2⁻¹⁶ = bits · 2^(14 − 30).
        let (linear, exponent) = block([[x, 0, 0], [0, y, 0], [0, 0, z]], 14);
        Self::from_parts(linear, exponent, [0; 3])
    }

    /// About the x axis, from y towards z: `|1 0 0; 0 c −s; 0 s c|`. Coefficients within 2⁻²⁹·⁵.
    pub fn rotation_x(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[ONE, 0, 0], [0, c, -s], [0, s, c]], 0, [0; 3])
    }

    /// About the y axis, from z towards x: `|c 0 s; 0 1 0; −s 0 c|`. Coefficients within 2⁻²⁹·⁵.
    pub fn rotation_y(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, 0, s], [0, ONE, 0], [-s, 0, c]], 0, [0; 3])
    }

    /// About the z axis, from x towards y: `|c −s 0; s c 0; 0 0 1|`. Coefficients within 2⁻²⁹·⁵.
    pub fn rotation_z(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, -s, 0], [s, c, 0], [0, 0, ONE]], 0, [0; 3])
    }

    /// First this, then `next`: the matrix product `next · self`.
    pub fn then<C: SetUp>(&self, next: &Affine<B, C>) -> Affine<A, C> {
        let (linear, exponent) = product(&next.linear, next.exponent, &self.linear, self.exponent);
        let offset = next.rows().map(|row| row.apply(self.offset));
        Affine::from_parts(linear, exponent, offset)
    }

    /// The image of a point, rounded to the nearest 2⁻¹⁶ and saturated at the ends of [`Scalar`].
    pub fn apply(&self, p: Point3<A>) -> Point3<B> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        Point3::from_bits(self.rows().map(|row| to_scalar(row.apply(p))))
    }

    /// The linear part: coefficients `m · 2^(exponent − 30)`, row by row.
    pub(crate) fn linear(&self) -> (&[[i32; 3]; 3], i32) {
        (&self.linear, self.exponent)
    }

    /// Where the origin goes, relative to `eye` (2⁻¹⁶ units), in 2⁻³².
    pub(crate) fn offset_from(&self, eye: [i32; 3]) -> [i64; 3] {
        let away = |i: usize| add(self.offset[i], -(i64::from(eye[i]) << 16));
        [away(0), away(1), away(2)]
    }

    fn rows(&self) -> [Row; 3] {
        let row = |i: usize| Row { linear: self.linear[i], exponent: self.exponent, offset: self.offset[i] };
        [row(0), row(1), row(2)]
    }
}

/// 2⁻³² to 2⁻¹⁶, rounded to nearest, saturated.
pub(crate) fn to_scalar(v: i64) -> i32 {
    scale(v, -16).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `a · b` for two blocks.
pub(crate) fn product(
    a: &[[i32; 3]; 3],
    a_exponent: i32,
    b: &[[i32; 3]; 3],
    b_exponent: i32,
) -> ([[i32; 3]; 3], i32) {
    let sums = a.map(|row| row_times(row, b));
    // Exponents stay far inside i32: each factor's lies in ±2¹⁶ by the clamp.
    let (linear, exponent) = block(sums, a_exponent + b_exponent - 30);
    (linear, exponent.clamp(-65_536, 65_536))
}

#[cfg(feature = "defmt")]
impl<A, B> defmt::Format for Affine<A, B> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{} * 2^({=i32} - 30), {}/2^32", self.linear, self.exponent, self.offset);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Model, World};

    #[test]
    fn extremes_saturate_and_never_panic() {
        let huge = Affine::<World, World>::scale(Scalar::MAX);
        let mut grown = huge;
        for _ in 0..6000 {
            grown = grown.then(&huge);
        }
        let p = grown.apply(Point3::from_ints(1, -1, 0));
        assert_eq!(p, Point3::new(Scalar::MAX, Scalar::MIN, Scalar::ZERO));
        let tiny = Affine::<World, World>::scale(Scalar::DELTA);
        let mut shrunk = tiny;
        for _ in 0..6000 {
            shrunk = shrunk.then(&tiny);
        }
        assert_eq!(shrunk.apply(Point3::from_ints(i16::MAX, i16::MIN, 1)), Point3::from_ints(0, 0, 0));
        let zero = Affine::<Model, World>::scale(Scalar::ZERO);
        assert_eq!(zero.apply(Point3::from_ints(5, 6, 7)), Point3::from_ints(0, 0, 0));
    }
}
