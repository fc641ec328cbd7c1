//! Points and vectors, tagged with their space.

use super::Scalar;
use crate::math::MathError;
use core::fmt::{Debug, Formatter};
use core::marker::PhantomData;

/// A point of space `S`: three [`Scalar`]s, ±32768 units of the space in steps of 2⁻¹⁶.
///
/// ```
/// use pinhole::prelude::*;
/// let p = Point3::<World>::from_ints(1, -2, 3);
/// assert_eq!(p, Point3::from_f32(1.0, -2.0, 3.0)?);
/// assert_eq!(p.z(), Scalar::from_int(3));
/// # Ok::<(), pinhole::math::MathError>(())
/// ```
#[derive(PartialEq, Eq)]
pub struct Point3<S> {
    bits: [i32; 3],
    space: PhantomData<S>,
}

/// A direction or difference in space `S`, of any length: three [`Scalar`]s.
#[derive(PartialEq, Eq)]
pub struct Vector3<S> {
    bits: [i32; 3],
    space: PhantomData<S>,
}

macro_rules! coordinates {
    ($name:ident) => {
        impl<S> $name<S> {
            /// From coordinates in units of the space, exact. [`Scalar`] says how to make one.
            ///
            /// ```compile_fail,E0308
            /// let at = pinhole::Point3::<pinhole::space::World>::new(0.0, 1.0, 2.0); // f32: use from_f32
            /// ```
            // The compiler shows the comment of the next line for an argument of another type.
            pub const fn new(x: Scalar, y: Scalar, z: Scalar) -> Self /* Scalar::from_int(2), from_ratio(1, 2), from_f32(0.5)? */ {
                Self::from_bits([x.to_bits(), y.to_bits(), z.to_bits()])
            }

            /// From coordinates in whole units of the space, exact.
            pub const fn from_ints(x: i16, y: i16, z: i16) -> Self {
                // An i16 times 2¹⁶ fits 32 bits.
                Self::from_bits([(x as i32) << 16, (y as i32) << 16, (z as i32) << 16])
            }

            /// From floating-point numbers, each rounded to the nearest 2⁻¹⁶, ties away from zero.
            ///
            /// # Errors
            ///
            /// [`MathError`] when a number is NaN, infinite or outside ±32768.
            pub fn from_f32(x: f32, y: f32, z: f32) -> Result<Self, MathError> {
                Ok(Self::new(Scalar::from_f32(x)?, Scalar::from_f32(y)?, Scalar::from_f32(z)?))
            }

            pub(crate) const fn from_bits(bits: [i32; 3]) -> Self {
                Self { bits, space: PhantomData }
            }

            /// The coordinates in 2⁻¹⁶ units of the space.
            pub(crate) const fn bits(self) -> [i32; 3] {
                self.bits
            }

            /// The x coordinate, in units of the space, step 2⁻¹⁶.
            pub const fn x(self) -> Scalar {
                Scalar::from_bits(self.bits[0])
            }

            /// The y coordinate, in units of the space, step 2⁻¹⁶.
            pub const fn y(self) -> Scalar {
                Scalar::from_bits(self.bits[1])
            }

            /// The z coordinate, in units of the space, step 2⁻¹⁶.
            pub const fn z(self) -> Scalar {
                Scalar::from_bits(self.bits[2])
            }
        }

        /// The coordinates in decimals.
        impl<S> Debug for $name<S> {
            fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
                let [x, y, z] = self.bits.map(Scalar::from_bits);
                write!(f, "{}({x}, {y}, {z})", stringify!($name))
            }
        }
        // Not derived: a tag need not be Copy for its point to be.
        impl<S> Clone for $name<S> {
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<S> Copy for $name<S> {}

        defmt_format!(
            [S] $name<S>, self,
            "({=i32}, {=i32}, {=i32})/65536", self.bits[0], self.bits[1], self.bits[2]
        );
    };
}

coordinates!(Point3);
coordinates!(Vector3);

/// From a vector of `micromath`, as sensor filters deliver it: rounded like [`Vector3::from_f32`].
///
/// # Errors
///
/// [`MathError`] when a number is NaN, infinite or outside ±32768.
impl<S> TryFrom<micromath::vector::F32x3> for Vector3<S> {
    type Error = MathError;

    fn try_from(v: micromath::vector::F32x3) -> Result<Self, MathError> {
        Self::from_f32(v.x, v.y, v.z)
    }
}
