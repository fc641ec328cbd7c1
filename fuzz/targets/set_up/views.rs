//! Views: look-at, its variants, and the named views.

use crate::bridge::pair::{ViewBits, ONE};
use crate::bridge::{point, scalar, vector};
use crate::bytes::Bytes;
use crate::oracle::chain::{self, cross_exact, length, M3};
use pinhole::{ViewTransform, ViewTransformError};

/// A vector of any kind: wild, on the lattice of whole units, or nearly along another.
pub(crate) fn triple(b: &mut Bytes<'_>, other: [i32; 3]) -> [i32; 3] {
    match b.byte() {
        0..=95 => [b.wild(), b.wild(), b.wild()],
        96..=143 => [0; 3].map(|_| b.i8() as i32 * ONE / 16),
        144..=175 => [0, ONE, 0],
        176..=207 => {
            let (shift, k) = (b.byte() & 31, b.i8());
            let turned = [b.i8(), b.i8(), b.i8()];
            let along =
                |i: usize| (((i64::from(other[i]) * k) >> (shift / 2)) + (turned[i] << (shift / 2))) as i32;
            [along(0), along(1), along(2)]
        }
        _ => [0; 3].map(|_| b.i32()),
    }
}

/// Any view, refused ones included.
pub(crate) fn any(b: &mut Bytes<'_>) -> ViewBits {
    let kind = b.byte();
    let eye = triple(b, [0; 3]);
    let along = triple(b, eye);
    let up = if kind & 0x18 == 0 { [0, ONE, 0] } else { triple(b, along) };
    match kind % 3 {
        0 => ViewBits::LookAt(eye, along, up),
        1 => ViewBits::LookAlong(eye, along, up),
        _ => ViewBits::Reference(eye, along, up),
    }
}

/// The direction of n and the up vector, exactly.
fn directions(view: ViewBits) -> ([i64; 3], [i64; 3]) {
    match view {
        ViewBits::LookAt(eye, target, up) => {
            (core::array::from_fn(|i| i64::from(eye[i]) - i64::from(target[i])), up.map(i64::from))
        }
        ViewBits::LookAlong(_, gaze, up) => (gaze.map(|c| -i64::from(c)), up.map(i64::from)),
        ViewBits::Reference(_, n, up) => (n.map(i64::from), up.map(i64::from)),
    }
}

/// The sine of the angle between up and n.
pub(crate) fn sine(view: ViewBits) -> f64 {
    let (n, up) = directions(view);
    length(cross_exact(n, up)) / (length(n.map(|c| c as f64)) * length(up.map(|c| c as f64)))
}

fn reals(view: &ViewTransform) -> M3 {
    view.rows().map(|row| row.map(|c| f64::from(c) / f64::from(1 << 30)))
}

/// The three constructors must return `got`, whose rows are the exact ones.
fn same(got: Result<ViewTransform, ViewTransformError>, view: ViewBits) {
    let (n, up) = directions(view);
    if n == [0; 3] {
        return assert_eq!(got.err(), Some(ViewTransformError::ZeroDirection));
    }
    if up == [0; 3] {
        return assert_eq!(got.err(), Some(ViewTransformError::ZeroUp));
    }
    // Within 2⁻¹² rad, less a thousandth for the rounding of unit vectors in 2⁻³⁰.
    let (sine, bound) = (sine(view), 2f64.powi(-12).sin());
    match got {
        Err(error) => {
            assert_eq!(error, ViewTransformError::ParallelUp);
            assert!(sine < bound * 1.001, "{sine}: {view:?}");
        }
        Ok(got) => {
            assert!(sine > bound * 0.999, "{sine}: {view:?}");
            let exact = view.exact().rows;
            for (ours, exact) in reals(&got).iter().flatten().zip(exact.iter().flatten()) {
                // 2⁻²⁹ for VUP well away, growing as 1/sine; the oracle's own f64 counts for nothing.
                assert!((ours - exact).abs() * sine <= 2f64.powi(-28), "{ours} for {exact}: {view:?}");
            }
        }
    }
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    match b.byte() {
        0..=159 => {
            let view = any(b);
            same(view.library(), view);
        }
        160..=191 => {
            let (vrp, vpn) = (triple(b, [0; 3]), triple(b, [ONE; 3]));
            let (got, vpn) = if b.byte() & 1 == 0 {
                (ViewTransform::trimetric(point(vrp), vector(vpn)), vpn)
            } else {
                let [side, up, _] = vpn;
                (ViewTransform::dimetric(point(vrp), scalar(side), scalar(up)), [side, up, side])
            };
            let [x, y, z] = vpn.map(i32::unsigned_abs);
            let pairs = x == y
                || y == z
                || (z == x && got != ViewTransform::dimetric(point(vrp), scalar(vpn[0]), scalar(vpn[1])));
            if [x, y, z].contains(&0) || pairs {
                assert_eq!(got.err(), Some(ViewTransformError::NotAxonometric), "{vpn:?}");
            } else {
                same(got, ViewBits::Reference(vrp, vpn, [0, ONE, 0]));
            }
        }
        _ => matrix(b),
    }
}

/// A rotation and a shift, with some of the numbers exchanged for others.
fn matrix(b: &mut Bytes<'_>) {
    let view = any(b);
    let mut m = [[0.0; 4]; 4];
    m[3][3] = 1.0;
    if sine(view) > 1e-6 {
        for (row, axis) in m.iter_mut().zip(view.exact().rows) {
            row[..3].copy_from_slice(&axis);
            row[3] = f64::from(b.wild()) / 65_536.0;
        }
    }
    for _ in 0..b.byte() & 3 {
        let at = usize::from(b.byte() & 15);
        let value = match b.byte() {
            0..=63 => b.f64(),
            64..=127 => m[at / 4][at % 4] + f64::from(b.i16()) * 1e-10,
            _ => -m[at / 4][at % 4],
        };
        m[at / 4][at % 4] = value;
    }
    let got = ViewTransform::from_matrix(&m);
    let rows: M3 = core::array::from_fn(|i| [m[i][0], m[i][1], m[i][2]]);
    // The distance from the documented condition; NaN counts as too far. Rounding the rows to 2⁻³¹, or from up to 1 + 2·10⁻⁶
    // down to 1, changes it by less than 10⁻⁸.
    let mut off = 0f64;
    for i in 0..3 {
        for j in 0..=i {
            let wanted = if i == j { 1.0 } else { 0.0 };
            let gap = (chain::dot(rows[i], rows[j]) - wanted).abs();
            off = if gap.is_nan() { f64::INFINITY } else { off.max(gap) };
        }
    }
    // −R⁻¹·t, by the cofactors.
    let cofactors: M3 = core::array::from_fn(|k| chain::cross(rows[(k + 1) % 3], rows[(k + 2) % 3]));
    let determinant = chain::dot(rows[0], cofactors[0]);
    let eye: [f64; 3] =
        core::array::from_fn(|i| -(0..3).map(|k| cofactors[k][i] * m[k][3]).sum::<f64>() / determinant);
    let away = eye.iter().fold(0.0, |far: f64, c| if c.is_nan() { f64::INFINITY } else { far.max(c.abs()) });
    let right_handed = chain::dot(chain::cross(rows[0], rows[1]), rows[2]) > 0.0;
    let last = m[3] == [0.0, 0.0, 0.0, 1.0];
    match got {
        Err(ViewTransformError::NotRigid) => assert!(!last || !right_handed || off > 3.99e-6, "{m:?}"),
        Err(ViewTransformError::EyeOutside) => assert!(away >= 32_767.999, "{m:?}"),
        Err(error) => panic!("{error}: {m:?}"),
        Ok(view) => {
            assert!(last && right_handed && off < 4.001e-6 && away <= 32_768.001, "{m:?}");
            for (ours, wanted) in reals(&view).iter().flatten().zip(rows.iter().flatten()) {
                // To 2⁻³¹, or brought to 1 from 2·10⁻⁶ beyond.
                assert!((ours - wanted.clamp(-1.0, 1.0)).abs() <= 2f64.powi(-31) * 1.001, "{m:?}");
            }
            for (ours, wanted) in view.eye().iter().zip(eye) {
                // To 2⁻³³, and what f64 makes of numbers of the translation's size.
                let error = (*ours as f64 / 2f64.powi(32) - wanted).abs();
                assert!(error <= 2f64.powi(-33) * 1.001 + 1e-15 * away, "{m:?}");
            }
            // What was rounded once is taken back as it is, but on the very edge of the world.
            if away < 32_767.9 {
                assert_eq!(ViewTransform::from_matrix(&view.to_matrix()), Ok(view), "{m:?}");
            }
        }
    }
}
