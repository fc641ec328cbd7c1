//! Binary angles and their sine and cosine.

use super::num::{fraction, mul_high};
use super::NumberError;

/// An angle as a binary fraction of a turn: one turn is 2³², so sums wrap without error.
///
/// ```
/// use pinhole::Angle;
/// assert_eq!(Angle::degrees(90), Angle::QUARTER_TURN);
/// assert_eq!(Angle::QUARTER_TURN.sin_cos(), (1 << 30, 0));
/// // A turning model does not drift when its angle is made from the frame's number:
/// assert_eq!(Angle::turns(3600, 3600), Angle::ZERO);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Angle(u32);

impl Angle {
    /// 0°.
    pub const ZERO: Self = Self(0);
    /// 90°.
    pub const QUARTER_TURN: Self = Self(1 << 30);
    /// 180°.
    pub const HALF_TURN: Self = Self(1 << 31);

    /// From units of 2⁻³² turn.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// In units of 2⁻³² turn.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// `numerator / denominator` of a turn modulo one turn, rounded to the nearest 2⁻³² turn, ties up (towards larger angles). A
    /// denominator of zero gives [`ZERO`](Self::ZERO).
    #[inline(never)] // set-up: code size counts, speed does not
    pub const fn turns(numerator: i32, denominator: u32) -> Self {
        if denominator == 0 {
            return Self::ZERO;
        }
        // 0 ≤ part < denominator; the quotient has 33 bits, the last one for rounding. A carry to 2³² wraps to 0. Long division,
        // because 64-bit division costs half a kilobyte of library code.
        let rest = numerator.unsigned_abs() % denominator;
        let part = if numerator < 0 && rest != 0 { denominator.wrapping_sub(rest) } else { rest };
        Self(((fraction(part as u64, denominator as u64, 33) + 1) >> 1) as u32)
    }

    /// Whole degrees, rounded to the nearest 2⁻³² turn, ties up as in [`turns`](Self::turns).
    pub const fn degrees(degrees: i32) -> Self {
        Self::turns(degrees, 360)
    }

    /// Degrees in floating point, rounded to the nearest 2⁻³² turn (ties away from zero, give or
    /// take 2⁻¹⁰ of a step).
    ///
    /// # Errors
    ///
    /// [`NumberError::NotFinite`] if `degrees` is NaN or infinite, [`NumberError::OutOfRange`] beyond ±2²⁰ degrees, where an f32
    /// resolves less than a sixteenth of a degree.
    pub fn from_degrees_f32(degrees: f32) -> Result<Self, NumberError> {
        if !degrees.is_finite() {
            return Err(NumberError::NotFinite);
        }
        if !(-1_048_576.0..=1_048_576.0).contains(&degrees) {
            return Err(NumberError::OutOfRange);
        }
        // |degrees| ≤ 2²⁰ gives at most 2⁴³·⁶, inside i64; the cast keeps the angle modulo a turn.
        let bits = f64::from(degrees) * (4_294_967_296.0 / 360.0);
        let half = if bits < 0.0 { -0.5 } else { 0.5 };
        Ok(Self((bits + half) as i64 as u32))
    }

    /// Sine and cosine in 2⁻³⁰ (Q2.30): within 2⁻²⁹·⁵ of the exact values, and exact at the
    /// quarter turns; the sum of their squares is within 2⁻²⁸ of 1.
    ///
    /// The nearest of 64 table angles per quarter turn and the remainder δ, |δ| ≤ π/256, are combined by the addition theorems,
    /// with `sin δ = δ − δ³/6` and `cos δ = 1 − δ²/2 + δ⁴/24`; the
    /// truncation error of the series is below 2⁻³⁸. (Abramowitz and Stegun, 4.3.16–17, 4.3.65–66.)
    #[inline(never)] // set-up: code size counts, speed does not
    pub const fn sin_cos(self) -> (i32, i32) {
        let within = (self.0 & 0x3fff_ffff) as i32; // the angle within its quadrant
        let index = (within + (1 << 23)) >> 24; // 0 … 64
        let rest = within - (index << 24); // ±2²³
        let (sin, cos) = (table(index), table(64 - index)); // in 2⁻³⁰

        // 2π in 2⁻²⁸ times rest·2⁸: δ in 2⁻³⁶, |δ| < 2²⁹·⁷.
        let delta = mul_high(rest << 8, 1_686_629_713);
        let square = mul_high(delta, delta); // δ² in 2⁻⁴⁰
        let fourth = mul_high(square, square) >> 8; // δ⁴ in 2⁻⁴⁰, < 2¹⁵
        let versine = (square >> 1) - ((fourth * 2731) >> 16); // 1 − cos δ in 2⁻⁴⁰; 2731/2¹⁶ = 1/24
        let cube = mul_high(delta, square); // δ³ in 2⁻⁴⁴
        let sine = delta - (mul_high(cube, 715_827_883) >> 8); // sin δ in 2⁻³⁶; 715827883 = 2³²/6

        // Both corrections in 2⁻³⁴: |·| < 2²⁷·⁷. Rounded to nearest at the end.
        let up = mul_high(cos, sine) - (mul_high(sin, versine) >> 4);
        let down = mul_high(sin, sine) + (mul_high(cos, versine) >> 4);
        let (s, c) = (sin + ((up + 8) >> 4), cos - ((down + 8) >> 4));
        // From the first quadrant to the angle's own.
        let (s, c) = if self.0 >> 30 & 1 == 0 { (s, c) } else { (c, -s) };
        if self.0 >> 31 == 0 {
            (s, c)
        } else {
            (-s, -c)
        }
    }
}

impl core::ops::Add for Angle {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl core::ops::Sub for Angle {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl core::ops::Neg for Angle {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

/// sin(index · π/128) in 2⁻³⁰ for 0 … 64.
const fn table(index: i32) -> i32 {
    let index = index as usize;
    if index < SINE.len() {
        SINE[index]
    } else {
        1 << 30
    }
}

#[rustfmt::skip]
const SINE: [i32; 65] = [
    0, 26350943, 52686014, 78989349, 105245103, 131437462,
    157550647, 183568930, 209476638, 235258165, 260897982, 286380643,
    311690799, 336813204, 361732726, 386434353, 410903207, 435124548,
    459083786, 482766489, 506158392, 529245404, 552013618, 574449320,
    596538995, 618269338, 639627258, 660599890, 681174602, 701339000,
    721080937, 740388522, 759250125, 777654384, 795590213, 813046808,
    830013654, 846480531, 862437520, 877875009, 892783698, 907154608,
    920979082, 934248793, 946955747, 959092290, 970651112, 981625251,
    992008094, 1001793390, 1010975242, 1019548121, 1027506862, 1034846671,
    1041563127, 1047652185, 1053110176, 1057933813, 1062120190, 1065666786,
    1068571464, 1070832474, 1072448455, 1073418433, 1073741824,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn e7_sine_and_cosine_hold_their_bound() {
        let mut worst = 0f64;
        let mut circle = 0f64;
        for bits in (0..u32::MAX - 70_001).step_by(70_001).chain((0..256).map(|k| k << 23)) {
            let (s, c) = Angle::from_bits(bits).sin_cos();
            let exact = f64::from(bits) / 4_294_967_296.0 * core::f64::consts::TAU;
            let (s, c) = (f64::from(s) / 1_073_741_824.0, f64::from(c) / 1_073_741_824.0);
            worst = worst.max((s - exact.sin()).abs()).max((c - exact.cos()).abs());
            circle = circle.max((s * s + c * c - 1.0).abs());
        }
        let bound = (-29.5f64).exp2();
        assert!(worst <= bound && bound <= 2.0 * worst, "2^{}", worst.log2());
        assert!(circle <= (-28f64).exp2(), "2^{}", circle.log2());
    }

    #[test]
    fn e7_quarter_turns_are_exact() {
        let one = 1 << 30;
        let quarters = [(0, one), (one, 0), (0, -one), (-one, 0)];
        for (k, want) in (0..4).zip(quarters) {
            assert_eq!(Angle::turns(k, 4).sin_cos(), want);
        }
    }

    #[test]
    fn turns_round_and_wrap() {
        assert_eq!(Angle::turns(1, 3).bits(), 0x5555_5555);
        assert_eq!(Angle::turns(2, 3).bits(), 0xaaaa_aaab);
        assert_eq!(Angle::turns(-1, 4), -Angle::QUARTER_TURN);
        assert_eq!(Angle::turns(5, 4), Angle::QUARTER_TURN);
        assert_eq!(Angle::turns(i32::MIN, u32::MAX).bits(), 0x7fff_ffff);
        assert_eq!(Angle::turns(7, 0), Angle::ZERO);
        assert_eq!(Angle::degrees(-30) + Angle::degrees(30), Angle::ZERO);
        assert_eq!(Angle::from_degrees_f32(45.0), Ok(Angle::turns(1, 8)));
        assert_eq!(Angle::from_degrees_f32(f32::NAN), Err(NumberError::NotFinite));
        assert_eq!(Angle::from_degrees_f32(1e9), Err(NumberError::OutOfRange));
    }
}
