//! docs/spec.md, section 2: quaternions of micromath, frames and inverses, the normal transform. The errors of rotations,
//! quaternions, compositions and inverses are in `tests/bounds.rs`.

use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, AxisError, InverseError, NumberError, Quaternion, QuaternionError};
use support::bridge::pair::{bits, ModelBits, Step, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, cross, dot, fx, fx3, length, normalise, M3};
use support::oracle::rng::Rng;

fn by_quaternion([w, x, y, z]: [f64; 4]) -> M3 {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

fn unit(q: [f64; 4]) -> [f64; 4] {
    let n = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    q.map(|c| c / n)
}

/// Quaternions of I16F16 are in `tests/bounds.rs`.
#[test]
fn s2_quaternions_of_micromath_are_taken() {
    let mut rng = Rng::new(0x202);
    let mut worst = 0f64;
    for _ in 0..20_000 {
        let scale = rng.log(0.25, 30_000.0);
        let q = [(); 4].map(|()| (rng.real(-1.0, 1.0) * scale) as f32);
        // Parts keep their bits down to 2⁻³²: short ones have fewer.
        if q.iter().all(|c| c.abs() < 0.125) {
            continue;
        }
        let quaternion = micromath::Quaternion::new(q[0], q[1], q[2], q[3]);
        let ours =
            Affine::<Model, World>::from_quaternion(Quaternion::try_from(quaternion).expect("a rotation"));
        let exact = by_quaternion(unit(q.map(f64::from)));
        for (row, exact) in ours.to_matrix().iter().zip(exact) {
            worst = row.iter().zip(exact).map(|(c, exact)| (c - exact).abs()).fold(worst, f64::max);
        }
    }
    assert!(worst <= 2f64.powi(-27), "2^{}", worst.log2());
    let zero = scalar(0);
    assert_eq!(Quaternion::new(zero, zero, zero, zero), Err(QuaternionError::Zero));
    let from = |w: f32, x: f32| Quaternion::try_from(micromath::Quaternion::new(w, x, 0.0, 0.0));
    assert_eq!(from(0.0, 0.0), Err(QuaternionError::Zero));
    assert_eq!(from(f32::NAN, 0.0), Err(QuaternionError::Number(NumberError::NotFinite)));
    assert_eq!(from(1.0, f32::INFINITY), Err(QuaternionError::Number(NumberError::NotFinite)));
    assert_eq!(from(40_000.0, 0.0), Err(QuaternionError::Number(NumberError::OutOfRange)));
    let about_nothing = Affine::<Model, World>::rotation(point([0; 3]), vector([0; 3]), Angle::QUARTER_TURN);
    assert_eq!(about_nothing, Err(AxisError::ZeroAxis));
}

fn determinant(m: &M3) -> f64 {
    dot(m[0], cross(m[1], m[2]))
}

/// Transposed cofactors over the determinant.
fn inverse(m: &M3) -> M3 {
    let d = determinant(m);
    let c = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    core::array::from_fn(|i| core::array::from_fn(|j| c[j][i] / d))
}

/// Rotations, scales of 2⁻⁸ to 2⁸, and translations. The errors of the inverse's own coefficients are in `tests/bounds.rs`.
#[test]
fn s2_inverses_return_points_to_where_they_were() {
    const UNIT: f64 = 1.0 / 65536.0;
    let mut rng = Rng::new(0x203);
    let (mut compared, mut rigid) = (0, 0);
    while compared < 30_000 {
        let ModelBits(mut steps) = ModelBits::random_rotation(&mut rng);
        let is_rigid = rng.one_in(3);
        let scales = [0; 3].map(|_| if is_rigid { ONE } else { rng.log(256.0, 16_777_216.0) as i32 });
        steps.push(Step::Scale(scales));
        steps.extend(ModelBits::random_rotation(&mut rng).0);
        let mut shift = |reach: i64| [0; 3].map(|_| rng.int(-reach << 16, reach << 16) as i32);
        let (move_by, p) = (shift(2000), shift(2000));
        steps.push(Step::Move(move_by));
        let (large, small) = scales.map(fx).iter().fold((0f64, f64::MAX), |(a, b), s| (a.max(*s), b.min(*s)));
        let reach = |p: [i32; 3]| p.map(|c| fx(c).abs()).iter().sum::<f64>();
        let size = large * reach(p) + reach(move_by);
        // No coordinate saturates on the way. Stretches that differ more lie beyond the bound on flatness.
        if size > 30_000.0 || large / small > 4000.0 {
            continue;
        }
        let there = ModelBits(steps).library();
        let image = there.apply(point(p));
        let again = reals(there.inverse().expect("not singular").apply(image));
        // The image is rounded by half a unit; 2⁻²⁸ times the ratio of stretches is the inverse's bound.
        let half = 0.5 * UNIT * 3f64.sqrt();
        let bound = 0.5 * UNIT + (half + 2.0 * 2f64.powi(-28) * large / small * size) / small;
        assert!((0..3).all(|i| (again[i] - fx(p[i])).abs() <= bound), "{again:?} {p:?} {bound}");
        if is_rigid {
            let again = reals(there.rigid_inverse().expect("rigid").apply(image));
            // R·Rᵀ is the identity to 2⁻²⁷.
            let bound = 0.5 * UNIT + half + 2f64.powi(-26) * size;
            assert!((0..3).all(|i| (again[i] - fx(p[i])).abs() <= bound), "{again:?} {p:?} {bound}");
            rigid += 1;
        }
        compared += 1;
    }
    assert!(rigid > 5000, "{rigid}");
}

#[test]
fn s2_singular_frames_are_refused_exactly_at_the_bound() {
    let x = vector::<World>([ONE, 0, 0]);
    let y = vector([0, ONE, 0]);
    let frame = |c: [i32; 3]| {
        Affine::<Model, World>::from_frame(x, y, vector(c), point([0; 3])).inverse().map(|_| ())
    };
    // c in the plane of a and b.
    assert_eq!(frame([ONE, ONE, 0]), Err(InverseError::Singular));
    assert_eq!(frame([0; 3]), Err(InverseError::Singular));
    // The determinant over the product of the rows' lengths: rows (1, 0, k), (0, 1, 0), (0, 0, h) give
    // h/(√(1 + k²)·h): never flat. Rows (1, 0, 0), (0, 1, 1), (0, 1, 1 + h) give h/2.
    let leaning = |h: i32| {
        // Columns of those rows, times 2³⁰.
        const P: i32 = 1 << 30;
        let (a, b, c) = ([P, 0, 0], [0, P, P], [0, P, P + h]);
        Affine::<Model, World>::from_frame(vector(a), vector(b), vector(c), point([0; 3]))
            .inverse()
            .map(|_| ())
    };
    // h/2 over 2³⁰ against 2⁻²⁴: 128 is the bound.
    for (h, wanted) in [(0, false), (1, false), (120, false), (136, true), (1000, true), (1 << 20, true)] {
        assert_eq!(leaning(h), if wanted { Ok(()) } else { Err(InverseError::Singular) }, "{h}");
    }
    // Scales are no flatness: each axis on its own.
    let scales = Affine::<Model, World>::scale_axes(scalar(ONE), scalar(ONE), scalar(16));
    assert!(scales.inverse().is_ok());
    // Powers of two have exact inverses, also where the determinant takes fewer bits than a quotient.
    for narrow in [1 << 12, 1 << 8, 4, 2, 1] {
        let scales = Affine::<Model, World>::scale_axes(scalar(ONE), scalar(narrow), scalar(narrow));
        let there = [3 * ONE, 5 * narrow, -7 * narrow];
        let back = scales.inverse().expect("not singular").apply(point(there));
        assert_eq!(reals(back), [3.0, 5.0, -7.0], "{narrow}");
    }
    let flat = Affine::<Model, World>::scale_axes(scalar(ONE), scalar(ONE), scalar(0));
    assert_eq!(flat.inverse().map(|_| ()), Err(InverseError::Singular));
}

#[test]
fn s2_rigid_inverses_are_refused_exactly_at_the_bound() {
    for (scale, rigid) in [(ONE, true), (ONE + 1, false), (2 * ONE, false), (ONE / 2, false), (-ONE, true)] {
        let a = Affine::<Model, World>::scale(scalar(scale)).rigid_inverse().map(|_| ());
        assert_eq!(a, if rigid { Ok(()) } else { Err(InverseError::NotRigid) }, "{scale}");
    }
    // Row lengths to 2⁻²⁰: 2⁻¹⁶ is above it.
    let sheared = Affine::<Model, World>::from_frame(
        vector([ONE, 0, 0]),
        vector([1, ONE, 0]),
        vector([0, 0, ONE]),
        point([0; 3]),
    );
    assert_eq!(sheared.rigid_inverse().map(|_| ()), Err(InverseError::NotRigid));
    // A coefficient of 1, for which all coefficients are scaled down, does not change the limit.
    for (long, rigid) in [(2f64.powi(-20), false), (2f64.powi(-22), true)] {
        let c = (0.5f64).sqrt();
        for (a, b) in [(1.0, 0.0), (c, c)] {
            let row = [[a + a * long, -b - b * long, 0.0, 0.0], [b, a, 0.0, 0.0]];
            let m = [row[0], row[1], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
            let inverse = Affine::<Model, World>::from_matrix(&m).expect("a matrix").rigid_inverse();
            assert_eq!(inverse.is_ok(), rigid, "{m:?}");
        }
    }
}

#[test]
fn s2_normals_go_by_the_inverse_transpose() {
    let mut rng = Rng::new(0x205);
    let (mut worst, mut compared) = (0f64, 0);
    while compared < 20_000 {
        let size = rng.log(0.01, 1000.0);
        let axes = [(); 3].map(|()| rng.direction().map(|c| c * size));
        let [Some(a), Some(b), Some(c)] = axes.map(bits) else { continue };
        let exact: M3 = core::array::from_fn(|i| [fx(a[i]), fx(b[i]), fx(c[i])]);
        let det = determinant(&exact);
        if det.abs() < 0.01 * length(fx3(a)) * length(fx3(b)) * length(fx3(c)) {
            continue;
        }
        compared += 1;
        let map =
            Affine::<Model, World>::from_frame(vector(a), vector(b), vector(c), point([0; 3])).normals();
        let n = normalise(rng.direction()).map(|c| (c * 32767.0).round() as i16);
        let back = inverse(&exact);
        let want = normalise(core::array::from_fn(|i| (0..3).map(|k| back[k][i] * f64::from(n[k])).sum()));
        let got = map.apply(n).map(|c| f64::from(c) / 32768.0);
        for i in 0..3 {
            worst = worst.max((got[i] - want[i]).abs() * 32768.0);
        }
        // Perpendicular to what it was perpendicular to.
        let tangent = cross(n.map(f64::from), [1.0, 2.0, 3.0]);
        let moved = chain::mul3(&exact, tangent);
        assert!(dot(got, moved).abs() <= 2.0 / 32768.0 * length(moved), "{got:?}");
    }
    println!("normals: within {worst:.3}·2⁻¹⁵");
    assert!(worst <= 1.001, "{worst}");
    // Flattened: the direction that is left, or none.
    let flat = Affine::<Model, World>::scale_axes(scalar(ONE), scalar(ONE), scalar(0)).normals();
    assert_eq!(flat.apply([100, 0, 30_000]), [0, 0, 32_767]);
    assert_eq!(Affine::<Model, World>::scale(scalar(0)).normals().apply([1, 2, 3]), [0; 3]);
}
