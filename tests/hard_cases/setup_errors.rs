//! E3, E4, E5: each kind of set-up that cannot show a picture has its own error; set-ups close to these are accurate.

use pinhole::{Projection, ProjectionError, ViewTransformError};
use support::bridge::pair::{ProjectionBits, ViewBits, ONE};
use support::oracle::chain::{self, length};
use support::oracle::rng::Rng;

const UP: [i32; 3] = [0, ONE, 0];

#[test]
fn e3_e4_zero_and_parallel_vectors_are_refused() {
    use ViewTransformError::{ParallelUp, ZeroDirection, ZeroUp};
    let (eye, along) = ([ONE, 2 * ONE, -ONE], [ONE, 0, 0]);
    for (view, error) in [
        (ViewBits::LookAt(eye, eye, UP), ZeroDirection),
        (ViewBits::LookAlong(eye, [0; 3], UP), ZeroDirection),
        (ViewBits::Reference(eye, [0; 3], UP), ZeroDirection),
        (ViewBits::LookAt(eye, [0; 3], [0; 3]), ZeroUp),
        (ViewBits::LookAlong(eye, along, [0; 3]), ZeroUp),
        (ViewBits::Reference(eye, along, [0; 3]), ZeroUp),
    ] {
        assert_eq!(view.library().err(), Some(error), "{view:?}");
    }
    for k in [1, 3, -7, 1 << 14, -(1 << 14)] {
        for d in [[1, 2, -3], [0, 0, 1], [-1, 0, 0], [60000, 1, -60000]] {
            let view = ViewBits::Reference([0; 3], d, d.map(|c| c * k));
            assert_eq!(view.library().err(), Some(ParallelUp), "{d:?} {k}");
        }
    }
}

#[test]
fn e3_up_vectors_are_refused_exactly_below_the_documented_angle() {
    // VUP within 2⁻¹² rad of the line of VPN is an error, beyond it is not. Exact angles from the
    // integers; a thousandth of the bound is left to rounding.
    let mut rng = Rng::new(0xE3);
    let bound = 2f64.powi(-12);
    let (mut errors, mut views) = (0, 0);
    while errors < 5000 || views < 5000 {
        // A long VPN and a VUP nearly along it, both large, so that the angle is finely set.
        let n = rng.direction();
        let across = chain::normalise(chain::cross(n, rng.direction()));
        let angle = bound * rng.real(0.9, 1.1);
        let (sign, scale) = ([1.0, -1.0][rng.below(2)], rng.log(2000.0, 30000.0));
        let up: [f64; 3] =
            core::array::from_fn(|i| sign * scale * (n[i] * angle.cos() + across[i] * angle.sin()));
        let to = |v: [f64; 3]| v.map(|c| (c * 65536.0) as i32);
        let shorter = rng.log(2000.0, 30000.0);
        let (n, up) = (to(n.map(|c| c * shorter)), to(up));
        let c = length(chain::cross_exact(n.map(i64::from), up.map(i64::from)));
        let l = |v: [i32; 3]| length(v.map(f64::from));
        let sine = c / (l(n) * l(up));
        let angle = sine.asin();
        let (view, eye) = (ViewBits::Reference([5, 6, 7], n, up), [5, 6, 7]);
        let along = ViewBits::LookAlong(eye, n.map(|c| -c), up);
        if angle < bound * 0.999 {
            errors += 1;
            assert_eq!(view.library().err(), Some(ViewTransformError::ParallelUp), "{angle}");
            assert_eq!(along.library().err(), Some(ViewTransformError::ParallelUp), "{angle}");
        } else if angle > bound * 1.001 {
            views += 1;
            assert!(view.library().is_ok() && along.library().is_ok(), "{angle} {view:?}");
        }
    }
}

#[test]
fn e4_tiny_and_huge_vectors_are_accepted() {
    let all = [1, -1, i32::MAX, i32::MIN, ONE];
    for &a in &all {
        for &b in &all {
            for &c in &all {
                assert!(ViewBits::Reference([c, a, b], [a, 0, 0], [0, c, b]).library().is_ok());
                assert!(ViewBits::LookAlong([a, b, c], [0, a, b], [c, 0, 0]).library().is_ok());
                let _ = ViewBits::LookAt([a, b, c], [c, a, b], [b, a, c]).library();
                let _ = ViewBits::LookAt([a, a, a], [b, b, b], [c, a, b]).library();
            }
        }
    }
}

#[test]
fn e5_near_and_far_must_be_positive_and_in_order() {
    let frustum = |near, far| ProjectionBits::Frustum(WINDOW, near, far).library();
    let flat = |near, far| ProjectionBits::Orthographic(WINDOW, near, far).library();
    for near in [0, -1, -ONE, i32::MIN] {
        for far in [ONE, i32::MAX, -5] {
            let error = Err(ProjectionError::NearNotPositive);
            assert_eq!((perspective(near, far), frustum(near, far)), (error, error));
        }
    }
    for (near, far) in [(ONE, ONE), (ONE, ONE - 1), (ONE, 1), (i32::MAX, ONE), (5, -5), (1, 0)] {
        let error = Err(ProjectionError::NearNotBeforeFar);
        assert_eq!([perspective(near, far), frustum(near, far), flat(near, far)], [error; 3]);
    }
    // A box may begin behind the eye.
    assert!(flat(-5 * ONE, 5 * ONE).is_ok() && flat(0, 1).is_ok());
    assert!(perspective(1, i32::MAX).is_ok() && perspective(ONE / 4, 32767 * ONE).is_ok());
}

#[test]
fn e5_near_too_close_to_far_is_refused_exactly_at_the_bound() {
    // near·far/(far − near) < 2³⁰
    let mut rng = Rng::new(0x27);
    let (mut errors, mut fine) = (0, 0);
    for k in 0..40_000 {
        let near = rng.log(1.0, 2e9) as i64;
        let far = match k % 3 {
            0 => near + rng.log(1.0, 1e5) as i64,
            // Right at the bound: far − near = near·far / 2⁴⁶ or so in bits.
            1 => near + ((i128::from(near) * i128::from(near)) >> 46) as i64 + rng.int(-2, 3),
            _ => rng.int(1, i64::from(i32::MAX)),
        };
        if far <= near || far > i64::from(i32::MAX) {
            continue;
        }
        // In bits of 2⁻¹⁶: n·f/(f − n)·2⁻¹⁶
        let size = (near as f64 * far as f64) / ((far - near) as f64) / 65536.0;
        let ours = perspective(near as i32, far as i32);
        let limit = f64::from(1 << 30);
        if size < limit * 0.999_999 {
            fine += 1;
            assert!(ours.is_ok(), "{near} {far}: {ours:?}");
        } else if size > limit * 1.000_001 {
            errors += 1;
            assert_eq!(ours, Err(ProjectionError::NearTooCloseToFar), "{near} {far}");
        }
    }
    assert!(errors > 100 && fine > 1000, "{errors} {fine}");
}

#[test]
fn e5_fields_of_view_outside_the_documented_range_are_refused() {
    let fov = |bits| ProjectionBits::Perspective(bits, (4, 3), ONE, 9 * ONE).library();
    for bits in [0, 1, 1000, 1 << 31, (1 << 31) - 1, (1 << 31) + 1, 3 << 30, u32::MAX] {
        assert_eq!(fov(bits), Err(ProjectionError::FieldOfView), "{bits}");
    }
    // The documented bound: 1/4096 turn from 0° and from 180°.
    for (bits, ok) in [
        ((1 << 20) - 1, false),
        ((1 << 20) + 1, true),
        ((1 << 31) - (1 << 20) - 1, true),
        ((1 << 31) - (1 << 20) + 1, false),
        (1 << 30, true),
    ] {
        assert_eq!(fov(bits).is_ok(), ok, "{bits}");
    }
}

#[test]
fn e5_empty_and_extreme_windows_and_aspects_are_refused() {
    let frustum = |window| ProjectionBits::Frustum(window, ONE, 9 * ONE).library();
    let flat = |window| ProjectionBits::Orthographic(window, ONE, 9 * ONE).library();
    for window in [
        [0; 4],
        [ONE, ONE, -ONE, ONE],
        [ONE, -ONE, -ONE, ONE],
        [-ONE, ONE, ONE, ONE],
        [-ONE, ONE, ONE, -ONE],
        [i32::MAX, i32::MIN, 0, 1],
    ] {
        assert_eq!([frustum(window), flat(window)], [Err(ProjectionError::EmptyWindow); 2]);
    }
    let by_aspect = |aspect| ProjectionBits::Perspective(1 << 30, aspect, ONE, 9 * ONE).library();
    for aspect in [(0, 3), (4, 0), (0, 0)] {
        assert_eq!(by_aspect(aspect), Err(ProjectionError::EmptyAspect));
    }
    // The thinnest and the widest.
    for aspect in [(1, u32::MAX), (u32::MAX, 1), (u32::MAX, u32::MAX), (1, 1)] {
        assert!(by_aspect(aspect).is_ok());
    }
    for window in [[0, 1, 0, 1], [i32::MIN, i32::MAX, i32::MIN, i32::MAX]] {
        assert!(frustum(window).is_ok() && flat(window).is_ok());
    }
    // The smallest window at the largest distance from the axis: 2⁻¹⁶ at 2¹⁵ is 2³¹ times smaller.
    let window = [i32::MAX - 1, i32::MAX, 0, ONE];
    let small = Err(ProjectionError::WindowTooSmall);
    assert_eq!(flat(window), small);
    assert!(frustum(window).is_ok() || frustum(window) == small);
    assert!(flat([ONE - 1, ONE, 0, ONE]).is_ok());
}

/// 60°, 4 : 3.
fn perspective(near: i32, far: i32) -> Result<Projection, ProjectionError> {
    ProjectionBits::Perspective((1 << 31) / 3, (4, 3), near, far).library()
}

const WINDOW: [i32; 4] = [-ONE, ONE, -ONE, ONE];
