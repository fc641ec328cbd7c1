//! The public scalar, and why a floating-point number cannot become one.

/// The crate's public fixed-point number: 16 integer and 16 fractional bits, ±32768 in steps of 2⁻¹⁶. This version of `fixed`
/// gives it no `defmt::Format`: log its `to_bits`.
///
/// `Scalar::from_num` makes one of any number, and panics in debug builds where it does not fit; `saturating_from_num` takes the
/// nearest one, `checked_from_num` returns `None`. `Scalar::const_from_int` is for constants.
///
/// ```
/// use pinhole::Scalar;
/// assert_eq!(Scalar::from_num(2.5) + Scalar::from_num(1), Scalar::from_num(3.5));
/// assert_eq!(Scalar::saturating_from_num(1e9), Scalar::MAX);
/// const NEAR: Scalar = Scalar::const_from_int(1);
/// # let _ = NEAR;
/// ```
pub type Scalar = fixed::types::I16F16;

/// Why a floating-point number cannot become a [`Scalar`] or an [`Angle`](crate::Angle).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NumberError {
    /// The number is NaN or infinite: check the computation that produced it.
    NotFinite,
    /// The number is outside of the type's range: choose a larger unit, so that numbers get smaller.
    OutOfRange,
}

impl core::fmt::Display for NumberError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite: check how it was computed",
            Self::OutOfRange => {
                "the number is out of range: choose a larger unit of length, or reduce the angle"
            }
        })
    }
}

impl core::error::Error for NumberError {}
