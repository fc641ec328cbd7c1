//! docs/spec.md, sections 3 and 4: worked example A by hand; planar projections by position of the view plane: the general matrix
//! that contains all others, Q → ∞, and the planes that are refused. That images are the projector cut by the plane is in `bounds`.

use pinhole::space::{View, World};
use pinhole::{PlanarProjection, Point3, Projection, ProjectionError, Vector3, ViewTransform};
use support::bridge::pair::{rows, window, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::definition::Family;
use support::oracle::chain::fx;
use support::oracle::rng::Rng;

/// Half a unit of the last place of I16F16, and a little for earlier roundings.
const HALF: f64 = 0.502 / 65536.0;

fn example_a() -> ViewTransform {
    let (vrp, vpn, vup) =
        (Point3::from_ints(1, 2, 3), Vector3::from_ints(2, -1, 2), Vector3::from_ints(0, 1, 0));
    ViewTransform::from_reference(vrp, vpn, vup).expect("a view")
}

#[test]
fn s3_worked_example_a_is_a_view() {
    let v = example_a();
    let r2 = 2f64.sqrt();
    let exact = [
        [1.0 / r2, 0.0, -1.0 / r2],
        [1.0 / (3.0 * r2), 4.0 / (3.0 * r2), 1.0 / (3.0 * r2)],
        [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0],
    ];
    for (row, exact) in rows(&v).iter().zip(exact) {
        close(row, &exact, 2f64.powi(-29), "u, v, n");
    }
    // The translation column: the image of the world's origin.
    let column = [r2, -2.0 * r2, -2.0];
    close(&reals(v.apply(Point3::from_ints(0, 0, 0))), &column, 1.1 * HALF, "column");
    close(&v.translation().map(|c| c as f64 / 4_294_967_296.0), &column, 1e-8, "translation()");
    assert_eq!(v.apply(Point3::from_ints(1, 2, 3)), Point3::from_ints(0, 0, 0));
    // The other constructors give an equal view.
    let (eye, up) = (Point3::from_ints(1, 2, 3), Vector3::from_ints(0, 1, 0));
    assert_eq!(ViewTransform::look_at(eye, Point3::from_ints(-1, 3, 1), up), Ok(v));
    assert_eq!(ViewTransform::look_along(eye, Vector3::from_ints(-2, 1, -2), up), Ok(v));
}

fn five() -> [PlanarProjection; 3] {
    let d = scalar(5 * ONE);
    [
        PlanarProjection::eye_at_origin(d).expect("a plane"),
        PlanarProjection::origin_in_plane(d).expect("a plane"),
        PlanarProjection::parallel(),
    ]
}

fn close(ours: &[f64], exact: &[f64], bound: f64, what: &str) {
    for (a, b) in ours.iter().zip(exact) {
        assert!((a - b).abs() <= bound, "{what}: {ours:?} instead of {exact:?}");
    }
}

#[test]
fn s4_worked_example_a_points() {
    let p = example_a().apply(Point3::<World>::from_ints(3, 1, 5));
    close(&reals(p), &[0.0, 0.0, 3.0], 1.1 / 65536.0, "in view coordinates");
    let homogeneous = [[0.0, 0.0, 3.0, 0.6], [0.0, 0.0, 0.0, 1.6], [0.0, 0.0, 0.0, 1.0]];
    let images = [[0.0, 0.0, 5.0], [0.0; 3], [0.0; 3]];
    for (k, planar) in five().iter().enumerate() {
        let got = planar.homogeneous(p).map(|c| fx(c.to_bits()));
        close(&got, &homogeneous[k], 2.0 * HALF, "homogeneous");
        let image = planar.apply(p).expect("an image");
        close(&reals(image), &images[k], 4.0 * HALF, "image");
    }
}

fn random_point(rng: &mut Rng) -> [i32; 3] {
    [0; 3].map(|_| rng.int(-50 * i64::from(ONE), 50 * i64::from(ONE)) as i32)
}

#[test]
fn s4_general_matrix_contains_the_oblique_ones() {
    // Q infinite and (dx, dy) ≠ 0: x − dx/dz·z.
    let oblique = PlanarProjection::general(scalar(0), None, Vector3::from_ints(3, 4, 5)).expect("a plane");
    assert_eq!(oblique.apply(Point3::from_ints(1, 1, -5)), Some(Point3::from_ints(4, 5, 0)));
    assert_eq!(oblique.homogeneous(Point3::from_ints(1, 1, -5)), [4, 5, 0, 1].map(|c| scalar(c * ONE)));
    // Straight down: the parallel one, exactly.
    let straight = PlanarProjection::general(scalar(0), None, Vector3::from_ints(0, 0, 7)).expect("a plane");
    let mut rng = Rng::new(0x4C);
    for _ in 0..1000 {
        let p = point::<View>(random_point(&mut rng));
        assert_eq!(straight.apply(p), PlanarProjection::parallel().apply(p));
    }
}

/// The textbook's matrices look along +n for d > 0, so the picture wants d < 0; a positive d with
/// near and far before the eye has w ≤ 0 and is refused.
#[test]
fn s4_a_view_plane_behind_the_eye_is_refused() {
    let w = window([-ONE, ONE, -ONE, ONE]);
    let (n, f) = (scalar(ONE), scalar(10 * ONE));
    let make = |d: i32| {
        let planar = PlanarProjection::eye_at_origin(scalar(d)).expect("a plane");
        Projection::from_planar(&planar, w, n, f).map(|_| ())
    };
    assert_eq!(make(-ONE), Ok(()));
    assert_eq!(make(ONE), Err(ProjectionError::NearNotPositive));
}

#[test]
fn s4_planar_projections_report_their_own_errors() {
    let none = Err(ProjectionError::NoViewPlane);
    assert_eq!(PlanarProjection::eye_at_origin(scalar(0)), none);
    assert_eq!(PlanarProjection::origin_in_plane(scalar(0)), none);
    for q in [None, Some(scalar(ONE))] {
        assert_eq!(PlanarProjection::general(scalar(0), q, Vector3::from_ints(1, 2, 0)), none);
        assert_eq!(PlanarProjection::general(scalar(0), q, Vector3::from_ints(0, 0, 0)), none);
        assert!(PlanarProjection::general(scalar(0), q, vector([i32::MAX, 0, 1])).is_ok());
    }
    assert_eq!(PlanarProjection::general(scalar(0), Some(scalar(0)), Vector3::from_ints(0, 0, 1)), none);
    // w = 0: no image.
    let first = PlanarProjection::eye_at_origin(scalar(5 * ONE)).expect("a plane");
    assert_eq!(first.apply(Point3::from_ints(1, 1, 0)), None);
    let planar = PlanarProjection::parallel();
    let make = |w: [i32; 4], n: i32, f: i32| {
        Projection::from_planar(&planar, window(w), scalar(n), scalar(f)).map(|_| ())
    };
    let good = [-ONE, ONE, -ONE, ONE];
    assert_eq!(make(good, -ONE, ONE), Ok(()));
    assert_eq!(make([ONE, ONE, -ONE, ONE], 0, ONE), Err(ProjectionError::EmptyWindow));
    assert_eq!(make(good, ONE, ONE), Err(ProjectionError::NearNotBeforeFar));
    let far = [30_000 * ONE, 30_000 * ONE + 1, -ONE, ONE];
    assert_eq!(make(far, 0, ONE), Err(ProjectionError::WindowTooSmall));
    assert_eq!(make(good, 30_000 * ONE, 30_000 * ONE + 1), Err(ProjectionError::NearTooCloseToFar));
}

/// x = x + 2³⁰·(z − 2⁻¹⁰) through a window 2⁻¹⁶ wide: its constant is −2³⁷, which the window's own +1 must not
/// hide.
#[test]
fn s4_a_planar_window_too_small_is_refused_whichever_way_it_lies() {
    for dx in [1 << 30, -(1 << 30)] {
        for (left, right) in [(-1, 0), (0, 1)] {
            let window = [left, right, -ONE, ONE];
            let general = Family::General(ONE >> 10, None, [dx, 0, -1], window, ONE, 2 * ONE);
            assert_eq!(general.library().map(|_| ()), Err(ProjectionError::WindowTooSmall), "{general:?}");
        }
    }
}

/// The centre lies one unit from the origin and almost in the plane, and so does the origin's image, even where a
/// component is `i32::MIN`; the smallest components must not lose their last bit.
#[test]
fn s4_directions_keep_their_last_bit_beside_the_least_number() {
    for least in [i32::MIN, -i32::MAX] {
        for dz in [1, -1, 3, -3] {
            let direction = vector([0, least, dz]);
            let general = PlanarProjection::general(scalar(ONE / 64), Some(scalar(ONE)), direction);
            let image = general.expect("a plane").apply(Point3::from_ints(0, 0, 0)).expect("an image");
            close(&reals(image), &[0.0, -1.0, 1.0 / 64.0], 2.0 * HALF, "beside the origin");
        }
    }
}
