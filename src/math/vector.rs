//! Operators and products of points and vectors. All saturate at the ends of [`Scalar`], per coordinate, and never wrap or
//! panic.

use super::num::{scale, sqrt, Accumulator};
use super::scalar::saturated;
use super::{Point3, Scalar, Vector3};
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// `a + sign · b`, coordinate by coordinate, saturating: 33 bits before.
fn sum([a, b, c]: [i32; 3], [x, y, z]: [i32; 3], sign: i64) -> [i32; 3] {
    let plus = |a: i32, b: i32| saturated(i64::from(a) + sign * i64::from(b));
    [plus(a, x), plus(b, y), plus(c, z)]
}

/// A sum of products of two 32-bit numbers, or of one with 33 bits, in 2⁻³², rounded to 2⁻¹⁶ and saturated.
fn rounded(products: Accumulator) -> i32 {
    saturated(products.scaled(-16))
}

macro_rules! sums {
    ($($left:ident $operator:ident $method:ident $right:ident = $result:ident, $sign:literal, $text:literal;)*) => {$(
        #[doc = $text]
        impl<S> $operator<$right<S>> for $left<S> {
            type Output = $result<S>;

            fn $method(self, other: $right<S>) -> $result<S> {
                $result::from_bits(sum(self.bits(), other.bits(), $sign))
            }
        }
    )*};
}

sums! {
    Vector3 Add add Vector3 = Vector3, 1, "The sum of two vectors; each coordinate saturates at ±32768.";
    Vector3 Sub sub Vector3 = Vector3, -1, "The difference of two vectors; each coordinate saturates at ±32768.";
    Point3 Add add Vector3 = Point3, 1, "The point moved by a vector; each coordinate saturates at ±32768.";
    Point3 Sub sub Vector3 = Point3, -1, "The point moved back by a vector; each coordinate saturates at ±32768.";
    Point3 Sub sub Point3 = Vector3, -1, "The vector from the second point to the first; each coordinate saturates at ±32768.";
}

macro_rules! assignments {
    ($($name:ident)*) => {$(
        /// Moves by a vector; each coordinate saturates at ±32768.
        impl<S> AddAssign<Vector3<S>> for $name<S> {
            fn add_assign(&mut self, other: Vector3<S>) {
                *self = *self + other;
            }
        }

        /// Moves back by a vector; each coordinate saturates at ±32768.
        impl<S> SubAssign<Vector3<S>> for $name<S> {
            fn sub_assign(&mut self, other: Vector3<S>) {
                *self = *self - other;
            }
        }
    )*};
}

assignments!(Point3 Vector3);

/// The opposite vector; −32768 becomes the largest [`Scalar`].
impl<S> Neg for Vector3<S> {
    type Output = Self;

    fn neg(self) -> Self {
        Self::from_bits(sum([0; 3], self.bits(), -1))
    }
}

/// The vector times a factor: each coordinate rounded to the nearest 2⁻¹⁶ (ties up), saturating at ±32768.
impl<S> Mul<Scalar> for Vector3<S> {
    type Output = Self;

    fn mul(self, factor: Scalar) -> Self {
        let times = |c: i32| saturated(scale(i64::from(c) * i64::from(factor.to_bits()), -16)); // ≤ 2⁶²
        Self::from_bits(self.bits().map(times))
    }
}

impl<S> Vector3<S> {
    /// The dot product: the exact sum, rounded to the nearest 2⁻¹⁶ (ties up), saturating at ±32768.
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// let (a, b) = (Vector3::<World>::from_ints(1, 2, 3), Vector3::from_ints(4, -5, 6));
    /// assert_eq!(a.dot(b), Scalar::from_int(12));
    /// ```
    pub fn dot(self, other: Self) -> Scalar {
        let ([a, b, c], [x, y, z]) = (self.bits(), other.bits().map(i64::from));
        Scalar::from_bits(rounded(Accumulator::ZERO.plus(a, x).carried().plus(b, y).carried().plus(c, z)))
    }

    /// The cross product, right-handed: each coordinate exact, rounded to the nearest 2⁻¹⁶ (ties up), saturating at ±32768.
    ///
    /// ```
    /// use pinhole::{space::World, Vector3};
    /// let [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|[x, y, z]| Vector3::<World>::from_ints(x, y, z));
    /// assert_eq!(x.cross(y), z);
    /// ```
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.bits(), other.bits().map(i64::from));
        let minus =
            |a: i32, b: i64, c: i32, d: i64| rounded(Accumulator::ZERO.plus(a, b).carried().plus(c, -d));
        Self::from_bits([minus(b, z, c, y), minus(c, x, a, z), minus(a, y, b, x)])
    }

    /// The length: within 2⁻¹⁷ (rounded to the nearest 2⁻¹⁶), saturating at 32768.
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// assert_eq!(Vector3::<World>::from_ints(2, 3, -6).length(), Scalar::from_int(7));
    /// ```
    pub fn length(self) -> Scalar {
        let [x, y, z] = self.bits().map(|c| u64::from(c.unsigned_abs()));
        let length = sqrt(x * x + y * y + z * z); // ≤ 3·2⁶²; the root of a number in 2⁻³² is in 2⁻¹⁶
        Scalar::from_bits(saturated(length.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::mixed;
    use crate::space::World;

    type V = Vector3<World>;

    /// Random coordinates of all sizes, and the extremes.
    fn vectors() -> impl Iterator<Item = (V, V, Scalar)> {
        let mut state = 17;
        let mut number = move || match mixed(&mut state) % 9 {
            0 => i32::MIN,
            1 => i32::MAX,
            k => (mixed(&mut state) as i32) >> (k * 3),
        };
        (0..20_000).map(move |_| {
            let mut vector = || Vector3::from_bits([number(), number(), number()]);
            (vector(), vector(), Scalar::from_bits(number()))
        })
    }

    fn nearest(exact: i128, down: u32) -> i32 {
        let rounded = if down == 0 { exact } else { (exact + (1 << (down - 1))) >> down };
        rounded.clamp(i32::MIN.into(), i32::MAX.into()) as i32
    }

    #[test]
    fn products_and_sums_are_exact_then_rounded_and_saturated() {
        for (a, b, t) in vectors() {
            let ([p, q, r], [x, y, z]) = (a.bits().map(i128::from), b.bits().map(i128::from));
            let factor = i128::from(t.to_bits());
            assert_eq!((a + b).bits(), [p + x, q + y, r + z].map(|v| nearest(v, 0)));
            assert_eq!((a - b).bits(), [p - x, q - y, r - z].map(|v| nearest(v, 0)));
            assert_eq!((-a).bits(), [-p, -q, -r].map(|v| nearest(v, 0)));
            assert_eq!((a * t).bits(), [p, q, r].map(|v| nearest(v * factor, 16)));
            assert_eq!(a.dot(b).to_bits(), nearest(p * x + q * y + r * z, 16));
            let cross = [q * z - r * y, r * x - p * z, p * y - q * x];
            assert_eq!(a.cross(b).bits(), cross.map(|v| nearest(v, 16)));
            let (from, to) = (Point3::<World>::from_bits(a.bits()), Point3::from_bits(b.bits()));
            assert_eq!((from - to).bits(), (a - b).bits());
            assert_eq!((from + b).bits(), (a + b).bits());
            assert_eq!((from - b).bits(), (a - b).bits());
            let (mut moved, mut back, mut grown) = (from, from, a);
            moved += b;
            back -= b;
            grown += b;
            assert_eq!((moved, back, grown), (from + b, from - b, a + b));
            grown = a;
            grown -= b;
            assert_eq!(grown, a - b);
        }
    }

    #[test]
    fn lengths_are_rounded_to_nearest() {
        for (a, ..) in vectors() {
            let square: u128 = a.bits().iter().map(|&c| u128::from(c.unsigned_abs()).pow(2)).sum();
            let length = a.length().to_bits();
            if length == i32::MAX {
                assert!(4 * square >= (2 * (1_u128 << 31) - 3).pow(2));
                continue;
            }
            let length = length as u128;
            assert!(4 * square <= (2 * length + 1).pow(2));
            assert!(length == 0 || 4 * square >= (2 * length - 1).pow(2));
        }
    }
}
