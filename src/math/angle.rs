//! Binary angles and their sine and cosine.

use super::hints::keep_rolled;
use super::num::{fraction, mul_high, shift_to_fit};
use super::{MathError, Scalar};

/// An angle as a binary fraction of a turn: one turn is 2³², so sums wrap without error.
///
/// ```
/// use pinhole::Angle;
/// assert_eq!(Angle::degrees(90).sin_cos(), (1 << 30, 0));
/// // A turning model does not drift when its angle is made from the frame's number:
/// assert_eq!(Angle::turns(3600, 3600), Angle::ZERO);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Angle(u32);

impl Angle {
    /// 0°.
    pub const ZERO: Self = Self(0);

    /// An angle of `bits` units of 2⁻³² turn, exact.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The angle in units of 2⁻³² turn.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// `numerator / denominator` of a turn modulo one turn, rounded to the nearest 2⁻³² turn, ties up (towards larger angles). A
    /// denominator of zero gives [`ZERO`](Self::ZERO).
    #[inline(never)] // set-up: code size counts
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
    /// [`MathError::NotFinite`] if `degrees` is NaN or infinite, [`MathError::OutOfRange`] beyond ±2²⁰ degrees, where an f32
    /// resolves less than a sixteenth of a degree.
    pub fn from_degrees_f32(degrees: f32) -> Result<Self, MathError> {
        if !degrees.is_finite() {
            return Err(MathError::NotFinite);
        }
        if !(-1_048_576.0..=1_048_576.0).contains(&degrees) {
            return Err(MathError::OutOfRange);
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
    #[inline(never)] // set-up: code size counts
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

impl Angle {
    /// The sine, rounded to the nearest 2⁻¹⁶: within 2⁻¹⁷ + 2⁻²⁹ of the exact value, and exact at the quarter turns.
    ///
    /// ```
    /// use pinhole::{Angle, Scalar};
    /// assert_eq!(Angle::degrees(30).sin(), Scalar::from_ratio(1, 2));
    /// assert_eq!(Angle::degrees(180).cos(), Scalar::from_int(-1));
    /// ```
    pub const fn sin(self) -> Scalar {
        to_scalar(self.sin_cos().0)
    }

    /// The cosine, rounded to the nearest 2⁻¹⁶: within 2⁻¹⁷ + 2⁻²⁹ of the exact value, and exact at the quarter turns.
    pub const fn cos(self) -> Scalar {
        to_scalar(self.sin_cos().1)
    }

    /// The angle of the direction (x, y) from the x axis towards the y axis, within 8·2⁻³² turn; [`ZERO`](Self::ZERO) for
    /// (0, 0). The argument `y` comes first, as in other libraries.
    ///
    /// ```
    /// use pinhole::{Angle, Scalar};
    /// let [zero, one, two] = [0, 1, 2].map(Scalar::from_int);
    /// assert_eq!(Angle::atan2(two, zero), Angle::degrees(90));
    /// assert_eq!(Angle::atan2(zero, -one), Angle::degrees(180));
    /// let error = Angle::atan2(one, one) - Angle::degrees(45);
    /// assert!(error.bits() as i32 <= 8 && error.bits() as i32 >= -8);
    /// ```
    ///
    /// By CORDIC: the vector is turned by angles whose tangents are powers of two until it lies on the x axis. (Volder, *The
    /// CORDIC trigonometric computing technique*, 1959.)
    #[inline(never)] // set-up: code size counts
    pub const fn atan2(y: Scalar, x: Scalar) -> Self {
        let (x, y) = (x.to_bits() as i64, y.to_bits() as i64);
        // A vector on an axis has an exact answer. Others are turned by a whole number of quarter turns to x > 0, y ≥ 0.
        let (quarter, x, y) = match (x, y) {
            (0, 0) => return Self::ZERO,
            (1.., 0..) => (0, x, y),
            (..=0, 1..) => (1, y, -x),
            (..0, ..=0) => (2, -x, -y),
            _ => (3, -y, x),
        };
        let mut angle = (quarter as u32) << 30;
        if y == 0 {
            return Self(angle);
        }
        // The larger one has 60 bits, and each step grows the vector by at most √2; all of them together by 1.65: below 2⁶².
        let up = -shift_to_fit((x | y) as u64, 60);
        let (mut x, mut y, mut i) = (x << up, y << up, 0);
        while i < ARCTANGENT.len() {
            keep_rolled();
            let (right, down) = (y >> i, x >> i); // i < 31
            if y > 0 {
                (x, y, angle) = (x + right, y - down, angle.wrapping_add(ARCTANGENT[i]));
            } else {
                (x, y, angle) = (x - right, y + down, angle.wrapping_sub(ARCTANGENT[i]));
            }
            i += 1;
        }
        Self(angle)
    }
}

/// From 2⁻³⁰ to 2⁻¹⁶, rounded to nearest (ties up); for numbers within ±2³⁰.
const fn to_scalar(v: i32) -> Scalar {
    Scalar::from_bits((v + (1 << 13)) >> 14)
}

/// The angles whose tangents are 2⁰, 2⁻¹, 2⁻² …, in 2⁻³² turn, rounded to nearest.
#[rustfmt::skip]
const ARCTANGENT: [u32; 31] = [
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245, 2670163, 1335087, 667544,
    333772, 166886, 83443, 41722, 20861, 10430, 5215, 2608, 1304, 652, 326, 163, 81, 41, 20, 10, 5, 3, 1, 1,
];

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

    /// Scalars of sine and cosine, and angles of directions, against f64.
    #[test]
    fn e7_scalars_and_directions_hold_their_bounds() {
        let (mut worst, mut farthest) = (0_f64, 0_f64);
        for bits in (0..u32::MAX - 70_001).step_by(70_001).chain((0..256).map(|k| k << 23)) {
            let angle = Angle::from_bits(bits);
            let exact = f64::from(bits) / 4_294_967_296.0 * core::f64::consts::TAU;
            let of = |v: Scalar| f64::from(v.to_bits()) / 65_536.0;
            worst =
                worst.max((of(angle.sin()) - exact.sin()).abs()).max((of(angle.cos()) - exact.cos()).abs());
            // Long and short vectors, down to a few steps.
            for length in [2_147_000_000.0, 70_000.0, 40.0] {
                let [x, y] = [exact.cos(), exact.sin()].map(|c| (c * length).round() as i32);
                let found = Angle::atan2(Scalar::from_bits(y), Scalar::from_bits(x));
                let exact = f64::from(y).atan2(f64::from(x)) / core::f64::consts::TAU * 4_294_967_296.0;
                let off = f64::from(found.bits().wrapping_sub(exact.round() as i64 as u32) as i32);
                farthest = farthest.max(off.abs());
            }
        }
        let bound = (-17f64).exp2() + (-29f64).exp2();
        assert!(worst <= bound && bound <= 2.0 * worst, "{worst}");
        assert!((4.0..=8.0).contains(&farthest), "{farthest}");
        let at = |y, x| Angle::atan2(Scalar::from_bits(y), Scalar::from_bits(x));
        assert_eq!(at(0, 0), Angle::ZERO);
        for far in [1, i32::MAX] {
            assert_eq!([at(0, far), at(far, 0)], [Angle::ZERO, Angle::degrees(90)]);
            assert_eq!([at(0, -far), at(-far, 0)], [Angle::degrees(180), -Angle::degrees(90)]);
        }
        assert_eq!([at(i32::MIN, 0), at(0, i32::MIN)], [-Angle::degrees(90), Angle::degrees(180)]);
    }
}
