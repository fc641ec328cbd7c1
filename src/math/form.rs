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

/// `⌊(Σ linear · v · 2⁻³¹) + offset · 2⁻³² + ½⌋` for justified coordinates v, the offset cut to 15 bits below
/// the unit. Coordinates are [justified](Form::justify) to the top of 32 bits.
#[cfg(not(any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32")))))]
pub(crate) type Form = WideForm;
#[cfg(any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))))]
pub(crate) type Form = HalfwordForm;

/// A form for cores that multiply 32 × 32 bits to 64 and add them up at one go.
#[cfg(any(test, not(any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))))))]
#[derive(Clone, Copy, Debug)]
#[repr(C)] // in the order in which they are loaded
pub(crate) struct WideForm {
    /// In 2⁻³², the rounding half included.
    offset: i64,
    /// Each below 2³⁰ − 2¹⁵ in absolute value, times 2.
    doubled: [i32; 3],
}

#[cfg(any(test, not(any(target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))))))]
impl WideForm {
    /// What coordinates are multiplied by, for a left shift that brings the largest to the top of 32 bits.
    pub(crate) const fn justify(shift: u32, _narrow: bool) -> i32 {
        1 << (shift & 31)
    }

    pub(crate) const ZERO: Self = Self { offset: 0, doubled: [0; 3] };

    pub(crate) fn new(linear: [i32; 3], offset: i64) -> Self {
        Self { doubled: linear.map(|m| m << 1), offset: cut(offset) }
    }

    /// The coefficients, and the offset in units, rounded to nearest.
    pub(crate) fn numbers(&self) -> ([i32; 3], i32) {
        (self.doubled.map(|m| m >> 1), (self.offset >> 32) as i32)
    }

    /// The form at a justified vertex. One rounding, at the end; the result fits by the choice of
    /// exponents, sums on the way may wrap.
    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], _narrow: bool) -> i32 {
        sum(self.doubled, self.offset, v)
    }
}

/// The rounding half added, and bits dropped that no [`HalfwordForm`] keeps. An offset leaves room for that half: all that the
/// form comes to has.
fn cut(offset: i64) -> i64 {
    offset.wrapping_add(1 << 31) >> 17 << 17
}

#[inline(always)]
fn sum([a, b, c]: [i32; 3], offset: i64, [x, y, z]: [i32; 3]) -> i32 {
    let sum = offset
        .wrapping_add(i64::from(a) * i64::from(x))
        .wrapping_add(i64::from(b) * i64::from(y))
        .wrapping_add(i64::from(c) * i64::from(z));
    (sum >> 32) as i32
}

/// A form for 16-bit coordinates on a Cortex-M0, whose products have 32 bits, and on RISC-V, where a sum of 64 bits takes
/// four instructions: coefficients split as `high·2¹⁵ + low`, both signed 16-bit, so
/// that every product and the sum of the three low ones fit 32 bits. Nothing is dropped before
/// the one rounding, so the bits are those of the wide form.
#[cfg(any(test, target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[derive(Clone, Copy, Debug)]
#[repr(C)] // in the order in which they are loaded
pub(crate) struct HalfwordForm {
    low: [i32; 3],
    high: [i32; 3],
    /// The offset in 2⁻¹⁵, and in whole units.
    rest: i32,
    offset: i32,
}

#[cfg(any(test, target_arch = "riscv32", all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[cfg_attr(test, allow(dead_code))] // the host's tests use a part of it
impl HalfwordForm {
    /// Narrow coordinates are brought to the top of 16 bits instead, by a shift of 16 less: 0 … 15.
    pub(crate) const fn justify(shift: u32, narrow: bool) -> i32 {
        1 << (if narrow { shift & 15 } else { shift & 31 })
    }

    pub(crate) const ZERO: Self = Self { low: [0; 3], high: [0; 3], rest: 0, offset: 0 };

    pub(crate) fn new(linear: [i32; 3], offset: i64) -> Self {
        let offset = cut(offset);
        let low = linear.map(|m| (m << 17) >> 17); // −2¹⁴ … 2¹⁴ − 1
        let high = linear.map(|m| (m + (1 << 14)) >> 15); // 16 bits: |m| < 2³⁰ − 2¹⁵
        Self { high, low, offset: (offset >> 32) as i32, rest: (offset >> 17) as i32 & 0x7fff }
    }

    /// The coefficients, and the offset in units, rounded to nearest.
    pub(crate) fn numbers(&self) -> ([i32; 3], i32) {
        let ([a, b, c], [x, y, z]) = (self.high, self.low);
        ([(a << 15) + x, (b << 15) + y, (c << 15) + z], self.offset)
    }

    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], narrow: bool) -> i32 {
        if !narrow {
            return self.at_wide(v);
        }
        let [x, y, z] = v;
        let dot = |[a, b, c]: [i32; 3]| (a * x).wrapping_add(b * y).wrapping_add(c * z); // products ≤ 2³⁰

        // Three low products of at most 2²⁹ each, and 15 bits: below 2³¹.
        ((dot(self.low) + self.rest) >> 15).wrapping_add(dot(self.high)).wrapping_add(self.offset)
    }

    /// For 32-bit coordinates, by 64-bit products: the compiler's on a Cortex-M0. RISC-V has them, and registers for the whole
    /// coefficients, made before the loop.
    #[cfg_attr(target_arch = "riscv32", inline(always))]
    #[cfg_attr(not(target_arch = "riscv32"), inline(never))]
    fn at_wide(&self, v: [i32; 3]) -> i32 {
        let [a, b, c] = self.high;
        let [d, e, f] = self.low;
        let doubled = [(a << 16) + (d << 1), (b << 16) + (e << 1), (c << 16) + (f << 1)];
        sum(doubled, i64::from(self.offset) << 32 | i64::from(self.rest) << 17, v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn both_forms_give_the_same_bits() {
        let mut random = Random(7);
        let mut random = || random.below(1 << 31) as i32;
        let limit = (1 << 30) - (1 << 15) - 1;
        for i in 0..200_000 {
            let m = [0; 3].map(|_| match random() % 8 {
                0 => limit,
                1 => -limit,
                2 => random() >> 20,
                _ => (random() - (1 << 30)).clamp(-limit, limit),
            });
            let v = [0; 3].map(|_| match random() % 8 {
                0 => i32::MIN,
                1 => 0x7fff << 16,
                _ => (random() << 1) & !0xffff,
            });
            let offset = (i64::from(random()) - (1 << 30)) << (random() % 30) | i64::from(random());
            let (long, split) = (WideForm::new(m, offset), HalfwordForm::new(m, offset));
            assert_eq!(long.numbers(), split.numbers(), "{i}: {m:?} {offset}");
            assert_eq!(long.at(v, true), split.at(v.map(|c| c >> 16), true), "{i}: {m:?} {v:?} {offset}");
            let v = v.map(|c| c ^ random() >> 16);
            assert_eq!(long.at(v, false), split.at(v, false), "{i}: {m:?} {v:?} {offset}");
        }
    }
}
