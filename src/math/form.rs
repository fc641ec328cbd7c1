//! Linear forms over mesh vertices: the multiply-accumulate of the vertex loop.

use super::Scalar;

/// A point in clip space while it is being clipped: integers, the exponents are kept elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ClipCoords {
    /// d is 0 on the near plane, positive inside.
    pub(crate) xydw: [i32; 4],
}

/// A vertex coordinate type: `i16`, in the mesh's unit of 2^exponent, or [`Scalar`] for meshes that need the range: ±32768
/// in steps of 2⁻¹⁶. Sealed: there are no others.
pub trait Coordinate: Copy + sealed::Sealed {
    /// The coordinate times a power of two.
    #[doc(hidden)]
    fn times(self, factor: i32) -> i32;
    /// Whether the coordinate has 16 bits.
    #[doc(hidden)]
    const NARROW: bool;
}

impl Coordinate for i16 {
    fn times(self, factor: i32) -> i32 {
        i32::from(self).wrapping_mul(factor) // by Mesh's own bound no bit is lost
    }
    const NARROW: bool = true;
}

impl Coordinate for Scalar {
    fn times(self, factor: i32) -> i32 {
        self.to_bits().wrapping_mul(factor) // by Mesh's own bound no bit is lost
    }
    const NARROW: bool = false;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for i16 {}
    impl Sealed for super::Scalar {}
}

/// A form for cores that multiply 32 × 32 bits to 64 and add them up at one go.
#[derive(Clone, Copy, Debug)]
#[repr(C)] // in the order in which they are loaded
pub(crate) struct WideForm {
    /// In 2⁻³², the rounding half included.
    offset: i64,
    /// Each below 2³⁰ − 2¹⁵ in absolute value, times 2.
    doubled: [i32; 3],
}

impl WideForm {
    /// What coordinates are multiplied by, for a left shift that brings the largest to the top of 32 bits.
    pub(crate) const fn justify(shift: u32, _narrow: bool) -> i32 {
        1 << (shift & 31)
    }

    pub(crate) const ZERO: Self = Self { offset: 0, doubled: [0; 3] };

    pub(crate) fn new(linear: [i32; 3], offset: i64) -> Self {
        Self { doubled: linear.map(|m| m << 1), offset: truncated(offset) }
    }

    /// The coefficients, and the offset in units, rounded to nearest.
    pub(crate) fn numbers(&self) -> ([i32; 3], i32) {
        (self.doubled.map(|m| m >> 1), (self.offset >> 32) as i32)
    }

    /// The form at a justified vertex. One rounding, at the end; the result fits by the choice of
    /// exponents, sums on the way may wrap.
    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], _narrow: bool) -> i32 {
        dot_product(self.doubled, self.offset, v)
    }
}

/// The rounding half added, and bits dropped that no [`HalfwordForm`] keeps. An offset leaves room for that half: all that the
/// form comes to has.
pub(super) fn truncated(offset: i64) -> i64 {
    offset.wrapping_add(1 << 31) >> 17 << 17
}

#[inline(always)]
pub(super) fn dot_product([a, b, c]: [i32; 3], offset: i64, [x, y, z]: [i32; 3]) -> i32 {
    let sum = offset
        .wrapping_add(i64::from(a) * i64::from(x))
        .wrapping_add(i64::from(b) * i64::from(y))
        .wrapping_add(i64::from(c) * i64::from(z));
    (sum >> 32) as i32
}
