//! Constructors from floats, angles and viewports.

use crate::bridge::{point, rectangle};
use crate::bytes::Bytes;
use pinhole::space::{Ndc, World};
use pinhole::{Angle, NumberError, Point3, Quaternion, QuaternionError, Vector3, Viewport, ViewportError};

const TURN: f64 = 4_294_967_296.0;

fn float(b: &mut Bytes<'_>) -> f32 {
    match b.byte() {
        0..=63 => b.wild() as f32 / 65_536.0,
        64..=95 => (b.wild() as f32 + 0.5) / 65_536.0,
        96..=127 => f32::from(b.i16()),
        _ => b.f32(),
    }
}

/// The nearest 2⁻¹⁶, ties away from zero, in whole numbers: a float is mantissa · 2^exponent.
fn nearest(v: f32) -> Result<i32, NumberError> {
    if !v.is_finite() {
        return Err(NumberError::NotFinite);
    }
    // Exact in f64, as is the half.
    let scaled = (f64::from(v) * 65_536.0).abs();
    let magnitude = (scaled + 0.5).floor();
    let rounded = if v < 0.0 { -magnitude } else { magnitude };
    if rounded < f64::from(i32::MIN) || rounded > f64::from(i32::MAX) {
        return Err(NumberError::OutOfRange);
    }
    Ok(rounded as i32)
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    match b.byte() & 7 {
        0 | 1 => {
            let v = [float(b), float(b), float(b)];
            let wanted = v.map(nearest);
            let bits = |[x, y, z]: [i32; 3]| [x, y, z];
            let p = Point3::<World>::from_f32(v[0], v[1], v[2])
                .map(|p| bits([p.x(), p.y(), p.z()].map(|c| c.to_bits())));
            let d = Vector3::<World>::from_f32(v[0], v[1], v[2])
                .map(|p| bits([p.x(), p.y(), p.z()].map(|c| c.to_bits())));
            let f = Vector3::<World>::try_from(micromath::vector::F32x3::from((v[0], v[1], v[2])))
                .map(|p| bits([p.x(), p.y(), p.z()].map(|c| c.to_bits())));
            assert_eq!((p, f), (d, d));
            match wanted {
                [Ok(x), Ok(y), Ok(z)] => assert_eq!(p, Ok([x, y, z])),
                _ => assert!(wanted.iter().any(|w| w.err() == p.err()), "{v:?} {p:?}"),
            }
        }
        2 => {
            let degrees = float(b);
            match Angle::from_degrees_f32(degrees) {
                Ok(angle) => {
                    let exact = (f64::from(degrees) / 360.0 * TURN).rem_euclid(TURN);
                    let off = (exact - f64::from(angle.bits())).abs();
                    // Rounded once, and f64's own 2⁻⁵³ of up to 2⁶³ units.
                    let room =
                        0.5 + 2f64.powi(-10) + f64::from(degrees).abs() / 360.0 * TURN * 2f64.powi(-51);
                    assert!(off.min(TURN - off) <= room, "{degrees}: {off}");
                }
                Err(NumberError::NotFinite) => assert!(!degrees.is_finite()),
                Err(NumberError::OutOfRange) => assert!(degrees.abs() > 1e6, "{degrees}"),
                Err(other) => panic!("{other:?}: {degrees}"),
            }
        }
        3 => {
            let (n, d) = (b.wild(), b.wild() as u32);
            let got = Angle::turns(n, d).bits();
            if d == 0 {
                return assert_eq!(got, 0);
            }
            // Nearest: twice the error in units of 2⁻³²/d is at most d.
            let exact = i128::from(n) << 32;
            let error = (exact - i128::from(got) * i128::from(d)).rem_euclid(i128::from(d) << 32);
            let error = error.min((i128::from(d) << 32) - error);
            assert!(2 * error <= i128::from(d), "{n}/{d} is {got}");
            assert_eq!(Angle::degrees(n).bits(), Angle::turns(n, 360).bits());
        }
        4 => {
            let angle = if b.byte() & 1 == 0 { b.wild() as u32 } else { b.u32() };
            let (s, c) = Angle::from_bits(angle).sin_cos();
            let (es, ec) = crate::oracle::chain::sin_cos(angle);
            for (ours, exact) in [(s, es), (c, ec)] {
                let error = (f64::from(ours) / f64::from(1 << 30) - exact).abs();
                assert!(error <= 2f64.powf(-29.5), "{angle}: 2^{}", error.log2());
            }
        }
        5 => {
            let q = [float(b), float(b), float(b), float(b)];
            let got = Quaternion::try_from(micromath::Quaternion::new(q[0], q[1], q[2], q[3]));
            let beyond = |c: &f32| c.is_finite() && c.abs() > 32_768.0;
            match got {
                Err(QuaternionError::Number(NumberError::NotFinite)) => {
                    assert!(q.iter().any(|c| !c.is_finite()))
                }
                Err(QuaternionError::Number(NumberError::OutOfRange)) => assert!(q.iter().any(beyond)),
                Err(QuaternionError::Zero) => {
                    assert!(q.iter().all(|c| f64::from(c.abs()) * TURN < 1.0), "{q:?}")
                }
                Err(other) => panic!("{other:?}: {q:?}"),
                Ok(_) => assert!(!q.iter().any(|c| !c.is_finite() || beyond(c)), "{q:?}"),
            }
        }
        _ => viewport(b),
    }
}

fn viewport(b: &mut Bytes<'_>) {
    let place = |b: &mut Bytes<'_>| match b.byte() {
        0..=63 => b.wild(),
        64..=127 => -8192 + (b.byte() & 7) as i32,
        128..=159 => 8192 - (b.byte() & 7) as i32,
        _ => i32::from(b.i16() >> 2),
    };
    let (x, y, w, h) = (place(b), place(b), place(b) as u32, place(b) as u32);
    let area = rectangle(x, y, w, h);
    let got = Viewport::new(area.top_left, area.size);
    let inside = |low: i32, extent: u32| low >= -8192 && i64::from(low) + i64::from(extent) <= 8192;
    let (empty, whole) = (w == 0 || h == 0, inside(x, w) && inside(y, h));
    let got = match got {
        Err(ViewportError::Empty) => return assert!(empty),
        Err(ViewportError::OutsideGuardBand) => return assert!(!whole),
        Err(other) => panic!("{other:?}: {area:?}"),
        Ok(got) => got,
    };
    assert!(!empty && whole, "{area:?}");
    assert_eq!((got.top_left(), got.size()), (area.top_left, area.size));
    // x₀ + (x + 1)·W/2 and y₀ + (1 − y)·H/2 in 2⁻⁸, from 2⁻¹⁶: nearest, ties up, saturated.
    let p = [b.wild(), b.wild(), b.wild()];
    let at = got.apply(point::<Ndc>(p));
    let one = 1i128 << 16;
    let along = |low: i32, extent: u32, n: i128| {
        let v = i128::from(low) * 2 * one + n * i128::from(extent); // in 2⁻¹⁷
        (((v >> 8) + 1) >> 1).clamp(-(1 << 21), 1 << 21)
    };
    let wanted = (along(x, w, one + i128::from(p[0])), along(y, h, one - i128::from(p[1])));
    assert_eq!((i128::from(at.x()), i128::from(at.y())), wanted, "{area:?} {p:?}");
}
