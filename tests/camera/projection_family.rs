//! docs/spec.md, section 4, projections by name: the defining property of each.

use pinhole::space::World;
use pinhole::{Camera, Point3, Projection, Scalar, Side, ViewTransform, ViewTransformError, Viewport};
use support::bridge::pair::{random_view, window, CameraBits, ProjectionBits, ViewBits, ONE};
use support::bridge::{point, rectangle, scalar, vector};
use support::definition::Family;
use support::oracle::chain::{self, fx, V3};
use support::oracle::rng::Rng;

/// 100 px a unit about (2000, 2000), in a viewport of 4000 × 4000.
fn drawing(view: &ViewTransform, projection: &Projection) -> Camera {
    let area = rectangle(0, 0, 4000, 4000);
    Camera::new(view, projection, &Viewport::new(area.top_left, area.size).expect("a viewport"))
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

fn close(got: f64, want: f64, room: f64, what: &str) {
    assert!((got - want).abs() <= room, "{what}: {got} instead of {want}");
}

#[test]
fn s4_multiview_keeps_faces_parallel_to_the_plane_at_their_exact_size() {
    // Which world axes point right and up, and which to the viewer.
    let sides: [(Side, V3, V3, V3); 6] = [
        (Side::Front, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        (Side::Back, [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]),
        (Side::Right, [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        (Side::Left, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]),
        (Side::Top, [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        (Side::Bottom, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
    ];
    let mut rng = Rng::new(0x51);
    for (side, right, up, near) in sides {
        assert_eq!(chain::cross(right, up), near, "right-handed");
        for _ in 0..300 {
            let vrp = [0; 3].map(|_| rng.int(-100, 100) as i32 * ONE);
            let camera = drawing(&ViewTransform::multiview(point(vrp), side), &orthographic());
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

#[test]
fn s4_isometric_foreshortens_all_three_by_root_two_thirds() {
    let view = ViewTransform::isometric(point([0; 3]));
    for (axis, f) in foreshortening(&view).into_iter().enumerate() {
        close(f, (2f64 / 3.0).sqrt(), PX / 10.0, &format!("axis {axis}"));
    }
    // The view equals the view by its VPN, to the last bits of its rows.
    let by_vpn =
        ViewTransform::from_reference(point([0; 3]), vector([ONE; 3]), vector([0, ONE, 0])).expect("a view");
    for (a, b) in view.rows().iter().flatten().zip(by_vpn.rows().iter().flatten()) {
        assert!((a - b).abs() <= 2, "{view:?} {by_vpn:?}");
    }
    // y is upright; x and z run 30° below the horizontal, one to each side.
    let camera = drawing(&view, &orthographic());
    let (o, x, y, z) = (
        at(&camera, [0; 3]),
        at(&camera, [10 * ONE, 0, 0]),
        at(&camera, [0, 10 * ONE, 0]),
        at(&camera, [0, 0, 10 * ONE]),
    );
    close(y.0 - o.0, 0.0, PX, "upright");
    assert!(y.1 > o.1 && x.0 > 0.0 && z.0 < 0.0);
    close(x.1 / x.0, -(30f64.to_radians().tan()), 1e-4, "x");
    close(z.1 / z.0, 30f64.to_radians().tan(), 1e-4, "z");
}

#[test]
fn s4_dimetric_foreshortens_two_alike() {
    let mut rng = Rng::new(0x52);
    for _ in 0..1000 {
        let (side, up) = (rng.int(1, 400_000) as i32, rng.int(-400_000, 400_000) as i32);
        let view = match ViewTransform::dimetric(point([0; 3]), scalar(side), scalar(up)) {
            Ok(view) => view,
            Err(error) => {
                assert!(up == 0 || up.abs() == side || side < up.abs() / 2000, "{error}");
                continue;
            }
        };
        let [x, y, z] = foreshortening(&view);
        let (s, u) = (f64::from(side).powi(2), f64::from(up).powi(2));
        close(x, ((s + u) / (2.0 * s + u)).sqrt(), PX / 5.0, "x");
        close(y, (2.0 * s / (2.0 * s + u)).sqrt(), PX / 5.0, "y");
        close(z, x, PX / 5.0, "z as x");
    }
    for (side, up) in [(0, ONE), (ONE, 0), (ONE, ONE), (ONE, -ONE), (-ONE, ONE)] {
        let got = ViewTransform::dimetric(point([0; 3]), scalar(side), scalar(up));
        assert_eq!(got, Err(ViewTransformError::NotAxonometric), "{side} {up}");
    }
}

#[test]
fn s4_trimetric_foreshortens_each_differently() {
    let mut rng = Rng::new(0x53);
    for _ in 0..1000 {
        let vpn = [0; 3].map(|_| rng.int(-400_000, 400_000) as i32);
        let Ok(view) = ViewTransform::trimetric(point([0; 3]), vector(vpn)) else { continue };
        let n = chain::normalise(chain::fx3(vpn));
        let f = foreshortening(&view);
        for i in 0..3 {
            close(f[i], (1.0 - n[i] * n[i]).sqrt(), PX / 5.0, "axis");
        }
        // The squares of the three sum to 2 in every axonometric view.
        close(f.iter().map(|f| f * f).sum(), 2.0, PX, "sum");
    }
    for vpn in [[ONE, 2 * ONE, 0], [ONE, ONE, 2 * ONE], [ONE, 2 * ONE, -ONE], [0, 0, 0]] {
        let got = ViewTransform::trimetric(point([0; 3]), vector(vpn));
        assert_eq!(got, Err(ViewTransformError::NotAxonometric), "{vpn:?}");
    }
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
        let Ok(library) = view.library() else { continue };
        let family = match rng.below(3) {
            0 => Family::FieldOfView(rng.int(1 << 26, 3 << 29) as u32, (300, 200), ONE, 100 * ONE),
            1 => Family::Frustum([-ONE, 2 * ONE, -2 * ONE, ONE], ONE, 100 * ONE),
            _ => {
                Family::Reference([ONE, ONE / 2, 5 * ONE], [-ONE, 2 * ONE, -2 * ONE, ONE], 4 * ONE, -90 * ONE)
            }
        };
        let area = rectangle(10, 20, 300, 200);
        let viewport = Viewport::new(area.top_left, area.size).expect("a viewport");
        let camera = Camera::new(&library, &family.library().expect("a projection"), &viewport);
        let points = camera.vanishing_points();
        let count = vpn.iter().filter(|&&c| c != 0).count();
        // Within 2⁻²⁵ of the view plane a point may be missing.
        let length = chain::length(chain::fx3(vpn));
        let close_to_plane = vpn.iter().any(|&c| c != 0 && fx(c).abs() / length < 2f64.powi(-20));
        assert!(close_to_plane || points.iter().flatten().count() == count, "{vpn:?} {points:?}");
        seen[count] += 1;
        let (exact, picture, exact_viewport) =
            (view.exact(), family.picture(), chain::Viewport::new(10, 20, 300, 200));
        for (axis, found) in points.iter().enumerate() {
            assert_eq!(found.is_some(), vpn[axis] != 0 || close_to_plane && found.is_some());
            let Some(found) = found else { continue };
            // The limit of points ever farther out on the axis, in f64.
            let sign = -f64::from(vpn[axis].signum());
            let limit = |t: f64| {
                let direction: V3 = core::array::from_fn(|i| exact.rows[i][axis] * sign * t);
                picture.screen(&exact_viewport, direction)
            };
            let ((x, y), (x_before, y_before)) = (limit(1e13), limit(1e12));
            let gap = (x - x_before).abs().max((y - y_before).abs());
            // The direction's slope against the view plane is known to 2⁻³⁰.
            let slope = exact.rows[2][axis].abs();
            let far = 1.0 + x.abs().max(y.abs());
            let room = 1.0 / 256.0
                + gap
                + far * (300.0 * 2f64.powi(-29) + far * 2f64.powi(-29)) / 100.0
                + far * 2f64.powi(-28) / slope;
            if far < 1e6 {
                let got = (f64::from(found.x) / 256.0, f64::from(found.y) / 256.0);
                assert!(
                    (got.0 - x).abs() <= room && (got.1 - y).abs() <= room,
                    "{got:?} for {x} {y} ± {room}: {vpn:?} {family:?}"
                );
                let ndc = [found.ndc.x(), found.ndc.y()].map(|c| fx(c.to_bits()));
                let (nx, ny) = exact_viewport.apply([ndc[0], ndc[1], 0.0]);
                if ndc.iter().all(|c| c.abs() < 32_000.0) {
                    assert!((nx - got.0).abs() < 0.006 && (ny - got.1).abs() < 0.006, "{ndc:?} {got:?}");
                }
            } else {
                assert!(
                    f64::from(found.x).abs().max(f64::from(found.y).abs()) > 1e8,
                    "{found:?} for {x} {y}"
                );
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
            Family::Orthographic(w, -ONE, ONE),
            Family::Oblique(w, -ONE, ONE, rng.bits(), ONE),
            Family::ReferenceParallel([ONE, ONE, ONE], w, 0, -ONE),
            Family::PlanarParallel(w, -ONE, ONE),
            Family::General(0, None, [ONE, ONE, 2 * ONE], w, -ONE, ONE),
        ] {
            let camera = drawing(&view, &family.library().expect("a projection"));
            assert_eq!(camera.vanishing_points(), [None; 3], "{family:?}");
        }
    }
}

/// Worked set-ups: the one-point view's parallels to z meet at (½, ½) of the view plane, 30 px a
/// unit right and up of the window's corner … at 240 × 240, window −1 … 3: (90, 150) px.
#[test]
fn s4_worked_vanishing_points() {
    let area = rectangle(0, 0, 240, 240);
    let viewport = Viewport::new(area.top_left, area.size).expect("a viewport");
    let view =
        ViewTransform::from_reference(point::<World>([0; 3]), vector([0, 0, ONE]), vector([0, ONE, 0]));
    let family =
        Family::Reference([ONE / 2, ONE / 2, ONE], [-ONE, 3 * ONE, -ONE, 3 * ONE], ONE / 2, -4 * ONE);
    let camera = Camera::new(&view.expect("a view"), &family.library().expect("a projection"), &viewport);
    let [x, y, z] = camera.vanishing_points();
    assert_eq!((x, y), (None, None));
    let z = z.expect("one");
    assert_eq!((z.x, z.y), (90 * 256, 150 * 256));
    assert_eq!(z.ndc, Point3::new(scalar(-ONE / 4), scalar(-ONE / 4), scalar(0)));
    // Two-point: VPN (1, 0, 1), PRP (0, 0, 10): the 45° directions meet the plane 10 units to either side.
    let view = ViewTransform::from_reference(
        point([2 * ONE, ONE / 2, 0]),
        vector([ONE, 0, ONE]),
        vector([0, ONE, 0]),
    );
    let family =
        Family::Reference([0, 0, 10 * ONE], [-10 * ONE, 20 * ONE, -10 * ONE, 20 * ONE], ONE / 2, -4 * ONE);
    let camera = Camera::new(&view.expect("a view"), &family.library().expect("a projection"), &viewport);
    let [x, y, z] = camera.vanishing_points();
    // 8 px a unit from −10 left, 20 at the top. x leads away to the left, z to the right.
    let place = |v: Option<pinhole::VanishingPoint>| v.map(|v| (v.x, v.y));
    assert_eq!(y, None);
    for (got, want) in [(place(x), (0, 160 * 256)), (place(z), (160 * 256, 160 * 256))] {
        let got = got.expect("finite");
        assert!((got.0 - want.0).abs() <= 1 && (got.1 - want.1).abs() <= 1, "{got:?} {want:?}");
    }
}

/// Looking up or down by 1/5000 rad through the longest lens, verticals meet millions of pictures away: up
/// there, or down there, at the ends of the numbers.
#[test]
fn s4_vanishing_points_beyond_all_numbers_keep_their_side() {
    let family = Family::FieldOfView((1 << 20) + 1, (240, 240), ONE, 9 * ONE);
    for up in [1, -1] {
        let view = ViewTransform::look_along(point([0; 3]), vector([0, up, -5000]), vector([0, ONE, 0]));
        let camera = drawing(&view.expect("a view"), &family.library().expect("a projection"));
        let [_, y, _] = camera.vanishing_points();
        let y = y.expect("finite");
        let end = if up == 1 { Scalar::MAX } else { -Scalar::MAX };
        assert_eq!((y.ndc.x(), y.ndc.y(), y.x, y.y), (scalar(0), end, 2000 * 256, -up << 30));
    }
}

/// Verticals meet in a point if the view plane is inclined to them by 2⁻²⁵ or more, and stay parallel if by less.
#[test]
fn s4_vanishing_points_begin_at_their_documented_angle() {
    let lens = Family::FieldOfView(1 << 30, (240, 240), ONE, 9 * ONE).library().expect("a projection");
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

/// A camera from `CameraBits` equals the camera from `Family` of these numbers.
#[test]
fn the_two_bridges_agree() {
    let bits = CameraBits {
        view: ViewBits::LookAt([0, 0, 5 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([-ONE, ONE, -ONE, ONE], ONE, 9 * ONE),
        viewport: (0, 0, 4000, 4000),
    };
    let projection = Family::Orthographic([-ONE, ONE, -ONE, ONE], ONE, 9 * ONE).library().expect("a box");
    assert_eq!(bits.library(), drawing(&bits.view.library().expect("a view"), &projection));
}
