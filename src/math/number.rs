//! The public scalar, and why a floating-point number cannot become one.

/// The crate's public scalar: 16 integer and 16 fractional bits, ±32768 in steps of 2⁻¹⁶. It
/// has no `defmt::Format`, as `fixed` has none in this version: log its `to_bits`.
pub type Scalar = fixed::types::I16F16;

/// Why a floating-point number cannot enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NumberError {
    /// NaN or an infinity: look where the number was computed.
    NotFinite,
    /// Beyond the type's range: choose a larger unit, so that numbers get smaller.
    OutOfRange,
}

impl core::fmt::Display for NumberError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the number is NaN or infinite",
            Self::OutOfRange => "the number is out of range: choose a larger unit",
        })
    }
}

impl core::error::Error for NumberError {}
