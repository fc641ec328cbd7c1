//! Random numbers for unit tests, reproducible from a seed.

/// A congruential generator modulo 2⁶⁴; [`bits`](Self::bits) returns its upper half. (Knuth, *The Art of Computer Programming*,
/// vol. 2, 3rd ed., section 3.3.4, table 1, line 26.)
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// 32 random bits.
    pub(crate) fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as u32
    }

    /// A number in 0 … n − 1, for n up to 2³¹.
    pub(crate) fn below(&mut self, n: i64) -> i64 {
        i64::from(self.bits() >> 1) % n
    }

    /// A pseudo-random number in −n … n, for n in 0 … 2³⁰ − 1.
    pub(crate) fn within(&mut self, n: i64) -> i32 {
        (self.below(2 * n + 1) - n) as i32
    }

    /// A number in −1 … 1.
    pub(crate) fn unit(&mut self) -> f64 {
        f64::from(self.bits() >> 8) / f64::from(1 << 23) - 1.0
    }

    /// A vertex whose coordinates are any `i16`.
    pub(crate) fn vertex(&mut self) -> [i16; 3] {
        [0; 3].map(|_| (self.bits() >> 16) as i16)
    }
}

/// The next 64 random bits of a generator that mixes a counter. (Steele, Lea and Flood, *Fast splittable pseudorandom number
/// generators*, 2014.)
pub(crate) fn mixed(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
