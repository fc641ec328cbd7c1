//! docs/spec.md, sections 3 and 4: worked example A by hand; planar projections by position of the view plane: the general matrix
//! that contains all others, Q → ∞, and the planes that are refused; and projections by name: the defining property of each. That
//! images are the projector cut by the plane is in `bounds`.

use pinhole::space::World;
use pinhole::{camera::CameraError, prelude::*};
use support::bridge::pair::{random_view, rows, window, CameraBits, ProjectionBits, ViewBits, ONE};
use support::bridge::{point, reals, scalar, vector, viewport};
use support::definition::Projectors;
use support::oracle::chain::{self, fx, V3};
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
    close(&v.to_matrix().map(|row| row[3])[..3], &column, 1e-8, "to_matrix()");
    assert_eq!(v.apply(Point3::from_ints(1, 2, 3)), Point3::from_ints(0, 0, 0));
    // The other constructor gives an equal view.
    let (eye, up) = (Point3::from_ints(1, 2, 3), Vector3::from_ints(0, 1, 0));
    assert_eq!(ViewTransform::look_at(eye, Point3::from_ints(-1, 3, 1), up), Ok(v));
}

/// The worked set-ups of docs/spec.md, section 4, by VRP, VPN and projection.
fn set_ups() -> [CameraBits; 4] {
    const H: i32 = ONE / 2;
    let (back, up, window) =
        (-4 * ONE, [0, ONE, 0], |low: i32, high: i32| [low, high, low, high].map(|side| side * ONE));
    let far = [0, 0, 10 * ONE];
    [
        ([0; 3], [0, 0, ONE], ProjectionBits::Reference([H, H, ONE], window(-1, 3), H, back)),
        ([2 * ONE, H, 0], [ONE, 0, ONE], ProjectionBits::Reference(far, window(-10, 20), H, back)),
        ([2 * ONE, H, 0], [ONE, 0, ONE], ProjectionBits::Reference(far, window(-1, 2), H, back)),
        ([ONE, H, 0], [0, 0, ONE], ProjectionBits::ReferenceParallel(far, window(-2, 2), H, back)),
    ]
    .map(|(vrp, vpn, projection)| {
        let view = ViewBits::Reference(vrp, vpn, up);
        CameraBits { view, projection, viewport: (0, 0, 240, 240) }
    })
}

#[test]
fn s4_worked_set_ups() {
    // The cube [0, 1]² × [−1, 0].
    let cube: [[i32; 3]; 8] =
        core::array::from_fn(|k| [k as i32 & 1, k as i32 >> 1 & 1, (k as i32 >> 2) - 1]);
    let exact = set_ups().map(|set_up| {
        let (camera, exact) = (set_up.library(), set_up.exact());
        cube.map(|corner| {
            let at = exact.view.apply(corner.map(f64::from));
            let exact = set_up.projection.picture().screen(&exact.viewport, at);
            let seen = camera.project(point(corner.map(|c| c * ONE))).expect("in view").point;
            close(
                &[seen.x(), seen.y()].map(|c| f64::from(c) / 256.0),
                &[exact.0, exact.1],
                1.0 / 256.0,
                "a corner",
            );
            exact
        })
    });
    // By hand. One-point: the face z = 0 lies in the view plane, so 1 unit is 60 px and (0, 0) is at
    // 60 px from the left; the far face z = −1 is twice as far from the PRP, hence half as large about (½, ½).
    let near_to = |got: (f64, f64), x: f64, y: f64| close(&[got.0, got.1], &[x, y], 1e-9, "by hand");
    near_to(exact[0][4], 60.0, 180.0);
    near_to(exact[0][0], 75.0, 165.0);
    // Parallel: DOP (0, 0, −10) is along n, so both faces coincide: 60 px a unit about (1, ½).
    near_to(exact[3][0], 60.0, 150.0);
    assert_eq!(exact[3][0], exact[3][4]);
}

#[test]
fn s4_the_direction_of_a_parallel_projection_is_window_center_minus_prp() {
    let Projectors::Along(d) = set_ups()[3].projection.picture().projectors else { panic!("parallel") };
    assert_eq!(d, [0.0, 0.0, -10.0]);
    // Off the centre it is oblique: a unit of depth moves by (2, −1)/4 of a unit.
    let (prp, area) = (point([-2 * ONE, ONE, 4 * ONE]), window([-ONE, ONE, -ONE, ONE]));
    let lens = Projection::parallel_from_reference(prp, area, scalar(0), scalar(-4 * ONE)).expect("a volume");
    let got = lens.apply(point([0, 0, -4 * ONE])).expect("a point before the eye");
    // DOP = (0, 0, 0) − (−2, 1, 4) = (2, −1, −4): from (0, 0, −4) back along it to (−2, 1, 0).
    assert_eq!(reals(got), [-2.0, 1.0, 1.0]);
}

/// A planar projection through a window of −1 … 1, between these planes: images are in the plane's own coordinates.
fn planar(
    z_p: i32,
    distance: Option<i32>,
    direction: [i32; 3],
    near: i32,
    far: i32,
) -> Result<Projection, CameraError> {
    let square = window([-ONE, ONE, -ONE, ONE]);
    let direction = vector(direction);
    Projection::planar(scalar(z_p), distance.map(scalar), direction, square, scalar(near), scalar(far))
}

/// x and y of the image of a point, by the matrix as stored.
fn image(lens: &Projection, p: [f64; 3]) -> [f64; 2] {
    let [x, y, _, w] = chain::mul4(&lens.to_matrix(), [p[0], p[1], p[2], 1.0]);
    [x / w, y / w]
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
    // The centre at the origin and the plane at 5, the plane at 0 and the centre at −5, and at infinity. w is 3/5, 8/5 and 1.
    let (d, back) = (5 * ONE, [0, 0, -1]);
    let lenses = [(d, Some(d)), (0, Some(d)), (0, None)];
    for ((z_p, distance), w) in lenses.into_iter().zip([0.6, 1.6, 1.0]) {
        // The picture shows z from 9 to 1.
        let lens = planar(z_p, distance, back, -9 * ONE, -ONE).expect("a plane");
        close(&image(&lens, reals(p)), &[0.0; 2], 4.0 * HALF, "image");
        let [.., row] = lens.to_matrix();
        let at = |z: f64| row[2] * z + row[3];
        close(&[at(3.0) / at(fx(z_p))], &[w], 2.0 * HALF, "w, which is 1 in the plane");
    }
}

#[test]
fn s4_general_matrix_contains_the_oblique_ones() {
    // Q infinite and (dx, dy) ≠ 0: x − dx/dz·z.
    let oblique = planar(0, None, [3, 4, 5], ONE, 9 * ONE).expect("a plane");
    let seen = oblique.apply(Point3::from_ints(1, 1, -5)).expect("an image");
    assert_eq!((seen.x(), seen.y(), seen.z()), (scalar(4 * ONE), scalar(5 * ONE), scalar(0)));
    // Straight down: the orthographic one, exactly.
    let straight = planar(0, None, [0, 0, 7], ONE, 9 * ONE).expect("a plane");
    let square = window([-ONE, ONE, -ONE, ONE]);
    let orthographic = Projection::orthographic(square, scalar(ONE), scalar(9 * ONE)).expect("a box");
    for (planar, row) in straight.to_matrix().iter().zip(orthographic.to_matrix()) {
        close(planar, &row, 2f64.powi(-30), "rows");
    }
}

/// The textbook's matrices look along +n for d > 0, so the picture wants d < 0; a positive d with
/// near and far before the eye has w ≤ 0 and is refused.
#[test]
fn s4_a_view_plane_behind_the_eye_is_refused() {
    let back = [0, 0, -1];
    let make = |d: i32| planar(d, Some(d), back, ONE, 10 * ONE).map(|_| ());
    assert_eq!(make(-ONE), Ok(()));
    assert_eq!(make(ONE), Err(CameraError::NearNotPositive));
    // Points in the plane of the eye have w = 0: the near plane at the eye, and the far plane at an eye beyond the picture.
    assert_eq!(planar(-ONE, Some(-ONE), back, 0, 10 * ONE).err(), Some(CameraError::NearNotPositive));
    let to = |far: i32| planar(0, Some(8 * ONE), back, ONE, far).map(|_| ());
    assert_eq!([to(8 * ONE - 1), to(8 * ONE)], [Ok(()), Err(CameraError::NearNotPositive)]);
}

/// −front/(front − back) is beyond the range of numbers where the planes are a step of 2⁻¹⁶ apart.
#[test]
fn s4_planes_of_a_parallel_volume_too_close_to_each_other_are_refused() {
    let make = |front: i32, back: i32| {
        let prp = point([0, 0, ONE]);
        let square = window([-ONE, ONE, -ONE, ONE]);
        Projection::parallel_from_reference(prp, square, scalar(front), scalar(back)).map(|_| ())
    };
    assert_eq!(make(-20_000 * ONE, -20_001 * ONE), Ok(()));
    assert_eq!(make(-20_000 * ONE, -20_000 * ONE - 1), Err(CameraError::NearNotBeforeFar));
}

#[test]
fn s4_a_point_at_the_eye_has_no_planar_image() {
    let lens = planar(-5 * ONE, Some(-5 * ONE), [0, 0, -1], ONE, 9 * ONE).expect("a plane");
    assert_eq!(lens.apply(Point3::from_ints(1, 1, 0)), None);
}

/// x = x + 2³⁰·(z − 2⁻¹⁰) through a window 2⁻¹⁶ wide: its constant is −2³⁷, which the window's own +1 must not
/// hide.
#[test]
fn s4_a_planar_window_too_small_is_refused_whichever_way_it_lies() {
    for dx in [1 << 30, -(1 << 30)] {
        for (left, right) in [(-1, 0), (0, 1)] {
            let window = [left, right, -ONE, ONE];
            let general = ProjectionBits::General(ONE >> 10, None, [dx, 0, -1], window, ONE, 2 * ONE);
            assert_eq!(general.library().map(|_| ()), Err(CameraError::EmptyWindow), "{general:?}");
        }
    }
}

/// The centre lies one unit from the origin and almost in the plane, and so does the origin's image, even where a
/// component is `i32::MIN`; the smallest components must not lose their last bit.
#[test]
fn s4_directions_keep_their_last_bit_beside_the_least_number() {
    for least in [i32::MIN, -i32::MAX] {
        for dz in [1, -1, 3, -3] {
            // One step of depth on the side of the plane where the centre is not.
            let (z_p, back) = (ONE / 64, if dz > 0 { 1 } else { -2 });
            let lens = planar(z_p, Some(ONE), [0, least, dz], back - z_p, back + 1 - z_p).expect("a plane");
            close(&image(&lens, [0.0; 3]), &[0.0, -1.0], 2.0 * HALF, "beside the origin");
        }
    }
}

/// 100 px a unit about (2000, 2000), in a viewport of 4000 × 4000.
fn drawing(view: &ViewTransform, projection: &Projection) -> Camera {
    Camera::new(view, projection, &viewport(0, 0, 4000, 4000))
}

fn orthographic() -> Projection {
    let w = window([-20 * ONE, 20 * ONE, -20 * ONE, 20 * ONE]);
    Projection::orthographic(w, scalar(-100 * ONE), scalar(100 * ONE)).expect("a box")
}

/// The position of a point in the drawing, in units, x to the right and y up.
fn at(camera: &Camera, p: [i32; 3]) -> (f64, f64) {
    let p = camera.project(point(p)).expect("on the drawing").point;
    ((f64::from(p.x()) / 256.0 - 2000.0) / 100.0, (2000.0 - f64::from(p.y()) / 256.0) / 100.0)
}

/// 1/256 px at both ends.
const PX: f64 = 2.0 / 256.0 / 100.0;

fn foreshortening(view: &ViewTransform) -> [f64; 3] {
    let camera = drawing(view, &orthographic());
    let o = at(&camera, [0; 3]);
    [0, 1, 2].map(|axis| {
        let mut p = [0; 3];
        p[axis] = 10 * ONE;
        let a = at(&camera, p);
        (a.0 - o.0).hypot(a.1 - o.1) / 10.0
    })
}

fn near_to(got: f64, want: f64, room: f64, what: &str) {
    assert!((got - want).abs() <= room, "{what}: {got} instead of {want}");
}

#[test]
fn s4_multiview_keeps_faces_parallel_to_the_plane_at_their_exact_size() {
    // Which world axes point right and up, and which to the viewer.
    let sides: [(&str, V3, V3, V3); 6] = [
        ("front", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ("back", [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]),
        ("right", [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        ("left", [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]),
        ("top", [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        ("bottom", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
    ];
    let mut rng = Rng::new(0x51);
    for (side, right, up, near) in sides {
        assert_eq!(chain::cross(right, up), near, "right-handed");
        for _ in 0..300 {
            let vrp = [0; 3].map(|_| rng.int(-100, 100) as i32 * ONE);
            let [vpn, vup] = [near, up].map(|axis| vector(axis.map(|c| c as i32)));
            let view = ViewTransform::from_reference(point(vrp), vpn, vup).expect("a view");
            let camera = drawing(&view, &orthographic());
            let p = [0; 3].map(|_| rng.int(-1000, 1000) as i32 * (ONE / 64));
            let world = [0, 1, 2].map(|i| vrp[i] + p[i]);
            let got = at(&camera, world);
            let exact = chain::fx3(p);
            // 1/64 unit is 1.5625 px = 400/256: on the grid, so exact.
            assert_eq!(got, (chain::dot(right, exact), chain::dot(up, exact)), "{side:?} {p:?}");
            // The nearer of two is the one farther along the normal.
            let depth = |d: i32| {
                let q = [0, 1, 2].map(|i| world[i] + near[i] as i32 * d);
                camera.project(point(q)).expect("seen").depth
            };
            assert!(depth(ONE) < depth(0));
        }
    }
}

/// Each axis by the root of 1 − the square of the VPN's component, whose squares sum to 2 in every axonometric view.
#[test]
fn s4_axonometric_views_foreshorten_by_their_normal() {
    let mut rng = Rng::new(0x53);
    let mut seen = 0;
    for case in 0..2000 {
        let [x, y, z] = [0; 3].map(|_| rng.int(-400_000, 400_000) as i32);
        let vpn = if case % 2 == 0 { [x, y, z] } else { [x, y, x] };
        let view = ViewTransform::from_reference(point([0; 3]), vector(vpn), vector([0, ONE, 0]));
        let Ok(view) = view else { continue };
        seen += 1;
        let n = chain::normalise(chain::fx3(vpn));
        for (f, n) in foreshortening(&view).into_iter().zip(n) {
            near_to(f, (1.0 - n * n).sqrt(), PX / 5.0, "axis");
        }
    }
    assert!(seen > 1900, "{seen}");
}

/// For each VPN: the number of non-zero components is the number of finite vanishing points, and each
/// lies where points far out on the axis are seen.
#[test]
fn s4_n_point_perspectives_have_n_vanishing_points_where_the_axes_go() {
    let mut rng = Rng::new(0x55);
    let mut seen = [0; 4];
    for _ in 0..20_000 {
        let vpn = [0; 3].map(|_| {
            if rng.one_in(3) {
                0
            } else {
                rng.int(-5 * i64::from(ONE), 5 * i64::from(ONE)) as i32
            }
        });
        let up = if vpn[0] == 0 && vpn[2] == 0 { [0, 0, ONE] } else { [0, ONE, 0] };
        let view = ViewBits::Reference([ONE, -ONE, 3 * ONE], vpn, up);
        if view.library().is_err() {
            continue;
        }
        let projection = match rng.below(3) {
            0 => ProjectionBits::Perspective(rng.int(1 << 26, 3 << 29) as u32, (300, 200), ONE, 100 * ONE),
            1 => ProjectionBits::Frustum([-ONE, 2 * ONE, -2 * ONE, ONE], ONE, 100 * ONE),
            _ => ProjectionBits::Reference(
                [ONE, ONE / 2, 5 * ONE],
                [-ONE, 2 * ONE, -2 * ONE, ONE],
                4 * ONE,
                -90 * ONE,
            ),
        };
        let camera = CameraBits { view, projection, viewport: (10, 20, 300, 200) };
        let points = camera.library().vanishing_points();
        let count = vpn.iter().filter(|&&c| c != 0).count();
        // Within 2⁻²⁵ of the view plane a point may be missing.
        let length = chain::length(chain::fx3(vpn));
        let close_to_plane = vpn.iter().any(|&c| c != 0 && fx(c).abs() / length < 2f64.powi(-20));
        assert!(close_to_plane || points.iter().flatten().count() == count, "{vpn:?} {points:?}");
        seen[count] += 1;
        let (exact, picture) = (camera.exact(), projection.picture());
        for (axis, found) in points.iter().enumerate() {
            assert_eq!(found.is_some(), vpn[axis] != 0 || close_to_plane && found.is_some());
            let Some(found) = found else { continue };
            // The limit of points ever farther out on the axis, in f64.
            let sign = -f64::from(vpn[axis].signum());
            let limit = |t: f64| {
                let direction: V3 = core::array::from_fn(|i| exact.view.rows[i][axis] * sign * t);
                picture.screen(&exact.viewport, direction)
            };
            let ((x, y), (x_before, y_before)) = (limit(1e13), limit(1e12));
            let gap = (x - x_before).abs().max((y - y_before).abs());
            // The direction's slope against the view plane is known to 2⁻³⁰.
            let slope = exact.view.rows[2][axis].abs();
            let far = 1.0 + x.abs().max(y.abs());
            let room = 1.0 / 256.0
                + gap
                + far * (300.0 * 2f64.powi(-29) + far * 2f64.powi(-29)) / 100.0
                + far * 2f64.powi(-28) / slope;
            if far < 1e6 {
                let got = (f64::from(found[0]) / 256.0, f64::from(found[1]) / 256.0);
                assert!(
                    (got.0 - x).abs() <= room && (got.1 - y).abs() <= room,
                    "{got:?} for {x} {y} ± {room}: {vpn:?} {projection:?}"
                );
            } else {
                assert!(found.iter().any(|c| f64::from(*c).abs() > 1e8), "{found:?} for {x} {y}");
            }
        }
    }
    assert!(seen[1..].iter().all(|&n| n > 1000), "{seen:?}");
}

#[test]
fn s4_parallel_projections_have_no_vanishing_points() {
    let mut rng = Rng::new(0x56);
    let w = [-2 * ONE, 2 * ONE, -2 * ONE, 2 * ONE];
    for _ in 0..500 {
        let view = random_view(&mut rng).library().expect("a view");
        for family in [
            ProjectionBits::Orthographic(w, -ONE, ONE),
            ProjectionBits::Oblique(w, -ONE, ONE, rng.bits(), ONE),
            ProjectionBits::ReferenceParallel([ONE, ONE, ONE], w, 0, -ONE),
            ProjectionBits::PlanarParallel(w, -ONE, ONE),
            ProjectionBits::General(0, None, [ONE, ONE, 2 * ONE], w, -ONE, ONE),
        ] {
            let camera = drawing(&view, &family.library().expect("a projection"));
            assert_eq!(camera.vanishing_points(), [None; 3], "{family:?}");
        }
    }
}

/// Looking up or down by 1/5000 rad through the longest lens, verticals meet millions of pictures away: up
/// there, or down there, at the ends of the numbers.
#[test]
fn s4_vanishing_points_beyond_all_numbers_keep_their_side() {
    let family = ProjectionBits::Perspective((1 << 20) + 1, (240, 240), ONE, 9 * ONE);
    for up in [1, -1] {
        let view = ViewTransform::from_reference(point([0; 3]), vector([0, -up, 5000]), vector([0, ONE, 0]));
        let camera = drawing(&view.expect("a view"), &family.library().expect("a projection"));
        let [_, y, _] = camera.vanishing_points();
        assert_eq!(y, Some([2000 * 256, -up << 30]));
    }
}

/// Verticals meet in a point if the view plane is inclined to them by 2⁻²⁵ or more, and stay parallel if by less.
#[test]
fn s4_vanishing_points_begin_at_their_documented_angle() {
    let lens =
        ProjectionBits::Perspective(1 << 30, (240, 240), ONE, 9 * ONE).library().expect("a projection");
    for (steps, is_finite) in [(33, true), (32, true), (31, false), (1, false), (0, false)] {
        for sign in [1.0, -1.0] {
            // The axis n has a component of so many 2⁻³⁰ along y.
            let c = sign * f64::from(steps) * (-30f64).exp2();
            let view = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, -c, 0.0], [0.0, c, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
            let view = ViewTransform::from_matrix(&view).expect("a rotation");
            let [x, y, z] = drawing(&view, &lens).vanishing_points();
            assert_eq!((x.is_some(), y.is_some(), z.is_some()), (false, is_finite, true), "{steps} {sign}");
        }
    }
}
