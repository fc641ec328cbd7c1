//! Every number of docs/spec.md, sections 2 and 3, and of the frustum, the box and the look-at of sections 4 and 6,
//! through the fixed-point chain, to the rounding of its formats.

use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, View, World};
use pinhole::{Affine, Angle, Point3, Projection, Vector3, ViewTransform, Viewport};
use support::bridge::compare::{close3, HALF};
use support::bridge::pair::{bits, ints, random_view, rows, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, V3};
use support::oracle::rng::Rng;

/// Compares the library's image of a point with the exact image.
fn check(model: &ModelBits, p: [i32; 3], bound: f64) {
    let ours = model.library().apply(point::<Model>(p));
    let exact = model.exact().apply(chain::fx3(p));
    close3(reals(ours), exact, bound, &format!("{model:?} {p:?}"));
}

// docs/spec.md, section 2

#[test]
fn translation_and_scale_are_exact() {
    let t = Affine::<Model, World>::translation(Vector3::from_ints(3, -4, 5));
    assert_eq!(t.apply(Point3::from_ints(1, 2, 3)), Point3::from_ints(4, -2, 8));
    let s = Affine::<Model, World>::scale(scalar(3 * ONE / 2));
    assert_eq!(s.apply(Point3::from_ints(2, -4, 6)), Point3::from_ints(3, -6, 9));
    let s = Affine::<Model, World>::scale_axes(scalar(2 * ONE), scalar(-ONE), scalar(ONE / 4));
    assert_eq!(s.apply(Point3::from_ints(3, 5, 8)), Point3::from_ints(6, -5, 2));
    let i = Affine::<Model, World>::identity();
    for p in [[1, -1, 0], [i32::MAX, i32::MIN, 12345]] {
        assert_eq!(reals(i.apply(point(p))), chain::fx3(p));
    }
}

#[test]
fn rotations_by_a_quarter_turn_are_the_matrices_exactly() {
    // Rx: y → z, z → −y. Ry: z → x, x → −z. Rz: x → y, y → −x.
    let quarter = Angle::QUARTER_TURN;
    let p = Point3::<Model>::from_ints(1, 2, 3);
    let to = |a: Affine<Model, World>| a.apply(p);
    assert_eq!(to(Affine::rotation_x(quarter)), Point3::from_ints(1, -3, 2));
    assert_eq!(to(Affine::rotation_y(quarter)), Point3::from_ints(3, 2, -1));
    assert_eq!(to(Affine::rotation_z(quarter)), Point3::from_ints(-2, 1, 3));
    let half = Angle::HALF_TURN;
    assert_eq!(to(Affine::rotation_x(half)), Point3::from_ints(1, -2, -3));
    assert_eq!(to(Affine::rotation_y(half)), Point3::from_ints(-1, 2, -3));
    assert_eq!(to(Affine::rotation_z(half)), Point3::from_ints(-1, -2, 3));
}

#[test]
fn rotations_are_the_matrices_at_every_angle() {
    let mut rng = Rng::new(0x52);
    for k in 0..3000u32 {
        let angle = if k < 720 { Angle::turns(k as i32, 720).bits() } else { rng.bits() };
        for step in [Step::X(angle), Step::Y(angle), Step::Z(angle)] {
            let model = ModelBits(vec![step]);
            for p in [ints(1, 0, 0), ints(0, 1, 0), ints(0, 0, 1), ints(-3, 2, 7)] {
                check(&model, p, HALF);
            }
            // The largest coordinates: each coefficient is within 2⁻²⁹·⁵ of its value.
            check(&model, ints(20000, -20000, 20000), HALF + 60000.0 * 2f64.powf(-29.5));
        }
    }
}

#[test]
fn composition_reads_left_to_right() {
    let turn = Affine::<Model, World>::rotation_z(Angle::QUARTER_TURN);
    let shift = Affine::<World, World>::translation(Vector3::from_ints(1, 0, 0));
    let p = Point3::from_ints(1, 0, 0);
    assert_eq!(turn.then(&shift).apply(p), Point3::from_ints(1, 1, 0));
    let shift = Affine::<Model, Model>::translation(Vector3::from_ints(1, 0, 0));
    assert_eq!(shift.then(&turn).apply(p), Point3::from_ints(0, 2, 0));
}

#[test]
fn composition_is_that_of_the_matrices_and_associative() {
    let mut rng = Rng::new(0xA55);
    for _ in 0..4000 {
        let mut model = ModelBits::random_rotation(&mut rng);
        model.0.push(Step::Move([0; 3].map(|_| rng.int(-9 << 16, 9 << 16) as i32)));
        model.0.extend(ModelBits::random_rotation(&mut rng).0);
        model.0.push(Step::Scale([0; 3].map(|_| rng.int(ONE as i64 / 4, 2 << 16) as i32)));
        rng.shuffle(&mut model.0);
        let p = [0; 3].map(|_| rng.int(-9 << 16, 9 << 16) as i32);
        check(&model, p, HALF);
        // (ab)c = a(bc)
        let n = model.0.len();
        if n >= 3 {
            let (a, b, c) = (
                ModelBits(model.0[..1].to_vec()).library(),
                ModelBits(model.0[1..2].to_vec()).library(),
                ModelBits(model.0[2..].to_vec()).library(),
            );
            let to_world = Affine::<World, Model>::identity();
            let left = a.then(&to_world).then(&b).then(&to_world).then(&c);
            let right = a.then(&to_world).then(&b.then(&to_world).then(&c));
            let (l, r) = (reals(left.apply(point(p))), reals(right.apply(point(p))));
            close3(l, r, 2.0 * HALF, "associative");
        }
    }
}

#[test]
fn rotation_about_any_axis_is_align_rotate_undo() {
    // docs/spec.md, section 2: align the axis with z, rotate, undo; against the axis–angle formula in f64.
    let mut rng = Rng::new(0xA8);
    for _ in 0..2000 {
        let (azimuth, polar, turn) = (rng.bits(), rng.bits() >> 1, rng.bits());
        let at = [0; 3].map(|_| rng.int(-5 << 16, 5 << 16) as i32);
        let back = at.map(|c| -c);
        let model = ModelBits(vec![
            Step::Move(back),
            Step::Z(azimuth.wrapping_neg()),
            Step::Y(polar.wrapping_neg()),
            Step::Z(turn),
            Step::Y(polar),
            Step::Z(azimuth),
            Step::Move(at),
        ]);
        let (sa, ca) = chain::sin_cos(azimuth);
        let (sp, cp) = chain::sin_cos(polar);
        let (s, c) = chain::sin_cos(turn);
        let axis = [sp * ca, sp * sa, cp];
        let p = [0; 3].map(|_| rng.int(-5 << 16, 5 << 16) as i32);
        let centre = chain::fx3(at);
        let d: V3 = core::array::from_fn(|i| chain::fx3(p)[i] - centre[i]);
        // Rodrigues: d·cos + (axis × d)·sin + axis·(axis·d)·(1 − cos)
        let k = chain::cross(axis, d);
        let along = chain::dot(axis, d) * (1.0 - c);
        let exact: V3 = core::array::from_fn(|i| centre[i] + d[i] * c + k[i] * s + axis[i] * along);
        let ours = reals(model.library().apply(point(p)));
        close3(ours, exact, HALF, "axis and angle");
    }
}

// docs/spec.md, section 3

fn example_a() -> ViewBits {
    ViewBits::Reference(ints(1, 2, 3), ints(2, -1, 2), ints(0, 1, 0))
}

#[test]
fn the_worked_example_of_the_specification_holds() {
    let v = example_a().library().expect("a view");
    let r2 = 2f64.sqrt();
    let [u, w, n] = rows(&v);
    let bound = 2f64.powi(-29);
    close3(n, [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0], bound, "n");
    close3(u, [1.0 / r2, 0.0, -1.0 / r2], bound, "u");
    close3(w, [1.0 / (3.0 * r2), 4.0 / (3.0 * r2), 1.0 / (3.0 * r2)], bound, "v");
    // The translation column: the image of the world's origin.
    let column = [r2, -2.0 * r2, -2.0];
    close3(reals(v.apply(Point3::from_ints(0, 0, 0))), column, HALF, "column");
    let t = v.translation().map(|c| c as f64 / 4_294_967_296.0);
    close3(t, column, 2f64.powi(-13), "translation()");
    close3(t, column, 1e-8, "translation() of a small eye");
    // VRP → 0, the point one step along VPN → |VPN| on n.
    assert_eq!(v.apply(Point3::from_ints(1, 2, 3)), Point3::from_ints(0, 0, 0));
    close3(reals(v.apply(Point3::from_ints(3, 1, 5))), [0.0, 0.0, 3.0], HALF, "world point (3,1,5)");
}

#[test]
fn view_rows_match_the_oracle() {
    let mut rng = Rng::new(0x3A);
    let mut worst = 0.0f64;
    for _ in 0..30_000 {
        let view = random_view(&mut rng);
        let (ours, exact) = (view.library().expect("a view"), view.exact());
        let r = rows(&ours);
        for i in 0..3 {
            // The roll error grows as 1/sin; random_view keeps the sine above 0.02.
            for j in 0..3 {
                worst = worst.max((r[i][j] - exact.rows[i][j]).abs());
                let square = chain::dot(r[i], r[j]) - f64::from(i == j);
                assert!(square.abs() <= 2f64.powi(-27), "{view:?}: not orthonormal");
            }
        }
        // Rigid and right-handed: u × v = n.
        close3(chain::cross(r[0], r[1]), r[2], 2f64.powi(-27), "handedness");
    }
    println!("rows within 2^{:.2}", worst.log2());
    assert!(worst <= 2f64.powi(-27));
}

#[test]
fn the_translation_column_is_within_its_stated_bound() {
    let mut rng = Rng::new(0x7C);
    let mut worst = 0.0f64;
    for _ in 0..30_000 {
        let view = random_view(&mut rng);
        let (ours, exact) = (view.library().expect("a view"), view.exact());
        let eye = exact.eye;
        for (ours, row) in ours.translation().iter().zip(exact.rows) {
            worst = worst.max((*ours as f64 / 4_294_967_296.0 + chain::dot(row, eye)).abs());
        }
    }
    println!("translation within 2^{:.2}", worst.log2());
    assert!(worst <= 2f64.powi(-13));
}

#[test]
fn look_at_looks_along_minus_z_with_y_up() {
    let (eye, target) = (ints(10, 4, -7), ints(3, 9, 20));
    let v = ViewBits::LookAt(eye, target, ints(0, 1, 0));
    let ours = v.library().expect("a view");
    let gaze = [-7.0, 5.0, 27.0];
    let seen = reals(ours.apply(point(target)));
    close3(seen, [0.0, 0.0, -chain::length(gaze)], HALF, "target");
    assert_eq!(ours.apply(point(eye)), Point3::from_ints(0, 0, 0));
    // The x axis is g × t, the z axis −g; up has no x and a positive y.
    let [x, _, z] = rows(&ours);
    close3(x, chain::normalise(chain::cross(gaze, [0.0, 1.0, 0.0])), 2f64.powi(-29), "x");
    close3(z, chain::normalise(gaze.map(|c| -c)), 2f64.powi(-29), "z");
    let above = reals(ours.apply(point(ints(10, 5, -7))));
    assert!(above[0].abs() <= HALF && above[1] > 0.5);
    // The other constructors give the same view.
    let along = ViewTransform::look_along(point(eye), vector(ints(-7, 5, 27)), vector(ints(0, 1, 0)));
    let reference =
        ViewTransform::from_reference(point(eye), vector(ints(7, -5, -27)), vector(ints(0, 1, 0)));
    assert_eq!(along, Ok(ours));
    assert_eq!(reference, Ok(ours));
}

// docs/spec.md, section 4

/// Window −1.5 … 2 × −0.5 … 1.25, near ¾, far 40: off axis in both.
const WINDOW: [i32; 4] = [-3 * ONE / 2, 2 * ONE, -ONE / 2, 5 * ONE / 4];
const NEAR: i32 = 3 * ONE / 4;
const FAR: i32 = 40 * ONE;

fn frustum() -> Projection {
    ProjectionBits::Frustum(WINDOW, NEAR, FAR).library().expect("a frustum")
}

fn view_point(p: V3) -> Point3<View> {
    point(bits(p).expect("in range"))
}

fn ndc(p: &Projection, at: V3) -> V3 {
    reals(p.apply(view_point(at)).ndc().expect("w > 0"))
}

#[test]
fn frustum_is_its_matrix() {
    let mut rng = Rng::new(0x4F);
    for _ in 0..20_000 {
        let near = rng.log(0.25, 100.0);
        let w = near * rng.log(0.05, 5.0);
        let h = near * rng.log(0.05, 5.0);
        let (x, y) = (w * rng.real(-2.0, 2.0), h * rng.real(-2.0, 2.0));
        let to = |v: f64| chain::to_fx(v).expect("in range");
        let window = [to(x - w), to(x + w), to(y - h), to(y + h)];
        let p = match rng.below(3) {
            0 => ProjectionBits::Perspective(
                rng.int(1 << 24, (1 << 31) - (1 << 24)) as u32,
                (rng.int(1, 4000) as u32, rng.int(1, 4000) as u32),
                to(near),
                to(near * rng.log(1.01, 200.0)),
            ),
            1 => ProjectionBits::Frustum(window, to(near), to(near * rng.log(1.01, 200.0))),
            _ => ProjectionBits::Orthographic(window, to(near), to(near * rng.log(1.01, 200.0))),
        };
        let ours = p.library().expect("a projection");
        let z = to(-near * rng.log(1.0, 100.0));
        let at = [to(near * rng.real(-9.0, 9.0)), to(near * rng.real(-9.0, 9.0)), z];
        let [ax, ay, az] = chain::fx3(at);
        let clip = chain::mul4(&p.exact(), [ax, ay, az, 1.0]);
        let exact = [clip[0] / clip[3], clip[1] / clip[3], clip[2] / clip[3]];
        if exact.iter().any(|c| c.abs() > 32000.0) {
            continue;
        }
        let ndc = reals(ours.apply(point(at)).ndc().expect("in front of the eye"));
        // Clip coordinates share 30 bits: 2⁻³⁰ of the largest, which w feels as much as x.
        let size = exact.iter().fold(1.0f64, |a, c| a.max(c.abs()));
        // … and to the terms that cancel inside a row.
        let terms = (0..3)
            .map(|i| (0..3).map(|j| (p.exact()[i][j] * chain::fx3(at)[j]).abs()).sum::<f64>())
            .fold(0.0f64, f64::max)
            / clip[3];
        // The cotangent is as good as the sine of half the angle, which has 30 bits.
        let sine = match p {
            ProjectionBits::Perspective(fov, ..) => chain::sin_cos(fov / 2).0,
            _ => 1.0,
        };
        let relative = (size + terms) * 2f64.powi(-29) + 2f64.powi(-30) / sine;
        close3(ndc, exact, HALF + size * relative, &format!("{p:?} {at:?}"));
    }
}

#[test]
fn frustum_keeps_x_and_y_of_the_near_plane() {
    let p = frustum();
    for (x, y) in [(-1.5, -0.5), (2.0, 1.25), (0.25, 0.375), (0.0, 0.0), (1.0, -0.25)] {
        let [nx, ny, nz] = ndc(&p, [x, y, -0.75]);
        // Back from NDC to the window.
        assert!((nx * 1.75 + 0.25 - x).abs() <= 2.0 * HALF, "{x} {y}");
        assert!((ny * 0.875 + 0.375 - y).abs() <= 2.0 * HALF, "{x} {y}");
        assert_eq!(nz, -1.0);
    }
}

#[test]
fn frustum_takes_near_to_minus_one_and_far_to_plus_one() {
    let p = frustum();
    for (x, y) in [(0.0, 0.0), (-20.0, 7.0), (15.0, -31.5)] {
        assert_eq!(ndc(&p, [x, y, -0.75])[2], -1.0);
        assert!((ndc(&p, [x, y, -40.0])[2] - 1.0).abs() <= 2.0 * HALF);
    }
    // The window's corners, seen from the eye through near to far, are the cube's corners.
    for (x, y, nx, ny) in [(-1.5, -0.5, -1.0, -1.0), (2.0, 1.25, 1.0, 1.0)] {
        let k = 40.0 / 0.75;
        close3(ndc(&p, [x, y, -0.75]), [nx, ny, -1.0], 2.0 * HALF, "near corner");
        // The far corner itself is rounded to 2⁻¹⁶.
        close3(ndc(&p, [x * k, y * k, -40.0]), [nx, ny, 1.0], 2.0 * HALF, "far corner");
    }
}

#[test]
fn frustum_keeps_the_order_along_z() {
    let p = frustum();
    let mut last = -2.0;
    for k in 0..400 {
        let z = 0.75 + 0.75 * f64::from(k) / 100.0;
        let [_, _, nz] = ndc(&p, [0.3, -0.2, -z]);
        assert!(nz > last, "at {z}");
        last = nz;
    }
}

#[test]
fn frustum_z_is_n_plus_f_minus_fn_over_z() {
    let p = frustum();
    let (n, f) = (-0.75, -40.0);
    for k in 0..300 {
        let z = chain::fx((-(0.75 + f64::from(k) * 0.13) * 65536.0) as i32);
        let squished = n + f - f * n / z;
        // The box puts near at +1, the frustum at −1: the opposite sign.
        let boxed = (squished - (n + f) / 2.0) * 2.0 / (n - f);
        let [_, _, nz] = ndc(&p, [1.0, 2.0, z]);
        assert!((nz + boxed).abs() <= 2.0 * HALF, "{z}: {nz} {boxed}");
    }
}

#[test]
fn frustum_makes_lines_through_the_eye_parallel_to_z() {
    let p = frustum();
    for (x, y) in [(1.0, 0.5), (-1.0, 0.25), (0.125, -0.625)] {
        let first = ndc(&p, [x, y, -1.0]);
        for k in [2.0, 3.0, 7.0, 16.0, 39.0] {
            let [nx, ny, _] = ndc(&p, [x * k, y * k, -k]);
            assert!((nx - first[0]).abs() <= 2.0 * HALF && (ny - first[1]).abs() <= 2.0 * HALF);
        }
    }
}

#[test]
fn frustum_is_orthographic_after_squish() {
    // Both through the library: the frustum at p, and the box at the squished p.
    let (p, boxed) = (frustum(), ProjectionBits::Orthographic(WINDOW, NEAR, FAR).library().expect("a box"));
    let mut rng = Rng::new(0x50);
    let squish = chain::squish(-0.75, -40.0);
    for _ in 0..3000 {
        let z = -rng.real(0.75, 40.0);
        let at = [z * rng.real(-3.0, 3.0), z * rng.real(-3.0, 3.0), z];
        let at = chain::fx3(bits(at).expect("in range"));
        let s = chain::mul4(&squish, [at[0], at[1], at[2], 1.0]);
        let squished = [s[0] / s[3], s[1] / s[3], s[2] / s[3]];
        // The squished point is rounded to 2⁻¹⁶ once more; the box enlarges by at most 2/1.75.
        close3(ndc(&p, at), ndc(&boxed, squished), 4.0 * HALF, "squish");
    }
}

#[test]
fn an_orthographic_box_goes_to_the_cube() {
    let p = ProjectionBits::Orthographic(WINDOW, NEAR, FAR).library().expect("a box");
    close3(ndc(&p, [-1.5, -0.5, -0.75]), [-1.0, -1.0, -1.0], 1e-9, "left bottom near");
    close3(ndc(&p, [2.0, 1.25, -40.0]), [1.0, 1.0, 1.0], 1e-9, "right top far");
    close3(ndc(&p, [0.25, 0.375, -20.375]), [0.0; 3], 1e-9, "centre");
}

#[test]
fn perspective_by_field_of_view_is_the_frustum() {
    // 90° and aspect 2 : 1 is the window −2n … 2n × −n … n.
    let by_angle =
        ProjectionBits::Perspective(1 << 30, (640, 320), ONE, 9 * ONE).library().expect("by angle");
    let by_window =
        ProjectionBits::Frustum([-2 * ONE, 2 * ONE, -ONE, ONE], ONE, 9 * ONE).library().expect("by window");
    let mut rng = Rng::new(0xF0);
    for _ in 0..2000 {
        let z = -rng.real(1.0, 9.0);
        let at = [z * rng.real(-3.0, 3.0), z * rng.real(-3.0, 3.0), z];
        close3(ndc(&by_angle, at), ndc(&by_window, at), 2.0 * HALF, "90°");
    }
}

#[test]
fn behind_the_eye_there_is_no_image() {
    for z in [0, 1, ONE, 1000 * ONE] {
        assert!(frustum().apply(point([ONE, ONE, z])).ndc().is_none());
    }
    assert!(frustum().apply(point([1, 1, -1])).ndc().is_some());
}

// docs/spec.md, section 6

#[test]
fn viewport_borders_are_the_corners_of_ndc() {
    for (x, y, w, h) in [(0, 0, 480, 320), (10, 20, 1, 1), (-50, -60, 33, 77), (-8192, -8192, 16384, 16384)] {
        let v = Viewport::new(Point::new(x, y), Size::new(w, h)).expect("a viewport");
        for (nx, ny) in [(-1, 1), (1, 1), (-1, -1), (1, -1), (0, 0)] {
            let p = v.apply(Point3::from_ints(nx, ny, 0));
            let (w, h) = (w as i32, h as i32);
            // Outer borders: x₀ and x₀ + W, not pixel centres; y is mirrored.
            assert_eq!(p.x(), 256 * x + 128 * w * (i32::from(nx) + 1));
            assert_eq!(p.y(), 256 * y + 128 * h * (1 - i32::from(ny)));
        }
    }
}

#[test]
fn viewport_is_its_formula() {
    let mut rng = Rng::new(0x60);
    for _ in 0..20_000 {
        let (x, y) = (rng.int(-500, 500) as i32, rng.int(-500, 500) as i32);
        let (w, h) = (rng.int(1, 2000) as u32, rng.int(1, 2000) as u32);
        let v = Viewport::new(Point::new(x, y), Size::new(w, h)).expect("a viewport");
        let at = [rng.int(-3 << 16, 3 << 16), rng.int(-3 << 16, 3 << 16), 0].map(|c| c as i32);
        let p = v.apply(point(at));
        let (ex, ey) = chain::Viewport::new(x, y, w, h).apply(chain::fx3(at));
        assert!((f64::from(p.x()) - 256.0 * ex).abs() <= 0.5, "{at:?}");
        assert!((f64::from(p.y()) - 256.0 * ey).abs() <= 0.5, "{at:?}");
    }
}

#[test]
fn viewport_saturates_at_the_guard_band() {
    let v = Viewport::new(Point::new(8000, -8192), Size::new(192, 100)).expect("a viewport");
    let p = v.apply(Point3::from_ints(32767, 32767, 0));
    assert_eq!((p.x(), p.y()), (8192 * 256, -8192 * 256));
    let p = v.apply(Point3::from_ints(-32768, -32768, 0));
    assert_eq!((p.x(), p.y()), (-8192 * 256, 8192 * 256));
}
