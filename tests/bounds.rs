//! Every stated bound of a numeric function holds, and is at most twice the largest error measured.
//!
//! `src/math` is compiled into this test, because its functions are private.

use support::bridge;
use support::oracle;

#[path = "bounds/functions.rs"]
mod functions;
#[allow(dead_code, unreachable_pub, unused_imports, clippy::wrong_self_convention)]
#[path = "../src/math/mod.rs"]
mod math;
#[allow(dead_code, unreachable_pub)]
#[path = "../src/space.rs"]
mod space;

use functions::Measured;
use oracle::chain;
use oracle::rng::Rng;
use pinhole::space::{Model, World};
use pinhole::Scalar;
use pinhole::{Affine, Camera, Mesh, Point3, Projection, Vector3, ViewTransform, Viewport, Visibility};

#[track_caller]
fn hold<const N: usize>(all: [Measured; N]) {
    for m in all {
        println!("{}: {:e} of {:e} ({})", m.what, m.error, m.bound, m.unit);
        assert!(m.error <= m.bound, "{}: {:e} beyond {:e}", m.what, m.error, m.bound);
        assert!(m.bound <= 2.0 * m.error, "{}: {:e} is far below {:e}", m.what, m.error, m.bound);
    }
}

macro_rules! bounds {
    ($($test:ident: $measured:ident)*) => {$(
        #[test]
        fn $test() {
            hold(functions::$measured());
        }
    )*};
}

bounds! {
    e7_sine_and_cosine: sines
    e7_angles: angles
    e8_reciprocal: reciprocals
    square_root: roots
    e4_unit_vectors: unit_vectors
    s2_rotations: rotations
    s2_compositions_and_inverses: compositions
    s2_normals: normals
    s3_views: views
    s4_projections: projections
    s4_planes_and_vanishing_points: planes
    s4_reference_volumes: volumes
    s6_viewports: viewports
}

/// 1/√2, 1/√3 and 1/√6, to 2⁻³².
#[test]
fn s4_isometric_rows() {
    let (half, third, sixth) = (0.5f64.sqrt(), (1.0f64 / 3.0).sqrt(), (1.0f64 / 6.0).sqrt());
    let exact = [[half, 0.0, -half], [-sixth, 2.0 * sixth, -sixth], [third, third, third]];
    let rows = ViewTransform::isometric(Point3::from_ints(0, 0, 0)).rows();
    let mut worst = 0f64;
    for (row, exact) in rows.iter().zip(exact) {
        for (got, exact) in row.iter().zip(exact) {
            worst = worst.max((f64::from(*got) - exact * 1_073_741_824.0).abs());
        }
    }
    assert!((0.125..=0.25).contains(&worst), "{worst}");
}

/// Rounding moves a matrix that is barely rigid, to either side of the limit: what is taken is taken again.
#[test]
fn s3_a_view_rigid_to_the_limit_goes_back() {
    let mut rng = Rng::new(0x5F);
    let mut taken = 0;
    for i in 0..50_000 {
        let exact = bridge::pair::random_view(&mut rng).exact();
        // A row's square is 4·10⁻⁶ off, but for some 10⁻¹⁰.
        let long = (1.0 + 4e-6 - (f64::from(i) - 25_000.0) * 1e-13).sqrt();
        let mut matrix = [[0.0; 4]; 4];
        for (row, axis) in matrix.iter_mut().zip(exact.rows) {
            row[..3].copy_from_slice(&axis);
        }
        matrix[i as usize % 3].iter_mut().for_each(|c| *c *= long);
        matrix[3][3] = 1.0;
        if let Ok(view) = ViewTransform::from_matrix(&matrix) {
            assert_eq!(ViewTransform::from_matrix(&view.to_matrix()), Ok(view), "{matrix:?}");
            taken += 1;
        }
    }
    assert!((10_000..40_000).contains(&taken), "{taken}");
}

/// All vertices lie inside, and the radius is at most √3 times half the longest side of their box, which no
/// sphere round them falls short of; rounded up by at most 9·2⁻¹⁶ and 2⁻²⁸ of itself.
#[test]
fn s5_bounding_spheres() {
    let mut rng = Rng::new(0x60);
    let (mut widest, mut steps) = (0f64, 0f64);
    for k in 0..20_000 {
        let (sphere, places) = if k % 2 == 0 {
            let exponent = rng.int(-15, 0) as i8;
            let reach = rng.int(1, 32_767);
            let mut any = || [0; 3].map(|_| rng.int(-reach, reach) as i16);
            let vertices: [[i16; 3]; 6] = core::array::from_fn(|_| any());
            let mesh = Mesh::new(&vertices, exponent, &[]).expect("a mesh");
            (mesh.bounding_sphere(), vertices.map(|v| chain::vertex(v, exponent)))
        } else {
            // Two corners of a cube, and what lies between: no sphere is smaller than √3 times half a side.
            let side = rng.log(1.0, 1e9) as i64;
            let low = rng.int(-1_000_000_000, 1_000_000_000);
            let between = [0; 3].map(|_| (low + rng.int(0, side)) as i32);
            let vertices = [low as i32, (low + side) as i32].map(|c| [c; 3]);
            let vertices = [vertices[0], vertices[1], between, between, between, between];
            let fixed = vertices.map(|v| v.map(Scalar::from_bits));
            let mesh = Mesh::from_fixed(&fixed, &[]).expect("a mesh");
            (mesh.bounding_sphere(), vertices.map(|v| v.map(chain::fx)))
        };
        let (centre, radius) = (bridge::reals(sphere.centre), chain::fx(sphere.radius.to_bits()));
        let mut longest = 0f64;
        for i in 0..3 {
            let side = places.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p[i]), b.max(p[i])));
            longest = longest.max((side.1 - side.0) / 2.0);
        }
        if sphere.radius == Scalar::MAX {
            assert!(3f64.sqrt() * longest > 32_767.0, "{places:?}");
            continue; // stands for any radius: see the next test
        }
        for p in places {
            let away = chain::length(core::array::from_fn(|i| p[i] - centre[i]));
            assert!(away <= radius, "{away} of {radius}: {places:?}");
        }
        let least = 3f64.sqrt() * longest + radius * 2f64.powi(-28);
        steps = steps.max((radius - least) * 65_536.0);
        assert!(steps <= 9.0, "{steps}: {radius} of {least}: {places:?}");
        widest = widest.max(radius / least);
    }
    assert!(widest >= 0.5, "{widest}");
    assert!(steps >= 4.5, "{steps} of 9");
}

/// A mesh whose sphere no `Scalar` describes is never called outside, nor inside.
#[test]
fn s5_a_sphere_beyond_the_scalars_is_partly_visible() {
    let reach = 30_000;
    let far_off = [[reach; 3], [-reach; 3]];
    let beside = [[reach; 3], [reach - 1; 3]];
    // By its radius, and by its centre.
    for (vertices, exponent, corner) in [(far_off, 0, 30_000i16), (beside, 1, 0)] {
        let mesh = Mesh::new(&vertices, exponent, &[]).expect("a mesh");
        // Before the first vertex: a thin box along −z that holds it.
        let model = if corner > 0 {
            Affine::<Model, World>::identity()
        } else {
            Affine::scale(Scalar::from_ratio(1, 4)) // 60 000 to 15 000
        };
        let at = if corner > 0 { corner } else { 15_000 };
        let window = bridge::pair::window([-10 << 16, 10 << 16, -10 << 16, 10 << 16]);
        let lens = Projection::orthographic(window, Scalar::from_int(1), Scalar::from_int(2000));
        let view = ViewTransform::look_along(
            Point3::from_ints(at, at, at + 1000),
            Vector3::from_ints(0, 0, -1),
            Vector3::from_ints(0, 1, 0),
        );
        let area = bridge::rectangle(0, 0, 100, 100);
        let viewport = Viewport::new(area.top_left, area.size).expect("a viewport");
        let camera = Camera::new(&view.expect("a view"), &lens.expect("a box"), &viewport);
        assert!(camera.place(&mesh, &model).project(0).is_ok(), "the first vertex is seen");
        assert_eq!(camera.visibility(&mesh.bounding_sphere(), &model), Visibility::Partly);
    }
}
