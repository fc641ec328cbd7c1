//! Every number of docs/spec.md, sections 2 and 3, and of the frustum, the box and the look-at of sections 4 and 6,
//! through the fixed-point chain, to the rounding of its formats.

use embedded_graphics_core::geometry::{Point, Size};
use pinhole::space::{Model, View, World};
use pinhole::{Affine, Angle, Point3, Projection, Vector3, ViewTransform, Viewport};
use support::bridge::compare::{close3, HALF};
use support::bridge::pair::{bits, ints, rows, ProjectionBits, ViewBits, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, V3};

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
fn composition_reads_left_to_right() {
    let turn = Affine::<Model, World>::rotation_z(Angle::QUARTER_TURN);
    let shift = Affine::<World, World>::translation(Vector3::from_ints(1, 0, 0));
    let p = Point3::from_ints(1, 0, 0);
    assert_eq!(turn.then(&shift).apply(p), Point3::from_ints(1, 1, 0));
    let shift = Affine::<Model, Model>::translation(Vector3::from_ints(1, 0, 0));
    assert_eq!(shift.then(&turn).apply(p), Point3::from_ints(0, 2, 0));
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
fn an_orthographic_box_goes_to_the_cube() {
    let p = ProjectionBits::Orthographic(WINDOW, NEAR, FAR).library().expect("a box");
    close3(ndc(&p, [-1.5, -0.5, -0.75]), [-1.0, -1.0, -1.0], 1e-9, "left bottom near");
    close3(ndc(&p, [2.0, 1.25, -40.0]), [1.0, 1.0, 1.0], 1e-9, "right top far");
    close3(ndc(&p, [0.25, 0.375, -20.375]), [0.0; 3], 1e-9, "centre");
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
fn viewport_saturates_at_the_guard_band() {
    let v = Viewport::new(Point::new(8000, -8192), Size::new(192, 100)).expect("a viewport");
    let p = v.apply(Point3::from_ints(32767, 32767, 0));
    assert_eq!((p.x(), p.y()), (8192 * 256, -8192 * 256));
    let p = v.apply(Point3::from_ints(-32768, -32768, 0));
    assert_eq!((p.x(), p.y()), (-8192 * 256, 8192 * 256));
}
