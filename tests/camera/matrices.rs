//! docs/spec.md, section 4: any projective 4 × 4 matrix. 10⁵ random matrices, each a frustum, a box or a
//! slanted box after a rigid move of view space, times any positive factor: vertices within 1/256 px
//! of the matrix in f64. Affine and view matrices, their round trips, and the matrices that are refused.

use pinhole::space::{Model, World};
use pinhole::{camera::CameraError, math::MathError, prelude::*};
use support::bridge::pair::{bits, random_view, ModelBits};
use support::bridge::{self, point};
use support::oracle::chain::{self, length, Viewport, M4, V3};
use support::oracle::rng::Rng;

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 320.0;

struct Case {
    matrix: M4,
    /// A view point, and its distance or the scale of the scene.
    at: V3,
    scale: f64,
    away: f64,
}

fn case(rng: &mut Rng) -> Case {
    let distance = rng.log(0.25, 10_000.0);
    let (fx, fy) = (rng.log(8.0, 700.0), rng.log(8.0, 700.0));
    let (w, h) = (WIDTH / fx, HEIGHT / fy);
    let (x, y) = (w * rng.real(-1.0, 1.0), h * rng.real(-1.0, 1.0));
    let (l, r, b, t) = (x - w / 2.0, x + w / 2.0, y - h / 2.0, y + h / 2.0);
    let near = distance * rng.log(0.01, 0.9);
    let far = distance * rng.log(1.1, 100.0);
    let flat = rng.one_in(3);
    let (mut m, at) = if flat {
        let [l, r, b, t] = [l, r, b, t].map(|c| c * distance);
        let mut m = chain::orthographic(l, r, b, t, near, far);
        m[0][2] = m[0][0] * rng.real(-2.0, 2.0);
        m[1][2] = m[1][1] * rng.real(-2.0, 2.0);
        (m, distance)
    } else {
        let [l, r, b, t] = [l, r, b, t].map(|c| c * near);
        (chain::frustum(l, r, b, t, near, far), distance)
    };
    // A point in the picture.
    let wanted = [rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)];
    let w = if flat { 1.0 } else { at };
    let p = [
        (wanted[0] * w + m[0][2] * at - m[0][3]) / m[0][0],
        (wanted[1] * w + m[1][2] * at - m[1][3]) / m[1][1],
        -at,
    ];
    // The move, undone on the point.
    let turn = ModelBits::random_rotation(rng).exact();
    let shift = rng.direction().map(|c| c * distance * rng.log(0.01, 10.0));
    let back: V3 = core::array::from_fn(|i| (0..3).map(|k| turn.m[k][i] * (p[k] - shift[k])).sum());
    let rigid: M4 = core::array::from_fn(|i| match i {
        3 => [0.0, 0.0, 0.0, 1.0],
        _ => [turn.m[i][0], turn.m[i][1], turn.m[i][2], shift[i]],
    });
    m = chain::matmul4(&m, &rigid);
    let factor = match rng.below(3) {
        0 => 1.0,
        1 => rng.log(1e-6, 1e6),
        _ => rng.log(1e-30, 1e30),
    };
    let matrix = m.map(|row| row.map(|c| c * factor));
    Case { matrix, at: back, scale: distance, away: length(shift) }
}

#[test]
fn s4_vertices_through_any_matrix_are_within_1_256_px() {
    let mut rng = Rng::new(0xAA);
    let (mut setups, mut worst, mut steps_worst) = (0, 0f64, 0f64);
    while setups < 100_000 {
        let c = case(&mut rng);
        let bits_view = random_view(&mut rng);
        let view = bits_view.exact();
        let Some(world) = bits(view.back(c.at)) else { continue };
        let at = view.apply(chain::fx3(world));
        let clip = chain::mul4(&c.matrix, [at[0], at[1], at[2], 1.0]);
        let exact_viewport = Viewport::new(5, -7, 480, 320);
        let [x, y, z] = [0, 1, 2].map(|i| clip[i] / clip[3]);
        // The world's 2⁻¹⁶ may have moved it out.
        if clip[3] <= 0.0 || x.abs() > 1.0 || y.abs() > 1.0 || z < -0.9999 {
            continue;
        }
        let ratio = (length(at) + c.away) / c.scale;
        assert!(ratio < 300.0);
        setups += 1;
        let projection = Projection::from_matrix(&c.matrix).expect("a matrix");
        let viewport = bridge::viewport(5, -7, 480, 320);
        let camera = Camera::new(&bits_view.library().expect("a view"), &projection, &viewport);
        let pinhole::camera::Projected { point: p, depth } = match camera.project(point(world)) {
            Ok(found) => found,
            Err(error) => panic!("{error}: {bits_view:?} {:?} {world:?} {clip:?}", c.matrix),
        };
        let (ex, ey) = exact_viewport.apply([x, y, z]);
        let error = (f64::from(p.x()) / 256.0 - ex).abs().max((f64::from(p.y()) / 256.0 - ey).abs());
        worst = worst.max(error);
        assert!(
            error <= 1.0 / 256.0,
            "{error} px off, ratio {ratio}: {bits_view:?} {:?} {world:?} {clip:?}",
            c.matrix
        );
        let wanted = chain::depth(clip).clamp(0.0, 65534.0).round();
        let steps = (f64::from(depth) - wanted).abs();
        steps_worst = steps_worst.max(steps);
        assert!(steps <= 1.0, "depth {depth} for {wanted}: {bits_view:?} {:?} {world:?} {clip:?}", c.matrix);
    }
    println!(
        "matrices: {worst:.7} px, beyond the snap {:.2e} px, depth {steps_worst} steps",
        worst - 1.0 / 512.0
    );
}

/// Also of a matrix without constants, whose near plane passes through the eye, and of one with nothing else, which has all
/// points in one place.
#[test]
fn s4_a_factor_of_a_projection_matrix_changes_nothing() {
    let w = [0.0, 0.0, -1.0, 0.0];
    let lens = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.25, 2.0], w];
    let linear = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -0.25, 0.0], w];
    let constant = [2.0, -1.0, 1.0, 4.0].map(|c| [0.0, 0.0, 0.0, c]);
    for (matrix, z) in [(lens, -0.75), (linear, 0.25), (constant, 0.25)] {
        for exponent in -300..=300 {
            let scaled = matrix.map(|row| row.map(|c| c * f64::exp2(exponent.into())));
            let lens = Projection::from_matrix(&scaled).expect("a matrix");
            let ndc = lens.apply(Point3::from_ints(2, -1, -4)).expect("a point before the eye");
            let found = [ndc.x(), ndc.y(), ndc.z()].map(f64::from);
            assert_eq!(found, [0.5, -0.25, z], "2^{exponent} times {matrix:?}");
        }
    }
}

#[test]
fn s4_invalid_projection_matrices_are_refused() {
    let good = chain::frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0);
    assert!(Projection::from_matrix(&good).is_ok());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e15] {
        for (i, row) in ['x', 'y', 'z', 'w'].into_iter().enumerate() {
            for j in 0..4 {
                let mut m = good;
                m[i][j] = bad;
                assert_eq!(
                    Projection::from_matrix(&m),
                    Err(CameraError::Matrix { row }),
                    "{bad} at {i}, {j}"
                );
                // What counts is the number in comparison with the other rows.
                let all = [(); 4].map(|()| [0, 1, 2, 3].map(|k| if k == j { bad } else { 0.0 }));
                assert_eq!(Projection::from_matrix(&all).is_ok(), bad.is_finite());
            }
        }
    }
    // The limit is 2³² times the largest of the other rows, which is 11/9 or 20/9.
    for (row, largest) in [(0, 20.0 / 9.0), (1, 20.0 / 9.0), (2, 1.0), (3, 20.0 / 9.0)] {
        for (factor, is_ok) in [(0.999, true), (1.001, false)] {
            let mut m = good;
            m[row][1] = -factor * largest * f64::exp2(32.0);
            assert_eq!(Projection::from_matrix(&m).is_ok(), is_ok, "{row}");
        }
    }
    for only in [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0], [0.0; 4]] {
        let mut m = good;
        m[3] = [0.0; 4];
        assert_eq!(Projection::from_matrix(&m), Err(CameraError::Matrix { row: 'w' }));
        let alone = [[0.0; 4], [0.0; 4], [0.0; 4], only];
        assert_eq!(Projection::from_matrix(&alone), Err(CameraError::Matrix { row: 'w' }));
    }
}

/// A rotation, exact to f64.
fn turn(rng: &mut Rng) -> [V3; 3] {
    let m = ModelBits::random_rotation(rng).exact().m;
    let u = chain::normalise(m[0]);
    let w = chain::normalise(chain::cross(u, m[1]));
    [u, chain::cross(w, u), w]
}

#[test]
fn invalid_affine_matrices_are_refused() {
    let identity = Affine::<Model, World>::identity().to_matrix();
    let read = |m: &M4| Affine::<Model, World>::from_matrix(m);
    assert_eq!(read(&identity).map(|a| a.to_matrix()), Ok(identity));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..3 {
            for j in 0..4 {
                let mut m = identity;
                m[i][j] = bad;
                assert_eq!(read(&m), Err(MathError::NotFinite), "{m:?}");
            }
        }
    }
    for j in 0..4 {
        let mut m = identity;
        m[3][j] += 0.5;
        assert_eq!(read(&m), Err(MathError::NotAffine));
    }
    let mut m = identity;
    m[1][3] = (30f64).exp2() + 1.0;
    assert_eq!(read(&m), Err(MathError::OutOfRange));
    m[1][3] = -(30f64).exp2();
    assert!(read(&m).is_ok());
}

#[test]
fn a_view_matrix_round_trips_within_its_rounding() {
    let mut rng = Rng::new(0x7E);
    let (mut axes_worst, mut eye_worst) = (0f64, 0f64);
    for _ in 0..100_000 {
        let exact = turn(&mut rng);
        // As a file may have it: rounded to six digits and more.
        let digits = 10f64.powi(rng.int(6, 15) as i32);
        let axes = exact.map(|row| row.map(|c| (c * digits).round() / digits));
        let reach = rng.log(1e-3, 32_000.0);
        let eye = [0; 3].map(|_| rng.real(-reach, reach));
        let mut m = [[0.0; 4]; 4];
        m[3][3] = 1.0;
        for (row, axis) in m.iter_mut().zip(axes) {
            *row = [axis[0], axis[1], axis[2], -chain::dot(axis, eye)];
        }
        let viewing = ViewTransform::from_matrix(&m).expect("a rigid matrix");
        let found = viewing.to_matrix();
        for (found, axis) in found.iter().zip(axes) {
            for (found, c) in found.iter().zip(axis) {
                axes_worst = axes_worst.max((found - c).abs());
            }
        }
        // The eye, by the axes as stored: −Rᵀ·t, and R·Rᵀ is within 8·10⁻⁶ of one.
        let stored = |i: usize| [found[0][i], found[1][i], found[2][i]];
        let translation =
            [0, 1, 2].map(|i| found[i][3] + chain::dot([found[i][0], found[i][1], found[i][2]], eye));
        for i in 0..3 {
            // The translation is rounded to 53 bits already, and so is what is made of it.
            eye_worst = eye_worst.max(chain::dot(stored(i), translation).abs() - 4e-15 * reach);
        }
        assert_eq!(ViewTransform::from_matrix(&viewing.to_matrix()), Ok(viewing));
    }
    let (bound, eye_bound) = ((-31f64).exp2(), (-33f64).exp2());
    assert!(axes_worst <= bound && 2.0 * axes_worst >= bound, "2^{}", axes_worst.log2());
    assert!(eye_worst <= eye_bound && 2.0 * eye_worst >= eye_bound, "2^{}", eye_worst.log2());
}

#[test]
fn invalid_view_matrices_are_refused() {
    let mut rng = Rng::new(0x7F);
    for _ in 0..1000 {
        let [u, v, n] = turn(&mut rng);
        let matrix = |u: V3, v: V3, n: V3, shift: f64| {
            [
                [u[0], u[1], u[2], 1.0],
                [v[0], v[1], v[2], shift],
                [n[0], n[1], n[2], 3.0],
                [0.0, 0.0, 0.0, 1.0],
            ]
        };
        let read = |m: M4| ViewTransform::from_matrix(&m).err();
        assert_eq!(read(matrix(u, v, n, 0.0)), None);
        assert_eq!(read(matrix(v, u, n, 0.0)), Some(CameraError::NotRigid), "left-handed");
        assert_eq!(read(matrix(u, v, n, 60_000.0)), Some(CameraError::OutOfRange));
        // Both sides of the bound: the square of the length, and the product of two axes.
        for (off, refused) in [(1.9e-6, None), (2.1e-6, Some(CameraError::NotRigid))] {
            for (axis, other) in [(0, 1), (1, 2), (2, 0)] {
                let (mut long, mut leaning) = ([u, v, n], [u, v, n]);
                long[axis] = long[axis].map(|c| c * (1.0 + off));
                leaning[axis] = core::array::from_fn(|i| leaning[axis][i] + 2.0 * off * leaning[other][i]);
                for [u, v, n] in [long, leaning] {
                    assert_eq!(read(matrix(u, v, n, 0.0)), refused);
                }
            }
        }
        let (mut m, row) = (matrix(u, v, n, 0.0), rng.below(4));
        m[row][rng.below(4)] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][rng.below(3)];
        assert_eq!(read(m), Some(CameraError::NotFinite { row: ['x', 'y', 'z', 'w'][row] }));
        m = matrix(u, v, n, 0.0);
        m[3][rng.below(4)] += 1.0;
        assert_eq!(read(m), Some(CameraError::NotRigid));
    }
}

#[test]
fn a_projection_matrix_round_trips_within_its_rounding() {
    let mut rng = Rng::new(0xBA);
    let mut worst = 0f64;
    for _ in 0..20_000 {
        let m = case(&mut rng).matrix;
        let projection = Projection::from_matrix(&m).expect("a matrix");
        let back = projection.to_matrix();
        // Up to a power of two, by the last row.
        let largest = |row: &[f64]| row.iter().fold(0f64, |a, c| a.max(c.abs()));
        let factor = (largest(&m[3]) / largest(&back[3])).log2().round().exp2();
        for (i, (row, back)) in m.iter().zip(back).enumerate() {
            // z comes from twice (z + w)/2 and w.
            let size = largest(&row[..3]) + if i == 2 { 2.0 * largest(&m[3][..3]) } else { 0.0 };
            for j in 0..3 {
                let error = (back[j] * factor - row[j]).abs();
                assert!(error == 0.0 || error <= size * (-30f64).exp2(), "{row:?} {back:?}");
                worst = worst.max(if size > 0.0 { error / size } else { 0.0 });
            }
        }
        let again = Projection::from_matrix(&back).expect("a matrix");
        assert_eq!(Projection::from_matrix(&again.to_matrix()), Ok(again));
    }
    assert!(worst * 2.0 >= (-30f64).exp2(), "2^{}", worst.log2());
}
