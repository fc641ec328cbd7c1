//! Views: look-at, its variants, and the axonometric ones.

use crate::fuzzed::Bytes;
use pinhole::{camera::CameraError, ViewTransform};
use support::bridge::pair::{rows, ViewBits, ONE};
use support::oracle::chain::{cross_exact, length};

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

/// The three constructors must return `got`, whose rows are the exact ones.
fn same(got: Result<ViewTransform, CameraError>, view: ViewBits) {
    let (n, up) = directions(view);
    if n == [0; 3] {
        return assert_eq!(got.err(), Some(CameraError::Direction));
    }
    if up == [0; 3] {
        return assert_eq!(got.err(), Some(CameraError::Direction));
    }
    // Within 2⁻¹² rad, less a thousandth for the rounding of unit vectors in 2⁻³⁰.
    let (sine, bound) = (sine(view), 2f64.powi(-12).sin());
    match got {
        Err(error) => {
            assert_eq!(error, CameraError::Direction);
            assert!(sine < bound * 1.001, "{sine}: {view:?}");
        }
        Ok(got) => {
            assert!(sine > bound * 0.999, "{sine}: {view:?}");
            let exact = view.exact().rows;
            for (ours, exact) in rows(&got).iter().flatten().zip(exact.iter().flatten()) {
                // 2⁻²⁹ for VUP well away, growing as 1/sine; the oracle's own f64 counts for nothing.
                assert!((ours - exact).abs() * sine <= 2f64.powi(-28), "{ours} for {exact}: {view:?}");
            }
        }
    }
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    let view = any(b);
    same(view.library(), view);
}
