//! Linear forms over mesh vertices: the multiply-accumulate of the vertex loop.

use super::Scalar;

/// A point in clip space while it is being clipped: integers, the exponents are kept elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Homogeneous {
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// 0 on the near plane, positive inside.
    pub(crate) d: i32,
    pub(crate) w: i32,
}

/// A vertex coordinate type: `i16`, or [`Scalar`] for meshes that need the range.
pub trait Coordinate: Copy + sealed::Sealed {
    /// The coordinate times a power of two that brings it to the top of 32 bits.
    #[doc(hidden)]
    fn justify(self, factor: i32) -> i32;
    /// Whether the justified coordinate's low 16 bits are zero.
    #[doc(hidden)]
    const NARROW: bool;
}

impl Coordinate for i16 {
    fn justify(self, factor: i32) -> i32 {
        i32::from(self).wrapping_mul(factor) // 2¹⁶ … 2³¹, by Mesh's own bound no bit is lost
    }
    const NARROW: bool = true;
}

impl Coordinate for Scalar {
    fn justify(self, factor: i32) -> i32 {
        self.to_bits().wrapping_mul(factor) // by Mesh's own bound no bit is lost
    }
    const NARROW: bool = false;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for i16 {}
    impl Sealed for super::Scalar {}
}

/// `⌊(Σ linear · v · 2⁻³¹) + offset · 2⁻³² + ½⌋` for justified coordinates v.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    /// Each below 2³⁰ − 2¹⁵ in absolute value, times 2.
    doubled: [i32; 3],
    /// In 2⁻³², the rounding half included.
    offset: i64,
    /// The same in pieces that a 32-bit multiplier takes.
    #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
    halves: Halves,
}

impl Form {
    pub(crate) fn new(linear: [i32; 3], offset: i64) -> Self {
        let offset = offset.saturating_add(1 << 31);
        Self {
            doubled: linear.map(|m| m << 1),
            offset,
            #[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
            halves: Halves::new(linear, offset),
        }
    }

    /// The form at a justified vertex. One rounding, at the end; the result fits by the choice of
    /// exponents, sums on the way may wrap. `narrow`: the low 16 bits of v are zero.
    #[inline(always)]
    pub(crate) fn at(&self, v: [i32; 3], narrow: bool) -> i32 {
        #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
        if narrow {
            return self.halves.at(v);
        }
        let _ = narrow; // all other cores multiply 32 × 32 bits to 64
        self.at_wide(v)
    }

    /// [`at`](Self::at) where vertices are few.
    #[inline(never)]
    pub(crate) fn at_one(&self, v: &[i32; 3], narrow: bool) -> i32 {
        self.at(*v, narrow)
    }

    #[inline(always)]
    fn at_wide(&self, [x, y, z]: [i32; 3]) -> i32 {
        let [a, b, c] = self.doubled;
        let sum = self
            .offset
            .wrapping_add(i64::from(a) * i64::from(x))
            .wrapping_add(i64::from(b) * i64::from(y))
            .wrapping_add(i64::from(c) * i64::from(z));
        (sum >> 32) as i32
    }
}

/// A form for 16-bit coordinates: coefficients split as `high·2¹⁵ + low`, both signed 16-bit, so
/// that every product and the sum of the three low ones fit 32 bits. Nothing is dropped before
/// the one rounding, so the bits are those of the wide form.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[derive(Clone, Copy, Debug)]
struct Halves {
    high: [i16; 3],
    low: [i16; 3],
    /// The offset in whole units and in 2⁻¹⁵.
    offset: i32,
    rest: i32,
}

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
impl Halves {
    fn new(linear: [i32; 3], offset: i64) -> Self {
        let low = linear.map(|m| ((m << 17) >> 17) as i16); // −2¹⁴ … 2¹⁴ − 1
        let high = linear.map(|m| ((m + (1 << 14)) >> 15) as i16); // |m| < 2³⁰ − 2¹⁵
        Self { high, low, offset: (offset >> 32) as i32, rest: (offset >> 17) as i32 & 0x7fff }
    }

    #[inline(always)]
    fn at(&self, v: [i32; 3]) -> i32 {
        let [x, y, z] = v.map(|c| c >> 16);
        let dot = |m: [i16; 3]| {
            let [a, b, c] = m.map(i32::from);
            (a * x).wrapping_add(b * y).wrapping_add(c * z) // products ≤ 2³⁰
        };
        // Three low products of at most 2²⁹ each, and 15 bits: below 2³¹.
        dot(self.high).wrapping_add((dot(self.low) + self.rest) >> 15).wrapping_add(self.offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_give_the_same_bits() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i32
        };
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
            let form = Form::new(m, offset);
            assert_eq!(form.at_wide(v), form.halves.at(v), "{i}: {m:?} {v:?} {offset}");
        }
    }
}
