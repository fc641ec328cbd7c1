//! Numbers at the ends of their ranges, found by fuzzing: the result is right or an error, never silently wrong.

use pinhole::space::{Model, World};
use pinhole::{
    camera::{CameraError, Visibility},
    math::MathError,
    prelude::*,
};
use support::bridge::pair::{window, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{point, reals, scalar, vector, viewport};
use support::oracle::chain::mul4;
use support::oracle::rng::Rng;

/// far/(far − near) is 8·10⁵, and times the object's 2000 units from the eye that passes 2³⁰, where a row's
/// constant would saturate.
#[test]
fn a_vertex_beyond_near_is_there_however_thin_the_volume() {
    let camera = CameraBits::perspective(1 << 30, (40, 30), 100 * ONE, 100 * ONE + 8);
    let mesh = Mesh::new(&[[0, 0, 1850]], 0, &[]).expect("a mesh");
    let model = ModelBits(vec![Step::Move([0, 0, -2000 * ONE])]).library();
    assert!(camera.library().place(&mesh, &model).project(0).is_ok());
}

/// w(far) = far/d passes 2³⁰ for the one far plane and not for the other: all depths are scaled by it.
#[test]
fn depth_of_a_picture_on_a_plane_close_to_the_eye() {
    let far = ProjectionBits::EyeAtOrigin(-1, [-2, 2, -2, 2], ONE, 32_767 * ONE);
    assert_eq!(far.library().err(), Some(CameraError::OutOfRange));
    let family = ProjectionBits::EyeAtOrigin(-1, [-2, 2, -2, 2], ONE, 16_000 * ONE);
    let depth =
        CameraBits::ahead(family, (40, 40)).library().project(point([0, 0, -2 * ONE])).expect("seen").depth;
    let wanted = family.picture().depth([0.0, 0.0, -2.0]);
    assert!((f64::from(depth) - wanted).abs() <= 1.0, "{depth} instead of {wanted}");
}

/// A mesh with a sphere that no `Scalar` describes, by its radius or by its centre, is never called outside, nor inside.
#[test]
fn a_sphere_holds_all_vertices_of_the_widest_meshes() {
    let model = Affine::<Model, World>::scale(scalar(ONE / 64));
    let camera = CameraBits {
        view: ViewBits::LookAlong([8191 * ONE, 0, 10 * ONE], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), ONE, 100 * ONE),
        viewport: (0, 0, 40, 30),
    }
    .library();
    for x in [-32_767, 32_766] {
        let vertices = [[x, 0, 0], [32_767, 0, 0]];
        let mesh = Mesh::new(&vertices, 4, &[]).expect("a mesh");
        let p = camera.place(&mesh, &model).project(1).expect("a place").point;
        assert!((0..40 * 256).contains(&p.x()) && (0..30 * 256).contains(&p.y()), "seen");
        assert_eq!(camera.frustum().visibility(&mesh.bounding_sphere(), &model), Visibility::Partly);
    }
}

/// Two equal axes lie in a plane with any third. The rows' lengths differ by 2²⁶ here, so that a determinant of
/// rounded cofactors would pass for a volume.
#[test]
fn two_equal_axes_have_no_inverse() {
    let (a, b) = ([-1_073_741_823, -16, -8], [-33_554_432, 1, -14]);
    let frame = Affine::<Model, World>::from_frame(vector(a), vector(b), vector(a), point([0; 3]));
    assert_eq!(frame.inverse().map(|_| ()), Err(MathError::Singular));
}

/// A mesh far from its own origin, brought back by a translation of 2.4 million units, under a matrix that
/// from_matrix scales up: a row's constant passes 2³⁰ and comes back.
#[test]
fn a_mesh_moved_far_away_and_back_is_in_place() {
    let (turned, straight) = ([0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]);
    let last = [0.0, 0.0, 0.0, 1.0];
    let viewing =
        ViewTransform::from_matrix(&[[1.0, 0.0, 0.0, 0.0], turned, straight, last]).expect("a view");
    for factor in [1.0, 8.0, 10.0, 0.1, 1.01, 500.0] {
        let row = |axis: usize, c: f64| core::array::from_fn(|i| if i == axis { c } else { 0.0 });
        let scale = 8.0 * factor;
        let mut model = [row(0, scale), row(1, scale), row(2, scale), last];
        model[2][3] = 240.0 * 1024.0 * factor;
        let narrow = 1.0 / (1024.0 * factor);
        let matrix = [row(0, narrow), row(1, narrow), row(2, -0.5 * narrow), last];
        let projection = Projection::from_matrix(&matrix).expect("a projection");
        let camera = Camera::new(&viewing, &projection, &viewport(0, 0, 16, 16));
        // (±1, ±1, −240 ± 1) · 128
        let vertices = [[-1, -1, -241], [1, 1, -239], [0, 0, -240]];
        let vertices = vertices.map(|v: [i32; 3]| v.map(|c| scalar(c * 128 * ONE)));
        let mesh = Mesh::from_fixed(&vertices, &[]).expect("a mesh");
        let instance = camera.place(&mesh, &Affine::from_matrix(&model).expect("a model"));
        let found = [0, 1, 2].map(|i| instance.project(i).map(|seen| (seen.point.x(), seen.point.y())));
        assert_eq!(found, [Ok((0, 0)), Ok((4096, 4096)), Ok((2048, 2048))], "{factor}");
    }
}

/// A point of whole units, for which f64 has the products with 30-bit coefficients, or 2⁻¹⁶ beside one.
fn any_point(rng: &mut Rng) -> [i32; 3] {
    [0; 3].map(|_| rng.int(-32_767, 32_766) as i32 * ONE + rng.int(-1, 1) as i32)
}

/// Of windows of one step of 2⁻¹⁶ and more, at any distance from the axis.
fn any_sides(rng: &mut Rng) -> [i32; 4] {
    let mut side = || {
        let low = rng.int(-32_767, 32_000) as i32 * ONE;
        [low, low.saturating_add(1 << rng.below(27))]
    };
    let ([left, right], [bottom, top]) = (side(), side());
    [left, right, bottom, top]
}

/// Two products of 2³⁴ that differ by 16.
#[test]
fn cancellation_of_large_products_is_exact() {
    let row = |c: [f64; 2]| [c[0], c[1], 0.0, 0.0];
    let large = 2f64.powi(20);
    let matrix = [row([large, -large]), row([0.0, 1.0]), [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let shear = Affine::<Model, World>::from_matrix(&matrix).expect("a matrix");
    let image = shear.apply(point([16_384 * ONE + 1, 16_384 * ONE, 0]));
    assert_eq!(reals(image), [16.0, 16_384.0, 0.0]);
}

/// Windows of one step of 2⁻¹⁶ and more, at any distance from the axis.
#[test]
fn ndc_are_the_matrix_times_the_point_however_large_the_products() {
    let far_aside = [30_000, 30_001, -1, 1].map(|c| c * ONE);
    let frustum = Projection::frustum(window(far_aside), scalar(30_000 * ONE), scalar(32_000 * ONE));
    for (x, wanted) in [(30_000, -1.0), (30_001, 1.0)] {
        let seen = frustum.expect("a window").apply(point([x * ONE, 0, -30_000 * ONE]));
        let [x, ..] = reals(seen.expect("in front of the eye"));
        assert!((x - wanted).abs() < 1e-4, "{x} instead of {wanted}"); // 30 bits of 30 000
    }
    let narrow = Projection::orthographic(window([-1, 1, -1, 1]), scalar(0), scalar(ONE)).expect("a window");
    let ndc = narrow.apply(point([-ONE, ONE, -ONE])).expect("in front");
    assert_eq!((ndc.x(), ndc.y(), ndc.z().to_bits()), (Scalar::MIN, Scalar::MAX, ONE));
    let (mut rng, mut seen) = (Rng::new(11), 0);
    for _ in 0..100_000 {
        let sides = any_sides(&mut rng);
        let near = rng.int(1, 30_000) as i32 * ONE;
        let (window, near, far) = (window(sides), scalar(near), scalar(near + ONE));
        let lens = match rng.below(2) {
            0 => Projection::frustum(window, near, far),
            _ => Projection::orthographic(window, near, far),
        };
        let Ok(lens) = lens else { continue };
        let p = any_point(&mut rng);
        let (matrix, [x, y, z]) = (lens.to_matrix(), p.map(|c| f64::from(c) / 65_536.0));
        let wanted = mul4(&matrix, [x, y, z, 1.0]);
        let terms = matrix.iter().flat_map(|m| [m[0] * x, m[1] * y, m[2] * z, m[3]]);
        let term = terms.fold(0f64, |a, t| a.max(t.abs()));
        let largest = wanted.iter().fold(0f64, |a, c| a.max(c.abs()));
        // The stored points have 30 bits of a unit that the matrix does not show: 2⁻³⁰ of the largest coordinate at least.
        let off = largest * 2f64.powi(-29) + term * 2f64.powi(-50); // f64 rounds, too
        let [x, y, z, w] = wanted;
        let Some(ndc) = lens.apply(point(p)) else {
            assert!(w <= off, "{lens:?} {p:?}: w is {w}");
            continue;
        };
        if w > 4.0 * off {
            for (got, c) in reals(ndc).into_iter().zip([x, y, z]) {
                let exact = (c / w).clamp(-32_768.0, 32_768.0);
                let bound = 2f64.powi(-17) + 2.0 * off * (1.0 + exact.abs()) / w + 2f64.powi(-16);
                assert!((got - exact).abs() <= bound, "{lens:?} {p:?}: {got} for {exact}");
            }
        }
        seen += 1;
    }
    assert!(seen > 50_000);
}

/// A PRP far aside: its shear and the distance cancel each other.
#[test]
fn canonical_points_hold_however_large_the_products() {
    let hold = |prp: [i32; 3], sides: [i32; 4], front: i32, back: i32, p: [i32; 3]| {
        let real = |v: i32| f64::from(v) / 65_536.0;
        let (at, area) = (point(prp), window(sides));
        let lens = Projection::perspective_from_reference(at, area, scalar(front), scalar(back));
        let Ok(lens) = lens else { return false };
        let (matrix, depth) = (lens.to_matrix(), real(prp[2]) - real(back));
        let [x, y, _, w] = mul4(&matrix, [real(p[0]), real(p[1]), real(p[2]), 1.0]);
        // Canonical coordinates: x and y, and −w, over the distance of the back plane.
        let got = [x, y, -w].map(|c| c / (-matrix[3][2] * depth));
        let n = real(p[2]) - real(prp[2]);
        let mut wanted = [0.0, 0.0, n / depth];
        let mut term = 1f64;
        for i in 0..2 {
            let (low, high, at) = (real(sides[2 * i]), real(sides[2 * i + 1]), real(prp[i]));
            let centre = (low + high) / 2.0;
            let stretch = 2.0 * real(prp[2]) / ((high - low) * depth);
            let slope = (centre - at) / real(prp[2]);
            wanted[i] = (real(p[i]) - at + n * slope) * stretch;
            let coordinate = p.map(real).into_iter().fold(0f64, |a, c| a.max(c.abs()));
            // The larger coefficient, of p or of n along the shear, and the constant: the centre.
            term = term.max((stretch * coordinate * slope.abs().max(1.0)).max((stretch * centre).abs()));
        }
        for (got, wanted) in got.into_iter().zip(wanted) {
            let bound = term * 2f64.powi(-27) + 2f64.powi(-31);
            assert!((got - wanted).abs() <= bound, "{prp:?} {sides:?} {back}, {p:?}: {got} for {wanted}");
        }
        true
    };
    let aside = [32_000 * ONE, 0, 32_000 * ONE];
    let half = ONE / 2;
    let p = [-32_000 * ONE - half, 0, -32_000 * ONE];
    assert!(hold(aside, [-half, half, -half, half], 1000 * ONE, -32_768 * ONE, p));
    let (mut rng, mut seen) = (Rng::new(12), 0);
    for _ in 0..100_000 {
        let sides = any_sides(&mut rng);
        let mut prp = any_point(&mut rng);
        prp[2] = prp[2].saturating_abs();
        let back = -(rng.int(1, 32_767) as i32) * ONE;
        seen += usize::from(hold(prp, sides, 0, back, any_point(&mut rng)));
    }
    assert!(seen > 20_000, "{seen}");
}
