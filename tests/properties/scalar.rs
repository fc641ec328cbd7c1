//! Every operator and conversion of `Scalar` is exact arithmetic, then rounded and saturated.

use crate::cases;
use fixed::types::I16F16;
use pinhole::{math::MathError, Scalar};
use proptest::prelude::*;

/// The bits of a number: any, of any size, a whole number, or an end of the range.
fn bits() -> impl Strategy<Value = i32> {
    prop_oneof![
        2 => any::<i32>(),
        3 => (any::<i32>(), 0u32..32).prop_map(|(v, down)| v >> down),
        2 => any::<i16>().prop_map(|v| i32::from(v) << 16),
        1 => (0i32..3, any::<bool>()).prop_map(|(d, low)| if low { i32::MIN + d } else { i32::MAX - d }),
    ]
}

fn saturated(exact: i128) -> Scalar {
    Scalar::from_bits(exact.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
}

/// `n / d` for a positive `d`, rounded to nearest, ties away from zero.
fn nearest(n: i128, d: i128) -> i128 {
    n.signum() * ((2 * n.abs() + d) / (2 * d))
}

/// `n / d`, rounded to nearest; a `d` of zero is as close to zero as can be.
fn ratio(n: i32, d: i32) -> Scalar {
    let [n, d] = [n, d].map(i128::from);
    match d.signum() {
        0 => saturated(n << 64),
        sign => saturated(nearest((sign * n) << 16, d.abs())),
    }
}

/// What becomes of bits that may not fit.
fn checked(bits: i128) -> Result<Scalar, MathError> {
    i32::try_from(bits).map(Scalar::from_bits).map_err(|_| MathError::OutOfRange)
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn operators_round_and_saturate(a in bits(), b in bits()) {
        let (x, y) = (Scalar::from_bits(a), Scalar::from_bits(b));
        let [p, q] = [a, b].map(i128::from);
        let results = [
            (x + y, saturated(p + q)),
            (x - y, saturated(p - q)),
            (x * y, saturated((p * q + (1 << 15)).div_euclid(1 << 16))),
            (x / y, ratio(a, b)),
        ];
        for (found, exact) in results {
            prop_assert_eq!(found, exact);
        }
        let mut assigned = [x; 4];
        assigned[0] += y;
        assigned[1] -= y;
        assigned[2] *= y;
        assigned[3] /= y;
        prop_assert_eq!(assigned, results.map(|(found, _)| found));
        prop_assert_eq!((-x, x.abs()), (saturated(-p), saturated(p.abs())));
        prop_assert_eq!((x.cmp(&y), x == y), (a.cmp(&b), a == b));
    }

    #[test]
    fn integers_and_ratios_round_and_saturate(n in bits(), d in prop_oneof![bits(), -9i32..9], whole in any::<i16>()) {
        prop_assert_eq!(Scalar::from_int(n), saturated(i128::from(n) << 16));
        prop_assert_eq!(Scalar::from_ratio(n, d), ratio(n, d));
        prop_assert_eq!(Scalar::from(whole), Scalar::from_int(whole.into()));
    }

    /// A float is an integer over a power of two, so exact integers tell which number is nearest.
    #[test]
    fn floats_are_rounded_to_nearest_and_refused_out_of_range(n in any::<i64>(), down in 0u32..64, finer in 0u32..60) {
        let (wide, narrow) = (n >> down.max(11), n >> down.max(40)); // 53 and 24 bits, with the sign
        let exact = |n: i64| checked(nearest(n.into(), 1 << finer));
        let step = (-16 - finer as i32) as f64;
        prop_assert_eq!(Scalar::try_from(wide as f64 * step.exp2()), exact(wide));
        prop_assert_eq!(Scalar::from_f32(narrow as f32 * step.exp2() as f32), exact(narrow));
    }

    #[test]
    fn floats_of_any_bits_are_refused_or_near(single in any::<u32>(), double in any::<u64>()) {
        let (single, double) = (f32::from_bits(single), f64::from_bits(double));
        prop_assert_eq!(Scalar::from_f32(single), Scalar::try_from(f64::from(single)));
        match Scalar::try_from(double) {
            Ok(number) => prop_assert!((f64::from(number) - double).abs() * 131_072.0 <= 1.0),
            Err(MathError::OutOfRange) => prop_assert!(double.abs() > 32_767.0),
            Err(error) => prop_assert!(!double.is_finite() && error == MathError::NotFinite),
        }
    }

    #[test]
    fn numbers_survive_floats_text_and_the_crate_fixed(bits in bits()) {
        let number = Scalar::from_bits(bits);
        prop_assert_eq!(f64::from(number) * 65_536.0, f64::from(bits));
        prop_assert_eq!(Scalar::try_from(f64::from(number)), Ok(number));
        let text = number.to_string();
        prop_assert!((text.parse::<f64>().unwrap() - f64::from(number)).abs() < 1.0 / 131_072.0);
        prop_assert_eq!(format!("{number:?}"), format!("Scalar({text})"));
        let other = I16F16::from_bits(bits);
        prop_assert_eq!(&text, &other.to_string());
        prop_assert_eq!(text.parse(), Ok(other));
        prop_assert_eq!(format!("{number:+09} {number:<9}"), format!("{other:+09} {other:<9}"));
        for decimals in 0..=16 {
            prop_assert_eq!(format!("{number:8.decimals$}"), format!("{:8.decimals$}", f64::from(number)));
        }
        prop_assert_eq!(I16F16::from(number), other);
        prop_assert_eq!(Scalar::from(I16F16::from_bits(bits)), number);
    }
}

#[test]
fn what_is_no_number_is_an_error() {
    for not_finite in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(Scalar::from_f32(not_finite), Err(MathError::NotFinite));
        assert_eq!(Scalar::try_from(f64::from(not_finite)), Err(MathError::NotFinite));
    }
}

/// Ties, and the sum that f64 would round: just below half a step.
#[test]
fn half_steps_are_rounded_away_from_zero() {
    let step = 1.0 / 65_536.0;
    let found = [0.5, -0.5, 1.5, -2.5, 0.499_999_999_999_999_94].map(|steps| Scalar::try_from(steps * step));
    assert_eq!(found, [1, -1, 2, -3, 0].map(|bits| Ok(Scalar::from_bits(bits))));
    let ends =
        [32_768.0 - step / 2.0, 32_768.0 - step * 0.75, -32_768.0 - step * 0.25, -32_768.0 - step / 2.0];
    let out = Err(MathError::OutOfRange);
    assert_eq!(ends.map(Scalar::try_from), [out, Ok(Scalar::MAX), Ok(Scalar::MIN), out]);
}

#[test]
fn constants_are_made_by_the_compiler() {
    const NEAR: Scalar = Scalar::from_ratio(-5, 4);
    const FAR: Scalar = Scalar::from_int(300);
    const FLOAT: Option<i32> = match Scalar::from_f32(0.1) {
        Ok(number) => Some(number.to_bits()),
        Err(_) => None,
    };
    assert_eq!((NEAR.to_bits(), FAR.to_bits(), FLOAT), (-81_920, 300 << 16, Some(6554)));
    assert_eq!(
        (Scalar::default(), Scalar::ONE - Scalar::from_bits(1)),
        (Scalar::ZERO, Scalar::from_bits(65_535))
    );
}
