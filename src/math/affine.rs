//! Affine transforms between the spaces a scene is set up in.

use super::float;
use super::num::{add, after, dot, excess, fraction, row_times, scale, sqrt, transposed};
use super::row::{block, forms, Row};
use super::unit::{cross_exact, is_zero, normalise};
use super::{Angle, Point3, Quaternion, Scalar, Vector3};
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
/// Vectors are columns, so `M · p`; [`then`](Self::then) reads left to right. Each composition rounds coefficients
/// to within 2⁻³⁰ of the largest one, and the translation to within 2⁻³³ world units; translations saturate at
/// ±2³⁰. Rebuild transforms from angles every frame instead of accumulating them: then nothing drifts. (A million
/// turns of 0.1°, each applied to the matrix so far, stretch a model by 0.037 % and leave it 0.057° behind.)
///
/// `==` compares the stored numbers: the same map reached in two ways may differ. Compare
/// [`to_matrix`](Self::to_matrix).
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

    /// The same factor along all axes, exact below 16384 and within 2⁻³⁰ of itself above. Zero flattens everything
    /// into the origin, which draws nothing.
    pub fn scale(factor: Scalar) -> Self {
        Self::scale_axes(factor, factor, factor)
    }

    /// A factor for each axis; exact where the factors span no more than 30 bits, otherwise within
    /// 2⁻³⁰ of the largest. A negative one mirrors, and a mirrored mesh shows the inner sides of its faces.
    pub fn scale_axes(x: Scalar, y: Scalar, z: Scalar) -> Self {
        let [x, y, z] = [x, y, z].map(|f| i64::from(f.to_bits()));
        // Value = bits · 2⁻¹⁶ = bits · 2^(14 − 30).
        let (linear, exponent) = rounded(&[[x, 0, 0], [0, y, 0], [0, 0, z]], 14);
        Self::from_parts(linear, exponent, [0; 3])
    }

    /// About the x axis, from y towards z: `|1 0 0; 0 c −s; 0 s c|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_x(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[ONE, 0, 0], [0, c, -s], [0, s, c]], 0, [0; 3])
    }

    /// About the y axis, from z towards x: `|c 0 s; 0 1 0; −s 0 c|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_y(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, 0, s], [0, ONE, 0], [-s, 0, c]], 0, [0; 3])
    }

    /// About the z axis, from x towards y: `|c −s 0; s c 0; 0 0 1|`. Coefficients within 2⁻²⁹·⁵.
    pub const fn rotation_z(angle: Angle) -> Self {
        let (s, c) = angle.sin_cos();
        Self::from_parts([[c, -s, 0], [s, c, 0], [0, 0, ONE]], 0, [0; 3])
    }

    /// About the line through `through` along `axis` (any length), right-handed: `R = c·I + (1 − c)·a·aᵀ + s·[a]×`
    /// and the translation `through − R·through`. Coefficients are within 2⁻²⁷; the translation is within 2⁻³³
    /// world units of the one that belongs to these coefficients. (Rodrigues 1840; Goldman, *Matrices and
    /// transformations*, Graphics Gems, 1990.)
    ///
    /// ```
    /// use pinhole::{space::World, Affine, Angle, AxisError, Point3, Vector3};
    /// let (through, axis) = (Point3::from_ints(1, 0, 0), Vector3::from_ints(0, 0, 7));
    /// let half = Affine::<World, World>::rotation(through, axis, Angle::HALF_TURN)?;
    /// assert_eq!(half.apply(Point3::from_ints(3, 4, 5)), Point3::from_ints(-1, -4, 5));
    /// # Ok::<(), AxisError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`AxisError::ZeroAxis`] for an axis of length zero.
    pub fn rotation(through: Point3<B>, axis: Vector3<B>, angle: Angle) -> Result<Self, AxisError> {
        let axis = normalise(&axis.bits().map(i64::from));
        if is_zero(&axis) {
            return Err(AxisError::ZeroAxis);
        }
        let (s, c) = angle.sin_cos();
        let versine = i64::from(ONE) - i64::from(c); // 0 … 2³¹
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
        Ok(Self::about(linear, through))
    }

    /// The rotation that a quaternion describes. Coefficients within 2⁻²⁷.
    /// (Shoemake, *Animating rotation with quaternion curves*, 1985.)
    pub fn from_quaternion(quaternion: Quaternion) -> Self {
        let [w, x, y, z] = quaternion.parts().map(i64::from);
        // Twice a product of 30-bit numbers, to 2⁻³⁰.
        let twice = |sum: i64| scale(sum, -29);
        let one = i64::from(ONE);
        let linear = [
            [one - twice(y * y + z * z), twice(x * y - w * z), twice(x * z + w * y)],
            [twice(x * y + w * z), one - twice(x * x + z * z), twice(y * z - w * x)],
            [twice(x * z - w * y), twice(y * z + w * x), one - twice(x * x + y * y)],
        ];
        Self::about(linear, Point3::from_ints(0, 0, 0))
    }

    /// A linear part in 2⁻³⁰, up to 31 bits, that leaves one point where it is.
    fn about(linear: [[i64; 3]; 3], fixed: Point3<B>) -> Self {
        let (linear, exponent) = rounded(&linear, 0);
        let turned = Self::from_parts(linear, exponent, [0; 3]);
        let at = fixed.bits().map(|c| i64::from(c) << 16);
        let [x, y, z] = turned.apply_bits(&at);
        Self { offset: [add(at[0], -x), add(at[1], -y), add(at[2], -z)], ..turned }
    }

    /// The frame with these axes and origin: columns a, b, c, o. It leads from the frame's own
    /// coordinates to those in which it is given. Exact where the axes span no more than 30 bits,
    /// otherwise within 2⁻³⁰ of the largest coefficient.
    ///
    /// ```
    /// use pinhole::{space::{Model, World}, Affine, Point3, Vector3};
    /// // What lies along the model's x, y and z lies along the world's y, z and x, twice as long along the first.
    /// let [a, b, c] = [[0, 2, 0], [0, 0, 1], [1, 0, 0]].map(|[x, y, z]| Vector3::from_ints(x, y, z));
    /// let place = Affine::<Model, World>::from_frame(a, b, c, Point3::from_ints(10, 0, 0));
    /// assert_eq!(place.apply(Point3::from_ints(1, 3, 5)), Point3::from_ints(15, 2, 3));
    /// ```
    #[inline(never)] // set-up: small is better
    pub fn from_frame(a: Vector3<B>, b: Vector3<B>, c: Vector3<B>, origin: Point3<B>) -> Self {
        let (a, b, c) = (a.bits(), b.bits(), c.bits());
        let row = |i: usize| [a[i], b[i], c[i]].map(i64::from);
        let (linear, exponent) = rounded(&[row(0), row(1), row(2)], 14);
        Self::from_parts(linear, exponent, origin.bits().map(|c| i64::from(c) << 16))
    }

    /// From a matrix, row by row, for column vectors: coefficients are kept within 2⁻³⁰ of the largest
    /// one (2⁻³¹ just below a power of two), the translation within 2⁻³³.
    ///
    /// # Errors
    ///
    /// [`MatrixError`] for a last row other than (0, 0, 0, 1), NaN and infinities, and translations
    /// beyond ±2³⁰ world units.
    ///
    /// ```
    /// use pinhole::{space::{Model, World}, Affine, MatrixError, Point3};
    /// let turn = [[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, -3.0], [0.0, 0.0, 0.0, 1.0]];
    /// let place = Affine::<Model, World>::from_matrix(&turn)?;
    /// assert_eq!(place.apply(Point3::from_ints(2, 0, 0)), Point3::from_ints(5, 2, -3));
    /// assert_eq!(place.to_matrix(), turn);
    /// # Ok::<(), MatrixError>(())
    /// ```
    pub fn from_matrix(matrix: &[[f64; 4]; 4]) -> Result<Self, MatrixError> {
        let [x, y, z, last] = *matrix;
        if last != [0.0, 0.0, 0.0, 1.0] {
            return Err(MatrixError::NotAffine);
        }
        let linear = [x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]];
        let (l, exponent) = float::aligned(linear).ok_or(MatrixError::NotFinite)?;
        let linear = [[l[0], l[1], l[2]], [l[3], l[4], l[5]], [l[6], l[7], l[8]]];
        let (linear, exponent) = rounded(&linear, exponent + 30);
        let translation = [x[3], y[3], z[3]];
        let part = |i: usize| float::fixed(translation[i], 32).ok_or(MatrixError::NotFinite);
        let offset = [part(0)?, part(1)?, part(2)?];
        if translation.iter().any(|t| t.abs() > 1_073_741_824.0) {
            return Err(MatrixError::OutOfRange);
        }
        Ok(Self::from_parts(linear, exponent, offset))
    }

    /// The matrix, row by row; the translation is rounded to 53 bits where it needs more, beyond 2²¹ world units.
    /// [`from_matrix`](Self::from_matrix) reads it back, to within its own bounds.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let [x, y, z] = self.rows().map(|row| float::coefficients(&row, 0));
        [x, y, z, [0.0, 0.0, 0.0, 1.0]]
    }

    /// The inverse, `p = M⁻¹·p′`, from the cofactors.
    ///
    /// The error relative to the inverse's largest coefficient is at most 2⁻²⁸ times the ratio
    /// of the transform's largest stretch to its smallest; the translation, given the coefficients, is
    /// within 2⁻³³.
    ///
    /// # Errors
    ///
    /// [`InverseError::Singular`] where the axes lie in a plane: the determinant, relative to the
    /// product of the rows' lengths, is below about 2⁻²⁴ (2⁻²⁵ … 2⁻²³).
    ///
    /// ```
    /// use pinhole::{space::{Model, World}, Affine, Angle, InverseError, Point3, Scalar, Vector3};
    /// let place = Affine::<Model, Model>::rotation_y(Angle::degrees(90))
    ///     .then(&Affine::<Model, World>::translation(Vector3::from_ints(3, 0, 0)));
    /// let there = place.apply(Point3::from_ints(0, 1, 2));
    /// assert_eq!(there, Point3::from_ints(5, 1, 0)); // z goes to x
    /// assert_eq!(place.inverse()?.apply(there), Point3::from_ints(0, 1, 2));
    /// assert_eq!(place.rigid_inverse()?.apply(there), Point3::from_ints(0, 1, 2));
    /// let flat = Affine::<Model, World>::scale(Scalar::ZERO);
    /// assert_eq!(flat.inverse(), Err(InverseError::Singular));
    /// # Ok::<(), InverseError>(())
    /// ```
    pub fn inverse(&self) -> Result<Affine<B, A>, InverseError> {
        let (cofactors, c_exponent) = cofactors(&self.linear);
        let (determinant, d_exponent) = determinant(&self.linear);
        if determinant == 0 || self.flatness(determinant, d_exponent) {
            return Err(InverseError::Singular);
        }
        // inverse = cofactorsᵀ / det: 30 bits over 61 bits. Each quotient has 31 bits after its
        // leading one; the block's exponent puts them together.
        let up = -excess(determinant.unsigned_abs(), 62); // det < 2⁶²: never negative
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
        let (linear, exponent) = rounded(&linear, 30 + exponent - 30 - 32 + up + 30);
        Ok(self.returning(linear, exponent))
    }

    /// Whether the determinant is too small beside the rows for an inverse.
    fn flatness(&self, determinant: i64, d_exponent: i32) -> bool {
        let length = |row: &[i32; 3]| {
            let square: u64 = row.iter().map(|c| u64::from(c.unsigned_abs()).pow(2)).sum(); // ≤ 3·2⁶⁰
            u64::from(sqrt(square)) // ≤ 2³⁰·⁸
        };
        let [a, b, c] = self.linear.each_ref().map(length);
        // det·2^(d_exponent − 60) against a·b·c·2⁻⁹⁰·2⁻²⁴.
        let ab = a * b; // ≤ 2⁶¹·⁶
        let down = excess(ab, 31).max(0);
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

    /// The inverse of a rigid transform, a rotation, mirrored or not, and a shift: `Rᵀ` and `−Rᵀ·o`, with no
    /// division and no loss but the rounding of the translation, 2⁻³³.
    ///
    /// # Errors
    ///
    /// [`InverseError::NotRigid`] where a row's square is not 1, or the product of two not 0, to 2⁻²⁰.
    pub fn rigid_inverse(&self) -> Result<Affine<B, A>, InverseError> {
        let [x, y, z] = &self.linear;
        // In 2⁻⁶⁰ for a block of exponent 0; a rotation's largest coefficient is above ½, and 1 has exponent 1.
        let one = scale(1 << 60, -2 * self.exponent);
        let near = |value: i64, wanted: i64| (value - wanted).abs() <= one >> 20;
        let rigid = [x, y, z].iter().all(|row| near(dot(row, row), one))
            && near(dot(x, y), 0)
            && near(dot(y, z), 0)
            && near(dot(z, x), 0);
        if !matches!(self.exponent, 0 | 1) || !rigid {
            return Err(InverseError::NotRigid);
        }
        Ok(self.returning(transposed(&self.linear), self.exponent))
    }

    /// The inverse with this linear part: `−L·o` brings this transform's origin back.
    fn returning(&self, linear: [[i32; 3]; 3], exponent: i32) -> Affine<B, A> {
        let back = Affine::<B, A>::from_parts(linear, exponent, [0; 3]);
        let offset = back.apply_bits(&self.offset).map(|c| -c);
        Affine { offset, ..back }
    }

    /// First this, then `next`: the matrix product `next · self`, coefficients within 2⁻³⁰ of the
    /// largest one, the translation within 2⁻³³.
    pub fn then<C: SetUp>(&self, next: &Affine<B, C>) -> Affine<A, C> {
        let mut both = Affine::from_parts([[0; 3]; 3], 0, next.apply_bits(&self.offset));
        both.exponent = product(&next.linear, next.exponent, &self.linear, self.exponent, &mut both.linear);
        both
    }

    /// The image of a point, rounded to 2⁻¹⁶ (within ½ + 2⁻¹⁷ of such a step) and saturated at the
    /// ends of [`Scalar`].
    pub fn apply(&self, p: Point3<A>) -> Point3<B> {
        let p = p.bits().map(|c| i64::from(c) << 16);
        Point3::from_bits(self.apply_bits(&p).map(to_scalar))
    }

    /// The image of a point in 2⁻³², in 2⁻³².
    fn apply_bits(&self, p: &[i64; 3]) -> [i64; 3] {
        forms(&self.linear, self.exponent, p, &self.offset)
    }

    /// The linear part: coefficients `m · 2^(exponent − 30)`, row by row.
    pub(crate) fn linear(&self) -> (&[[i32; 3]; 3], i32) {
        (&self.linear, self.exponent)
    }

    /// Where the origin goes, relative to `eye`, both in 2⁻³².
    pub(crate) fn offset_from(&self, eye: &[i64; 3]) -> [i64; 3] {
        let (mut away, mut i) = (self.offset, 0);
        while let (Some(a), Some(eye)) = (away.get_mut(i), eye.get(i)) {
            *a = add(*a, -eye);
            i = after(i);
        }
        away
    }

    fn rows(&self) -> [Row; 3] {
        let row = |i: usize| Row { linear: self.linear[i], exponent: self.exponent, offset: self.offset[i] };
        [row(0), row(1), row(2)]
    }
}

/// Why there is no rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AxisError {
    /// The axis has length zero: give a direction.
    ZeroAxis,
}

impl core::fmt::Display for AxisError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("the axis of rotation has length zero")
    }
}

impl core::error::Error for AxisError {}

/// Why a matrix is no affine map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MatrixError {
    /// The last row must be (0, 0, 0, 1): a projection is no [`Affine`].
    NotAffine,
    /// A number is NaN or infinite: look where it was computed.
    NotFinite,
    /// The translation leaves ±2³⁰ world units: choose a larger unit.
    OutOfRange,
}

impl core::fmt::Display for MatrixError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotAffine => "the last row of an affine matrix is 0 0 0 1",
            Self::NotFinite => "the matrix has a number that is not finite",
            Self::OutOfRange => "the translation is out of range: choose a larger unit",
        })
    }
}

impl core::error::Error for MatrixError {}

/// Why a transform has no inverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum InverseError {
    /// The transform flattens space: no scale may be zero, no axis lie in the plane of the others.
    Singular,
    /// The transform scales or shears: take [`Affine::inverse`].
    NotRigid,
}

impl core::fmt::Display for InverseError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Singular => "the transform flattens space and has no inverse",
            Self::NotRigid => "the transform is not rigid: take the general inverse",
        })
    }
}

impl core::error::Error for InverseError {}

/// The determinant of 30-bit rows: exact, then rounded to 62 bits; of the cubed block it is
/// `result · 2^(exponent − 60)`.
fn determinant([x, y, z]: &[[i32; 3]; 3]) -> (i64, i32) {
    // Three products of at most 2³⁰ · 2⁶¹, in 2⁻⁹⁰.
    let exact: i128 = cross_exact(y, z).iter().zip(x).map(|(&c, &m)| i128::from(c) * i128::from(m)).sum();
    let shift = (128 - 62 - exact.unsigned_abs().leading_zeros() as i32).max(0);
    ((exact >> shift) as i64, shift - 30)
}

/// det(A)·A⁻ᵀ, whose rows are the cross products of A's: 30 bits, and the exponent of the block
/// relative to 2⁻³⁰ for products in 2⁻⁶⁰.
pub(crate) fn cofactors([x, y, z]: &[[i32; 3]; 3]) -> ([[i32; 3]; 3], i32) {
    rounded(&[cross_exact(y, z), cross_exact(z, x), cross_exact(x, y)], -30)
}

/// 2⁻³² to 2⁻¹⁶, rounded to nearest, saturated.
pub(crate) fn to_scalar(v: i64) -> i32 {
    scale(v, -16).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `a · b` for two blocks.
#[inline(never)] // set-up: small is better
pub(crate) fn product(
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
    block(sums.as_flattened(), exponent, linear.as_flattened_mut()).clamp(-65_536, 65_536)
}

/// Sums of products as rows of 30 bits and one exponent.
#[inline(never)] // set-up: small is better
fn rounded(sums: &[[i64; 3]; 3], exponent: i32) -> ([[i32; 3]; 3], i32) {
    let mut linear = [[0; 3]; 3];
    let exponent = block(sums.as_flattened(), exponent, linear.as_flattened_mut());
    (linear, exponent)
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

    /// Where the determinant equals the limit, a transform still has an inverse; one unit below, it has none.
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
                assert!(!axes.flatness(det, exponent), "{det} at exponent {exponent}");
            }
            for det in [at - 1, 1 - at] {
                assert!(axes.flatness(det, exponent), "{det} at exponent {exponent}");
            }
        }
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
