//! The public fixed-point number.

use super::form::sealed::Sealed;
use super::num::divide;
use super::Coordinate;
use crate::math::MathError;
use core::fmt::{Debug, Display, Formatter, Write};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
#[cfg(feature = "fixed")]
use fixed::types::I16F16;
use heapless::String;

/// A fixed-point number: 16 integer and 16 fractional bits, ±32768 in steps of 2⁻¹⁶.
///
/// | from | by |
/// |---|---|
/// | a whole number | [`Scalar::from_int`], or `.into()` from an `i16` |
/// | a fraction, such as 2/5 for 0.4 | [`Scalar::from_ratio`] |
/// | an `f32` or `f64` | [`Scalar::from_f32`], [`Scalar::try_from`], with an error for NaN and for numbers out of range |
/// | an `I16F16` of the crate `fixed`, which also reads text | `.into()`, which converts back, too, with the feature `fixed` |
///
/// `f64::from` gives the number back, exact. Operators saturate: a result beyond the range is [`Scalar::MIN`] or [`Scalar::MAX`]. Sums, differences and negation are exact
/// within the range. Products are rounded to the nearest 2⁻¹⁶, ties up, like `Vector3 * Scalar`; quotients as
/// [`Scalar::from_ratio`] says, also for a divisor of zero. Text has as many digits as distinguish the number from its neighbours.
///
/// ```
/// use pinhole::{math::MathError, Scalar};
/// const NEAR: Scalar = Scalar::from_ratio(2, 5);
/// assert_eq!(NEAR.to_string(), "0.4");
/// assert_eq!(Scalar::from_f32(2.5)? + Scalar::from_int(1), Scalar::from_ratio(7, 2));
/// assert_eq!(Scalar::from_int(300) * Scalar::from_int(300), Scalar::MAX);
/// assert_eq!(Scalar::from_f32(f32::NAN), Err(MathError::NotFinite));
/// # Ok::<(), MathError>(())
/// ```
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct Scalar(i32);

/// The nearest 32-bit number.
pub(super) const fn saturated(v: i64) -> i32 {
    if v > i32::MAX as i64 {
        i32::MAX
    } else if v < i32::MIN as i64 {
        i32::MIN
    } else {
        v as i32 // in range by the tests
    }
}

impl Scalar {
    /// 0.
    pub const ZERO: Self = Self::from_bits(0);
    /// 1.
    pub const ONE: Self = Self::from_bits(1 << 16);
    /// The smallest number, −32768.
    pub const MIN: Self = Self::from_bits(i32::MIN);
    /// The largest number, 32768 − 2⁻¹⁶.
    pub const MAX: Self = Self::from_bits(i32::MAX);

    /// From the number of steps of 2⁻¹⁶, exact.
    #[inline]
    pub const fn from_bits(bits: i32) -> Self {
        Self(bits)
    }

    /// The number of steps of 2⁻¹⁶.
    #[inline]
    pub const fn to_bits(self) -> i32 {
        self.0
    }

    /// A whole number: exact from −32768 to 32767, otherwise [`Scalar::MIN`] or [`Scalar::MAX`].
    #[inline]
    pub const fn from_int(number: i32) -> Self {
        Self::from_bits(saturated((number as i64) << 16)) // 48 bits
    }

    /// The fraction `numerator / denominator`, rounded to the nearest 2⁻¹⁶, ties away from zero; beyond the range
    /// [`Scalar::MIN`] or [`Scalar::MAX`]. A denominator of zero gives these by the numerator's sign, and 0 / 0 is 0.
    ///
    /// ```
    /// use pinhole::Scalar;
    /// const THIRD: Scalar = Scalar::from_ratio(-1, 3);
    /// assert_eq!(THIRD.to_bits(), -21_845);
    /// ```
    pub const fn from_ratio(numerator: i32, denominator: i32) -> Self {
        let (n, d) = ((numerator.unsigned_abs() as u64) << 16, denominator.unsigned_abs());
        let magnitude = match d {
            0 if n == 0 => 0,
            0 => i64::MAX,
            // At most 2⁴⁷ + 2³⁰.
            d => divide(n + d as u64 / 2, d).0 as i64,
        };
        Self::from_bits(saturated(if (numerator < 0) != (denominator < 0) { -magnitude } else { magnitude }))
    }

    /// From a floating-point number, rounded to the nearest 2⁻¹⁶, ties away from zero.
    ///
    /// # Errors
    ///
    /// [`MathError`] when the number is NaN, infinite or outside ±32768. It does not saturate, because a coordinate that was
    /// moved is a fault that is hard to find in a picture.
    pub const fn from_f32(number: f32) -> Result<Self, MathError> {
        Self::from_double(number as f64)
    }

    const fn from_double(number: f64) -> Result<Self, MathError> {
        if !number.is_finite() {
            return Err(MathError::NotFinite);
        }
        let scaled = number * 65_536.0; // exact, or infinite
        if !(-2_147_483_648.5 < scaled && scaled < 2_147_483_647.5) {
            return Err(MathError::OutOfRange);
        }
        let whole = scaled as i32; // truncates towards zero
        let rest = scaled - whole as f64; // exact
        Ok(Self::from_bits(whole + (rest >= 0.5) as i32 - (rest <= -0.5) as i32))
        // 32 bits by the test above
    }

    /// The number without its sign; −32768 becomes [`Scalar::MAX`].
    #[must_use]
    pub const fn abs(self) -> Self {
        Self(self.0.saturating_abs())
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $assign_method:ident, |$a:ident, $b:ident| $result:expr;)*) => {$(
        impl $operator for Scalar {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                $result
            }
        }

        impl $assign for Scalar {
            #[inline]
            fn $assign_method(&mut self, other: Self) {
                *self = $operator::$method(*self, other);
            }
        }
    )*};
}

operators! {
    Add add AddAssign add_assign, |a, b| Self(a.0.saturating_add(b.0));
    Sub sub SubAssign sub_assign, |a, b| Self(a.0.saturating_sub(b.0));
    Mul mul MulAssign mul_assign, |a, b| {
        let product = i64::from(a.to_bits()) * i64::from(b.to_bits()); // ≤ 2⁶²
        Self::from_bits(saturated((product + (1 << 15)) >> 16))
    };
    Div div DivAssign div_assign, |a, b| Self::from_ratio(a.to_bits(), b.to_bits());
}

impl Neg for Scalar {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(self.0.saturating_neg())
    }
}

impl Sealed for Scalar {}

impl Coordinate for Scalar {
    fn times(self, factor: i32) -> i32 {
        self.to_bits().wrapping_mul(factor) // `Mesh` bounds the factor so that no bit is lost
    }
    const NARROW: bool = false;
    type Stored = Self;
}

/// Rounded to the nearest 2⁻¹⁶, ties away from zero.
///
/// # Errors
///
/// [`MathError`] when the number is NaN, infinite or outside ±32768.
#[diagnostic::do_not_recommend]
impl TryFrom<f64> for Scalar {
    type Error = MathError;

    fn try_from(number: f64) -> Result<Self, MathError> {
        Self::from_double(number)
    }
}

/// Exact.
impl From<Scalar> for f64 {
    fn from(number: Scalar) -> Self {
        Self::from(number.to_bits()) / 65_536.0
    }
}

impl From<i16> for Scalar {
    fn from(number: i16) -> Self {
        Self::from_int(number.into())
    }
}

#[cfg(feature = "fixed")]
#[diagnostic::do_not_recommend] // its name is longer than a line
impl From<I16F16> for Scalar {
    fn from(number: I16F16) -> Self {
        Self::from_bits(number.to_bits())
    }
}

#[cfg(feature = "fixed")]
#[diagnostic::do_not_recommend] // its name is longer than a line
impl From<Scalar> for I16F16 {
    fn from(number: Scalar) -> Self {
        Self::from_bits(number.to_bits())
    }
}

/// With a precision, that many decimals, but at most 16: no number has more. Without one, the fewest decimals that name no other
/// number. Rounded to nearest, ties to even.
impl Display for Scalar {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let bits = self.to_bits().unsigned_abs();
        let (whole, part) = (bits >> 16, u64::from(bits & 0xFFFF));
        let exact = part * 5_u64.pow(16); // in 10⁻¹⁶: 16 bits and 38
        let rounded = |decimals: u32| {
            let unit = 10_u64.pow(16 - decimals);
            let (digits, rest) = (exact / unit, exact % unit);
            let odd = if decimals == 0 { u64::from(whole) } else { digits } & 1;
            digits + u64::from(2 * rest + odd > unit)
        };
        // Five decimals are off by at most ½·10⁻⁵, which is less than half a step of 2⁻¹⁶.
        let names_it = |&decimals: &u32| {
            let unit = 10_u64.pow(decimals);
            ((rounded(decimals) << 16) + unit / 2) / unit == part // at most 17 bits and 17
        };
        let decimals = match f.precision() {
            Some(precision) => precision.min(16) as u32,
            None => (0..5).find(names_it).unwrap_or(5),
        };
        let (unit, digits) = (10_u64.pow(decimals), rounded(decimals));
        let (whole, digits) = (u64::from(whole) + digits / unit, digits % unit);
        let mut text = String::<22>::new(); // 32768.0000000000000000
        match decimals {
            0 => write!(text, "{whole}")?,
            _ => write!(text, "{whole}.{digits:0width$}", width = decimals as usize)?,
        }
        f.pad_integral(self.to_bits() >= 0, "", &text)
    }
}

impl Debug for Scalar {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        write!(f, "Scalar({self})")
    }
}

defmt_format!([] Scalar, self, "{=i32}/65536", self.to_bits());
