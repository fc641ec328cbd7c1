//! Why a number cannot become a scalar or an angle.

/// Why a floating-point number or a text cannot become a [`Scalar`](crate::Scalar) or an [`Angle`](crate::Angle).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NumberError {
    /// The number is NaN or infinite: check the computation that produced it.
    NotFinite,
    /// The number is outside of the type's range: choose a larger unit, so that numbers get smaller.
    OutOfRange,
    /// The text is not a decimal number, such as `-2.5`.
    Syntax,
}

impl core::fmt::Display for NumberError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite: check how it was computed",
            Self::OutOfRange => {
                "the number is out of range: choose a larger unit of length, or reduce the angle"
            }
            Self::Syntax => "the text is not a decimal number, such as -2.5",
        })
    }
}

impl core::error::Error for NumberError {}
