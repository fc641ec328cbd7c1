//! Affine transforms between model and world space.

use super::float;
use super::hints::opaque_next;
use super::num::{add, fraction, row_times, scale, shift_to_fit, sqrt, transposed};
use super::quaternion;
use super::row::{block_scaled, transform_point, Row};
use super::unit::{cross_exact, is_zero, normalise};
use super::{Angle, Point3, Scalar, Vector3};
use crate::math::MathError;
use crate::space::SceneSpace;
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
/// Vectors are columns, so `M · p`; [`then`](Self::then) reads left to right. Each composition rounds coefficients
/// to within 2⁻³⁰ of the largest one, and the translation to within 2⁻³³ world units; translations saturate at
/// ±2³⁰. Rebuild transforms from angles every frame instead of accumulating them: then nothing drifts. (A million
/// turns of 0.1°, accumulated in one matrix, stretch a model by 0.037 % and leave it 0.057° behind.)
///
/// `==` compares the stored numbers: two values of one map that were computed differently may differ. To allow for rounding,
/// compare the results of [`to_matrix`](Self::to_matrix).
///
/// ```
/// use pinhole::{prelude::*, Angle};
/// let place = Affine::<Model, World>::rotation_z(Angle::degrees(90))
///     .then(&Affine::translation(Vector3::from_ints(0, 0, -5)));
/// assert_eq!(place.apply(Point3::from_ints(2, 0, 0)), Point3::<World>::from_ints(0, 2, -5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Affine<A, B> {
    linear: [[i32; 3]; 3],
    exponent: i32,
    offset: [i64; 3],
    ends: PhantomData<(A, B)>,
}

const ONE: i32 = 1 << 30;

impl<A: SceneSpace, B: SceneSpace> Affine<A, B> {
    const fn from_parts(linear: [[i32; 3]; 3], exponent: i32, offset: [i64; 3]) -> Self {
        Self { linear, exponent, offset, ends: PhantomData }
    }

    /// The identity: coordinates in `A` and `B` are equal.
    pub const fn identity() -> Self {
        Self::from_parts([[ONE, 0, 0], [0, ONE, 0], [0, 0, ONE]], 0, [0; 3])
    }

    /// The translation by `t`, exact.
    pub const fn translation(t: Vector3<B>) -> Self {
        let [x, y, z] = t.bits();
        // 2⁻¹⁶ to 2⁻³²: 48 bits.
        let offset = [(x as i64) << 16, (y as i64) << 16, (z as i64) << 16];
        Self::from_parts(Self::identity().linear, 0, offset)
    }

    /// Uniform scale by `factor`: exact below 16384, with a relative error of 2⁻³⁰ above. A factor of zero maps every point to
    /// the origin: no face covers a pixel.
    pub fn scale(factor: Scalar) -> Self {
        Self::scale_axes(factor, factor, factor)
    }

    /// Scale by one factor per axis: exact where the factors span no more than 30 bits, otherwise within 2⁻³⁰ of the largest
    /// factor. A negative factor mirrors; an odd number of them turns faces inside out, so culling shows their inner sides.
    pub fn scale_axes(x: Scalar, y: Scalar, z: Scalar) -> Self {
        let [x, y, z] = [x, y, z].map(|f| i64::from(f.to_bits()));
        // Value = bits · 2⁻¹⁶ = bits · 2^(14 − 30).
        let (linear, exponent) = rounded_block(&[[x, 0, 0], [0, y, 0], [0, 0, z]], 14);
        Self::from_parts(linear, exponent, [0; 3])
    }

    /// Rotation about the x axis, from y towards z: `|1 0 0; 0 c −s; 0 s c|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_x(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[ONE, 0, 0], [0, c, -s], [0, s, c]], 0, [0; 3])
    }

    /// Rotation about the y axis, from z towards x: `|c 0 s; 0 1 0; −s 0 c|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_y(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, 0, s], [0, ONE, 0], [-s, 0, c]], 0, [0; 3])
    }

    /// Rotation about the z axis, from x towards y: `|c −s 0; s c 0; 0 0 1|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_z(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, -s, 0], [s, c, 0], [0, 0, ONE]], 0, [0; 3])
    }

    /// Right-handed rotation about the line through `through` along `axis` (of any length): `R = c·I + (1 − c)·a·aᵀ + s·[a]×`
    /// and the translation `through − R·through`. Coefficients are within 2⁻²⁷; given these coefficients, the
    /// translation is within 2⁻³³ world units. (Rodrigues 1840; Goldman, *Matrices and
    /// transformations*, Graphics Gems, 1990.)
    ///
    /// ```
    /// use pinhole::{prelude::*, Angle};
    /// let (through, axis) = (Point3::from_ints(1, 0, 0), Vector3::from_ints(0, 0, 7));
    /// let half = Affine::<World, World>::rotation(through, axis, Angle::degrees(180))?;
    /// assert_eq!(half.apply(Point3::from_ints(3, 4, 5)), Point3::from_ints(-1, -4, 5));
    /// # Ok::<(), pinhole::math::MathError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MathError::ZeroLength`] if `axis` has length zero.
    pub fn rotation(through: Point3<B>, axis: Vector3<B>, angle: Angle) -> Result<Self, MathError> {
        let axis = normalise(&axis.bits().map(i64::from));
        if is_zero(&axis) {
            return Err(MathError::ZeroLength);
        }
        let (s, c) = angle.sin_cos();
        // 0 … 2³¹.
        let versine = i64::from(ONE) - i64::from(c);
        // Products in 2⁻⁶⁰, to 2⁻³⁰: at most 2⁶¹.
        let outer = |a: i32, b: i32| scale(versine * scale(i64::from(a) * i64::from(b), -30), -30);
        let turn = |a: i32| scale(i64::from(a) * i64::from(s), -30);
        let [x, y, z] = axis;
        let c = i64::from(c);
        let linear = [
            [c + outer(x, x), outer(x, y) - turn(z), outer(x, z) + turn(y)],
            [outer(y, x) + turn(z), c + outer(y, y), outer(y, z) - turn(x)],
            [outer(z, x) - turn(y), outer(z, y) + turn(x), c + outer(z, z)],
        ];
        Ok(Self::fixing(linear, through))
    }

    /// The rotation of the quaternion `w + x·i + y·j + z·k`, of any length but zero. Coefficients within 2⁻²⁷.
    /// (Shoemake, *Animating rotation with quaternion curves*, 1985.)
    ///
    /// ```
    /// use pinhole::{prelude::*, Angle};
    /// let [zero, one] = [Scalar::ZERO, Scalar::ONE];
    /// let turn = Affine::<Model, World>::from_quaternion([one, zero, zero, one])?; // 90° about z
    /// let p = Point3::from_ints(1, 0, 0);
    /// assert_eq!(turn.apply(p), Affine::<Model, World>::rotation_z(Angle::degrees(90)).apply(p));
    /// # Ok::<(), pinhole::math::MathError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MathError::ZeroLength`] if all components are zero.
    pub fn from_quaternion(wxyz: [Scalar; 4]) -> Result<Self, MathError> {
        Self::from_parts_of_quaternion(wxyz.map(|c| i64::from(c.to_bits())))
    }

    /// From components in any unit, each within ±2⁶².
    fn from_parts_of_quaternion(wxyz: [i64; 4]) -> Result<Self, MathError> {
        let [w, x, y, z] = quaternion::unit(wxyz).ok_or(MathError::ZeroLength)?.map(i64::from);
        // Twice a product of 30-bit numbers, to 2⁻³⁰.
        let twice = |sum: i64| scale(sum, -29);
        let one = i64::from(ONE);
        let linear = [
            [one - twice(y * y + z * z), twice(x * y - w * z), twice(x * z + w * y)],
            [twice(x * y + w * z), one - twice(x * x + z * z), twice(y * z - w * x)],
            [twice(x * z - w * y), twice(y * z + w * x), one - twice(x * x + y * y)],
        ];
        Ok(Self::fixing(linear, Point3::from_ints(0, 0, 0)))
    }

    /// The map with this linear part, in 2⁻³⁰ of up to 31 bits, that maps the point `fixed` to itself.
    fn fixing(linear: [[i64; 3]; 3], fixed: Point3<B>) -> Self {
        let (linear, exponent) = rounded_block(&linear, 0);
        let turned = Self::from_parts(linear, exponent, [0; 3]);
        let at = fixed.bits().map(|c| i64::from(c) << 16);
        let [x, y, z] = turned.apply_bits(&at);
        Self { offset: [add(at[0], -x), add(at[1], -y), add(at[2], -z)], ..turned }
    }

    /// The map from a coordinate frame with these axes and this origin to `B`: the matrix with columns a, b, c, o. Exact where
    /// the axes' components span no more than 30 bits, otherwise within 2⁻³⁰ of the largest coefficient.
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// // The model's x, y and z axes map to the world's y, z and x axes; lengths along the first one double.
    /// let [a, b, c] = [[0, 2, 0], [0, 0, 1], [1, 0, 0]].map(|[x, y, z]| Vector3::from_ints(x, y, z));
    /// let place = Affine::<Model, World>::from_frame(a, b, c, Point3::from_ints(10, 0, 0));
    /// assert_eq!(place.apply(Point3::from_ints(1, 3, 5)), Point3::from_ints(15, 2, 3));
    /// ```
    #[inline(never)] // set-up: code size counts
    pub fn from_frame(a: Vector3<B>, b: Vector3<B>, c: Vector3<B>, origin: Point3<B>) -> Self {
        let (a, b, c) = (a.bits(), b.bits(), c.bits());
        let row = |i: usize| [a[i], b[i], c[i]].map(i64::from);
        let (linear, exponent) = rounded_block(&[row(0), row(1), row(2)], 14);
        Self::from_parts(linear, exponent, origin.bits().map(|c| i64::from(c) << 16))
    }

    /// From a row-major matrix for column vectors. Coefficients are rounded to within 2⁻³⁰ of the largest one (2⁻³¹ just below a
    /// power of two), the translation to within 2⁻³³ world units.
    ///
    /// # Errors
    ///
    /// [`MathError`] if the last row is not (0, 0, 0, 1), if a number is NaN or infinite, or if the translation is beyond
    /// ±2³⁰ world units.
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// let turn = [[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, -3.0], [0.0, 0.0, 0.0, 1.0]];
    /// let place = Affine::<Model, World>::from_matrix(&turn)?;
    /// assert_eq!(place.apply(Point3::from_ints(2, 0, 0)), Point3::from_ints(5, 2, -3));
    /// assert_eq!(place.to_matrix(), turn);
    /// # Ok::<(), pinhole::math::MathError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, MathError> {
        let [x, y, z, last] = *matrix;
        if last.iter().any(|number| !number.is_finite()) {
            return Err(MathError::NotFinite);
        }
        if last != [0.0, 0.0, 0.0, 1.0] {
            return Err(MathError::NotAffine);
        }
        let linear = [x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]];
        let (l, exponent) = float::common_exponent(linear).ok_or(MathError::NotFinite)?;
        let linear = [[l[0], l[1], l[2]], [l[3], l[4], l[5]], [l[6], l[7], l[8]]];
        let (linear, exponent) = rounded_block(&linear, exponent + 30);
        let translation = [x[3], y[3], z[3]];
        let part = |i: usize| float::to_fixed(translation[i], 32).ok_or(MathError::NotFinite);
        let offset = [part(0)?, part(1)?, part(2)?];
        if translation.iter().any(|t| t.abs() > 1_073_741_824.0) {
            return Err(MathError::OutOfRange);
        }
        Ok(Self::from_parts(linear, exponent, offset))
    }

    /// The row-major matrix for column vectors. Exact but for translations beyond 2²¹ world units, which are rounded to 53 bits.
    /// [`from_matrix`](Self::from_matrix) reads it back within its own bounds.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [x, y, z] = self.rows().map(|row| float::coefficients(&row, 0));
        [x, y, z, [0.0, 0.0, 0.0, 1.0]]
    }

    /// The inverse, `p = M⁻¹·p′`, from the cofactors.
    ///
    /// The error relative to the inverse's largest coefficient is at most 2⁻²⁸ times the ratio of the transform's largest
    /// stretch to its smallest. The translation is within 2⁻³³ of the exact one for the rounded coefficients.
    ///
    /// # Errors
    ///
    /// [`MathError::Singular`] if the rows of the linear part lie nearly in a plane: the magnitude of the determinant,
    /// divided by the product of the rows' lengths, is below a limit between 2⁻²⁵ and 2⁻²³.
    ///
    /// ```
    /// use pinhole::{math::MathError, prelude::*, Angle};
    /// let place = Affine::<Model, Model>::rotation_y(Angle::degrees(90))
    ///     .then(&Affine::<Model, World>::translation(Vector3::from_ints(3, 0, 0)));
    /// let there = place.apply(Point3::from_ints(0, 1, 2));
    /// assert_eq!(there, Point3::from_ints(5, 1, 0)); // z goes to x
    /// assert_eq!(place.inverse()?.apply(there), Point3::from_ints(0, 1, 2));
    /// let flat = Affine::<Model, World>::scale(Scalar::ZERO);
    /// assert_eq!(flat.inverse(), Err(MathError::Singular));
    /// # Ok::<(), MathError>(())
    /// ```
    pub fn inverse(&self) -> Result<Affine<B, A>, MathError> {
        let (cofactors, c_exponent) = cofactors(&self.linear);
        let (determinant, d_exponent) = determinant(&self.linear);
        if determinant == 0 || self.is_near_singular(determinant, d_exponent) {
            return Err(MathError::Singular);
        }
        // inverse = cofactorsᵀ / det: 30 bits over 61 bits. Each quotient has 31 bits after its
        // leading one; the block's exponent puts them together.
        let up = -shift_to_fit(determinant.unsigned_abs(), 62); // det < 2⁶²: never negative
        let divisor = determinant.unsigned_abs() << up.clamp(0, 62);
        let quotient = |c: i32| {
            // c < 2³¹ as a fraction of 2⁶¹ ≥ divisor/2: at most 2.
            let q = fraction(u64::from(c.unsigned_abs()) << 30, divisor, 32) as i64;
            if (c < 0) == (determinant < 0) {
                q
            } else {
                -q
            }
        };
        let linear = transposed(&cofactors).map(|row| row.map(quotient));
        // Values: c·2^(ce + 2e − 60) over det·2^(de + 3e − 90), so c/det · 2^(30 − e + ce − de), and the
        // quotient is c·2³⁰/(det·2^up) · 2³².
        let exponent = c_exponent - d_exponent - self.exponent;
        let (linear, exponent) = rounded_block(&linear, 30 + exponent - 30 - 32 + up + 30);
        Ok(self.inverse_from_linear(linear, exponent))
    }

    /// Whether the determinant is below 2⁻²⁴ of the product of the rows' lengths.
    fn is_near_singular(&self, determinant: i64, d_exponent: i32) -> bool {
        let length = |row: &[i32; 3]| {
            let square: u64 = row.iter().map(|c| u64::from(c.unsigned_abs()).pow(2)).sum(); // ≤ 3·2⁶⁰
            u64::from(sqrt(square)) // ≤ 2³⁰·⁸
        };
        let [a, b, c] = self.linear.each_ref().map(length);
        // det·2^(d_exponent − 60) against a·b·c·2⁻⁹⁰·2⁻²⁴.
        let ab = a * b; // ≤ 2⁶¹·⁶
        let down = shift_to_fit(ab, 31).max(0);
        let volume = (ab >> down) * c; // ≤ 2⁶²
        let shift = d_exponent + 54 - down;
        let (det, volume) = (determinant.unsigned_abs(), volume);
        // det · 2^shift < volume, without leaving 64 bits.
        if shift >= 0 {
            det < volume.checked_shr(shift as u32).unwrap_or(0)
        } else {
            det.checked_shr(shift.unsigned_abs()).unwrap_or(0) < volume
        }
    }

    /// The inverse, given its linear part L: the translation is `−L·o`.
    fn inverse_from_linear(&self, linear: [[i32; 3]; 3], exponent: i32) -> Affine<B, A> {
        let back = Affine::<B, A>::from_parts(linear, exponent, [0; 3]);
        let offset = back.apply_bits(&self.offset).map(|c| -c);
        Affine { offset, ..back }
    }

    /// This transform followed by `next`: the matrix product `next · self`. Coefficients are within 2⁻³⁰ of the largest one,
    /// the translation within 2⁻³³.
    pub fn then<C: SceneSpace>(&self, next: &Affine<B, C>) -> Affine<A, C> {
        let mut both = Affine::from_parts([[0; 3]; 3], 0, next.apply_bits(&self.offset));
        both.exponent =
            matrix_product(&next.linear, next.exponent, &self.linear, self.exponent, &mut both.linear);
        both
    }

    /// This transform followed by a [rotation about the x axis](Self::rotation_x) of `B`.
    ///
    /// ```
    /// use pinhole::{prelude::*, Angle};
    /// let quarter = Angle::degrees(90);
    /// let place = Affine::scale(Scalar::from_int(2)).rotate_z(quarter).translate(Vector3::from_ints(0, 0, -5));
    /// assert_eq!(place.apply(Point3::<Model>::from_ints(1, 0, 0)), Point3::<World>::from_ints(0, 2, -5));
    /// ```
    #[must_use]
    pub fn rotate_x(&self, angle: Angle) -> Self {
        self.then(&Affine::rotation_x(angle))
    }

    /// This transform followed by a [rotation about the y axis](Self::rotation_y) of `B`.
    #[must_use]
    pub fn rotate_y(&self, angle: Angle) -> Self {
        self.then(&Affine::rotation_y(angle))
    }

    /// This transform followed by a [rotation about the z axis](Self::rotation_z) of `B`.
    #[must_use]
    pub fn rotate_z(&self, angle: Angle) -> Self {
        self.then(&Affine::rotation_z(angle))
    }

    /// This transform followed by the translation by `t`: exact, but for translations that saturate at ±2³⁰.
    #[must_use]
    pub fn translate(&self, t: Vector3<B>) -> Self {
        let [x, y, z] = t.bits().map(|c| i64::from(c) << 16); // 48 bits
        let [a, b, c] = self.offset;
        Self { offset: [add(a, x), add(b, y), add(c, z)], ..*self }
    }

    /// The image of a point, rounded to 2⁻¹⁶ (within ½ + 2⁻¹⁷ of such a step) and saturated at the
    /// ends of [`Scalar`].
    pub fn apply(&self, p: Point3<A>) -> Point3<B> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        Point3::from_bits(self.apply_bits(&p).map(to_scalar))
    }

    /// The image of a point; both in 2⁻³².
    fn apply_bits(&self, p: &[i64; 3]) -> [i64; 3] {
        transform_point(&self.linear, self.exponent, p, &self.offset)
    }

    /// The linear part: coefficients `m · 2^(exponent − 30)`, row by row.
    pub(crate) fn linear(&self) -> (&[[i32; 3]; 3], i32) {
        (&self.linear, self.exponent)
    }

    /// The image of the origin minus `eye`, both in 2⁻³².
    pub(crate) fn offset_from(&self, eye: &[i64; 3]) -> [i64; 3] {
        let (mut away, mut i) = (self.offset, 0);
        while let (Some(a), Some(eye)) = (away.get_mut(i), eye.get(i)) {
            *a = add(*a, -eye);
            i = opaque_next(i);
        }
        away
    }

    fn rows(&self) -> [Row; 3] {
        let row = |i: usize| Row { linear: self.linear[i], exponent: self.exponent, offset: self.offset[i] };
        [row(0), row(1), row(2)]
    }
}

/// The rotation of a quaternion of `micromath`. Components are truncated to 2⁻³²; at lengths from 2⁻⁸ to 2¹⁵ the largest one keeps all
/// its 24 bits.
///
/// # Errors
///
/// [`MathError::ZeroLength`] if all components are below 2⁻³², [`NotFinite`](MathError::NotFinite) or
/// [`OutOfRange`](MathError::OutOfRange) if one is NaN, infinite or beyond ±32768.
impl<A: SceneSpace, B: SceneSpace> TryFrom<micromath::Quaternion> for Affine<A, B> {
    type Error = MathError;

    fn try_from(q: micromath::Quaternion) -> Result<Self, MathError> {
        let [w, x, y, z] = [q.w(), q.x(), q.y(), q.z()].map(|c| {
            if !c.is_finite() {
                Err(MathError::NotFinite)
            } else if !(-32_768.0..=32_768.0).contains(&c) {
                Err(MathError::OutOfRange)
            } else {
                // Exact: a float times a power of two; truncated below 2⁻³².
                Ok((f64::from(c) * 4_294_967_296.0) as i64)
            }
        });
        Self::from_parts_of_quaternion([w?, x?, y?, z?])
    }
}

/// The determinant of 30-bit rows, computed exactly and truncated to 62 bits, as `(mantissa, exponent)`: of coefficients in
/// 2⁻³⁰ it is `mantissa · 2^(exponent − 60)`.
fn determinant([x, y, z]: &[[i32; 3]; 3]) -> (i64, i32) {
    // Three products of at most 2³⁰ · 2⁶¹, in 2⁻⁹⁰.
    let exact: i128 = cross_exact(y, z).iter().zip(x).map(|(&c, &m)| i128::from(c) * i128::from(m)).sum();
    let shift = (128 - 62 - exact.unsigned_abs().leading_zeros() as i32).max(0);
    ((exact >> shift) as i64, shift - 30)
}

/// The cofactor matrix det(A)·A⁻ᵀ, whose rows are cross products of A's rows: 30 bits, and the block's exponent for products
/// in 2⁻⁶⁰.
pub(crate) fn cofactors([x, y, z]: &[[i32; 3]; 3]) -> ([[i32; 3]; 3], i32) {
    rounded_block(&[cross_exact(y, z), cross_exact(z, x), cross_exact(x, y)], -30)
}

/// Converts from 2⁻³² to 2⁻¹⁶: rounded to nearest, saturated.
pub(crate) fn to_scalar(v: i64) -> i32 {
    scale(v, -16).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// The matrix product `a · b` of two blocks of 30-bit coefficients into `linear`; returns its exponent.
#[inline(never)] // set-up: code size counts
pub(crate) fn matrix_product(
    a: &[[i32; 3]; 3],
    a_exponent: i32,
    b: &[[i32; 3]; 3],
    b_exponent: i32,
    linear: &mut [[i32; 3]; 3],
) -> i32 {
    let [x, y, z] = a;
    let sums = [row_times(x, b), row_times(y, b), row_times(z, b)];
    // Exponents stay far inside i32: each factor's lies in ±2¹⁶ by the clamp, and a little more after an inverse.
    let exponent = a_exponent + b_exponent - 30;
    block_scaled(sums.as_flattened(), exponent, linear.as_flattened_mut()).clamp(-65_536, 65_536)
}

/// Rounds sums of products to rows of 30 bits with one exponent.
#[inline(never)] // set-up: code size counts
fn rounded_block(sums: &[[i64; 3]; 3], exponent: i32) -> ([[i32; 3]; 3], i32) {
    // Low words, which are overwritten: LLVM would clear an array of zeros by a library function.
    let mut linear = sums.map(|row| row.map(|sum| sum as i32));
    let exponent = block_scaled(sums.as_flattened(), exponent, linear.as_flattened_mut());
    (linear, exponent)
}

defmt_format!(
    [A, B] Affine<A, B>, self,
    "{} * 2^({=i32} - 30), {}/2^32", self.linear, self.exponent, self.offset
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Model, World};

    /// A transform whose determinant equals the limit has an inverse; one unit below the limit it has none.
    #[test]
    fn flat_is_below_the_limit_not_at_it() {
        // Rows of length 2²⁹: their product, 2⁸⁷·2⁻⁹⁰, times 2⁻²⁴ is 2⁻²⁷. So is a determinant of 2³³·2⁻⁶⁰.
        let axes = Affine::<World, World>::from_parts(
            [[1 << 29, 0, 0], [0, 1 << 29, 0], [0, 0, 1 << 29]],
            1,
            [0; 3],
        );
        for (at, exponent) in [(1 << 33, 0), (1 << 61, -28)] {
            for det in [at, -at] {
                assert!(!axes.is_near_singular(det, exponent), "{det} at exponent {exponent}");
            }
            for det in [at - 1, 1 - at] {
                assert!(axes.is_near_singular(det, exponent), "{det} at exponent {exponent}");
            }
        }
    }

    /// A chain is the composition of its steps, bit for bit.
    #[test]
    fn chains_compose() {
        let (angle, t) = (Angle::degrees(25), Vector3::from_ints(1, -2, 30_000));
        let base =
            Affine::<Model, World>::rotation_y(Angle::degrees(70)).translate(Vector3::from_ints(5, 6, 7));
        let steps = [Affine::rotation_x(angle), Affine::rotation_y(angle), Affine::rotation_z(angle)];
        let chained = [base.rotate_x(angle), base.rotate_y(angle), base.rotate_z(angle)];
        for (step, chained) in steps.iter().zip(chained) {
            assert_eq!(base.then(step), chained);
        }
        assert_eq!(base.translate(t).offset, base.then(&Affine::translation(t)).offset);
        assert_eq!(base.translate(t).linear, base.linear);
    }

    #[test]
    fn extremes_saturate_and_never_panic() {
        let huge = Affine::<World, World>::scale(Scalar::MAX);
        let mut grown = huge;
        for _ in 0..6000 {
            grown = grown.then(&huge);
        }
        let p = grown.apply(Point3::from_ints(1, -1, 0));
        assert_eq!(p, Point3::new(Scalar::MAX, Scalar::MIN, Scalar::ZERO));
        let tiny = Affine::<World, World>::scale(Scalar::from_bits(1));
        let mut shrunk = tiny;
        for _ in 0..6000 {
            shrunk = shrunk.then(&tiny);
        }
        assert_eq!(shrunk.apply(Point3::from_ints(i16::MAX, i16::MIN, 1)), Point3::from_ints(0, 0, 0));
        let zero = Affine::<Model, World>::scale(Scalar::ZERO);
        assert_eq!(zero.apply(Point3::from_ints(5, 6, 7)), Point3::from_ints(0, 0, 0));
    }
}
