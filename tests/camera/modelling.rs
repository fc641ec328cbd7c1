//! docs/spec.md, section 2: rotation about any axis through any point, quaternions, frames and inverses, the normal
//! transform, composition.

use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, AxisError, InverseError, NumberError, Point3, Quaternion, QuaternionError};
use support::bridge::pair::{bits, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, cross, dot, fx, fx3, length, matmul3, normalise, M3, V3};
use support::oracle::rng::Rng;

/// The linear part and the translation of a transform, measured from images of points: coefficients to 2⁻³¹, where they are
/// small enough for the image of a long vector not to saturate.
fn read(a: &Affine<Model, World>, reach: f64) -> (M3, V3) {
    let step = (reach * 65536.0) as i32;
    let o = reals(a.apply(point([0; 3])));
    let mut m = [[0.0; 3]; 3];
    for j in 0..3 {
        let mut p = [0; 3];
        p[j] = step;
        let (up, down) = (reals(a.apply(point(p))), reals(a.apply(point(p.map(|c| -c)))));
        for i in 0..3 {
            m[i][j] = (up[i] - down[i]) / (2.0 * fx(step));
        }
    }
    (m, o)
}

fn worst(a: &M3, b: &M3) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Rodrigues' formula.
fn rodrigues(axis: V3, angle: u32) -> M3 {
    let [x, y, z] = normalise(axis);
    let (s, c) = chain::sin_cos(angle);
    let v = 1.0 - c;
    [
        [c + v * x * x, v * x * y - s * z, v * x * z + s * y],
        [v * y * x + s * z, c + v * y * y, v * y * z - s * x],
        [v * z * x - s * y, v * z * y + s * x, c + v * z * z],
    ]
}

fn random_axis(rng: &mut Rng) -> [i32; 3] {
    loop {
        let length = rng.log(2e-5, 32_000.0);
        let v = match rng.below(3) {
            0 => bits(rng.direction().map(|c| c * length)),
            1 => Some([0; 3].map(|_| rng.int(-2, 2) as i32)),
            _ => Some([0; 3].map(|_| rng.bits() as i32)),
        };
        if let Some(v) = v.filter(|v| *v != [0; 3]) {
            return v;
        }
    }
}

#[test]
fn s2_rotation_about_any_axis_is_align_rotate_undo() {
    let mut rng = Rng::new(0x201);
    let (mut linear, mut composed) = (0f64, 0f64);
    for _ in 0..20_000 {
        let axis = random_axis(&mut rng);
        let through = [0; 3].map(|_| rng.int(-500 * i64::from(ONE), 500 * i64::from(ONE)) as i32);
        let angle = if rng.one_in(5) { (rng.bits() >> 30) << 30 } else { rng.bits() };
        let direct = Affine::<Model, World>::rotation(point(through), vector(axis), Angle::from_bits(angle))
            .expect("an axis");
        // The formula, in f64.
        let exact = rodrigues(fx3(axis), angle);
        let away: V3 = core::array::from_fn(|i| fx(through[i]) - dot(exact[i], fx3(through)));
        let (m, t) = read(&direct, 16_000.0);
        linear = linear.max(worst(&m, &exact));
        for i in 0..3 {
            assert!((t[i] - away[i]).abs() <= 0.6 / 65536.0 + 900.0 * 2f64.powi(-28), "{axis:?} {through:?}");
        }
        // Align the axis with z, rotate about z, undo: in f64, from a frame about the axis.
        let c = normalise(fx3(axis));
        let helper = if c[0].abs() < 0.7 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let a = normalise(cross(helper, c));
        let b = cross(c, a);
        let frame: M3 = core::array::from_fn(|i| [a[i], b[i], c[i]]);
        let undo: M3 = [a, b, c];
        let (s, co) = chain::sin_cos(angle);
        let about_z = [[co, -s, 0.0], [s, co, 0.0], [0.0, 0.0, 1.0]];
        let composition = matmul3(&frame, &matmul3(&about_z, &undo));
        composed = composed.max(worst(&m, &composition));
    }
    println!(
        "rotation: within 2^{:.2} of the formula, 2^{:.2} of the composition",
        linear.log2(),
        composed.log2()
    );
    // Reading off costs 2⁻³¹.
    assert!(linear <= 2f64.powi(-27) + 2f64.powi(-31), "2^{}", linear.log2());
    assert!(composed <= 2f64.powi(-27) + 2f64.powi(-31), "2^{}", composed.log2());
    let zero = Affine::<Model, World>::rotation(point([0; 3]), vector([0; 3]), Angle::QUARTER_TURN);
    assert_eq!(zero, Err(AxisError::ZeroAxis));
}

#[test]
fn s2_align_rotate_undo_with_the_librarys_own_frames() {
    // Frames whose axes are exact: permutations, signs, and 3-4-5 turns.
    let p = |x: i16, y: i16, z: i16| pinhole::Vector3::<World>::from_ints(x, y, z);
    let through = Point3::<World>::from_ints(3, -2, 5);
    for (a, b, c) in [
        (p(1, 0, 0), p(0, 1, 0), p(0, 0, 1)),
        (p(0, 1, 0), p(0, 0, 1), p(1, 0, 0)),
        (p(0, -1, 0), p(1, 0, 0), p(0, 0, 1)),
        (p(0, 0, -1), p(0, 1, 0), p(1, 0, 0)),
    ] {
        for angle in [0, 123_456_789, 1 << 30, 0x9abc_def0] {
            let angle = Angle::from_bits(angle);
            let frame = Affine::<World, World>::from_frame(a, b, c, through);
            let align = frame.rigid_inverse().expect("rigid");
            let composed = align.then(&Affine::rotation_z(angle)).then(&frame);
            let direct = Affine::<World, World>::rotation(through, c, angle).expect("an axis");
            for q in [[1000, 0, 0], [0, -2000, 31], [7, 8, 9]] {
                let q = Point3::from_ints(q[0], q[1], q[2]);
                let (one, two) = (reals(composed.apply(q)), reals(direct.apply(q)));
                for i in 0..3 {
                    assert!((one[i] - two[i]).abs() <= 1.1 / 65536.0, "{one:?} {two:?}");
                }
            }
        }
    }
}

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

#[test]
fn s2_quaternions_match_f64_and_micromath() {
    let mut rng = Rng::new(0x202);
    let (mut own, mut theirs) = (0f64, 0f64);
    for _ in 0..20_000 {
        let scale = rng.log(0.25, 30_000.0);
        let q = [(); 4].map(|()| rng.real(-1.0, 1.0) * scale);
        let q_bits = q.map(|c| (c * 65536.0) as i32);
        if q_bits.iter().any(|c| c.unsigned_abs() > 1 << 10) {
            let [w, x, y, z] = q_bits.map(scalar);
            let ours = Affine::from_quaternion(Quaternion::new(w, x, y, z).expect("not zero"));
            own = own.max(worst(&read(&ours, 16_000.0).0, &by_quaternion(unit(q_bits.map(fx)))));
        }
        let q = q.map(|c| c as f32);
        // Parts keep their bits down to 2⁻³²: short ones have fewer.
        if q.iter().all(|c| c.abs() < 0.125) {
            continue;
        }
        let quaternion = micromath::Quaternion::new(q[0], q[1], q[2], q[3]);
        let ours = Affine::from_quaternion(Quaternion::try_from(quaternion).expect("a rotation"));
        theirs = theirs.max(worst(&read(&ours, 16_000.0).0, &by_quaternion(unit(q.map(f64::from)))));
    }
    println!("quaternions: within 2^{:.2}, micromath's 2^{:.2}", own.log2(), theirs.log2());
    assert!(own <= 2f64.powi(-27) && theirs <= 2f64.powi(-27));
    let zero = scalar(0);
    assert_eq!(Quaternion::new(zero, zero, zero, zero), Err(QuaternionError::Zero));
    let from = |w: f32, x: f32| Quaternion::try_from(micromath::Quaternion::new(w, x, 0.0, 0.0));
    assert_eq!(from(0.0, 0.0), Err(QuaternionError::Zero));
    assert_eq!(from(f32::NAN, 0.0), Err(QuaternionError::Number(NumberError::NotFinite)));
    assert_eq!(from(1.0, f32::INFINITY), Err(QuaternionError::Number(NumberError::NotFinite)));
    assert_eq!(from(40_000.0, 0.0), Err(QuaternionError::Number(NumberError::OutOfRange)));
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

#[test]
fn s2_the_general_inverse_matches_f64_and_undoes_the_transform() {
    let mut rng = Rng::new(0x203);
    let mut compared = 0;
    let mut used = 0f64;
    while compared < 20_000 {
        // Any frame with axes of lengths within 1 : 30.
        let size = rng.log(0.1, 30.0);
        let axes = [(); 3].map(|()| {
            let length = size * rng.log(0.2, 6.0);
            rng.direction().map(|c| c * length)
        });
        let [Some(a), Some(b), Some(c)] = axes.map(bits) else { continue };
        let o = [0; 3].map(|_| rng.int(-100 * i64::from(ONE), 100 * i64::from(ONE)) as i32);
        let exact: M3 = core::array::from_fn(|i| [fx(a[i]), fx(b[i]), fx(c[i])]);
        let back = inverse(&exact);
        let norm = |m: &M3| m.iter().map(|r| r.iter().map(|c| c.abs()).sum::<f64>()).fold(0.0, f64::max);
        let condition = norm(&exact) * norm(&back);
        if condition > 1e4 {
            continue;
        }
        compared += 1;
        let frame = Affine::<Model, World>::from_frame(vector(a), vector(b), vector(c), point(o));
        let inverse = frame.inverse().expect("not singular");
        let largest = back.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
        let reach = (16_000.0 / norm(&back)).min(16_000.0);
        let centred = Affine::<Model, World>::from_frame(vector(a), vector(b), vector(c), point([0; 3]));
        let (m, _) = read_back(&centred.inverse().expect("not singular"), reach);
        let error = worst(&m, &back);
        // Documented: 2⁻²⁸ × the ratio of stretches of the largest coefficient; reading costs 2⁻¹⁷/reach.
        let allowed = largest * condition * 2f64.powi(-28) + 2f64.powi(-17) / reach;
        used = used.max(error / allowed);
        assert!(error <= allowed, "{error} for {allowed}: {a:?} {b:?} {c:?}");
        // Round trip of a point of the frame.
        let p = [0; 3].map(|_| rng.int(-10 * i64::from(ONE), 10 * i64::from(ONE)) as i32);
        let there = frame.apply(point(p));
        if reals(there).iter().any(|c| c.abs() > 32_000.0) {
            continue;
        }
        let again = reals(inverse.apply(there));
        let room = 0.51 / 65536.0 * (1.0 + 3.0 * largest)
            + 400.0 * condition * largest * 2f64.powi(-26) * 2.0 * size.max(1.0);
        for i in 0..3 {
            assert!((again[i] - fx(p[i])).abs() <= room, "{again:?} {p:?} {room}");
        }
    }
    println!("inverse: at most {used:.2} of the stated bound");
}

/// As `read`, for the other way.
fn read_back(a: &Affine<World, Model>, reach: f64) -> (M3, V3) {
    let change = Affine::<Model, World>::identity().then(a).then(&Affine::<Model, World>::identity());
    read(&change, reach)
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
fn s2_rigid_inverse_is_the_transpose() {
    let mut rng = Rng::new(0x204);
    for _ in 0..5000 {
        let axis = random_axis(&mut rng);
        let through = [0; 3].map(|_| rng.int(-500 * i64::from(ONE), 500 * i64::from(ONE)) as i32);
        let there =
            Affine::<Model, World>::rotation(point(through), vector(axis), Angle::from_bits(rng.bits()))
                .expect("an axis");
        let back = there.rigid_inverse().expect("rigid");
        let (m, _) = read(&there, 16_000.0);
        let (r, _) = read_back(&back, 16_000.0);
        let transposed: M3 = core::array::from_fn(|i| core::array::from_fn(|j| m[j][i]));
        assert!(worst(&r, &transposed) <= 2f64.powi(-30), "the same numbers, read twice");
        let general = there.inverse().expect("not singular");
        assert!(worst(&read_back(&general, 16_000.0).0, &transposed) <= 2f64.powi(-26));
        let p = [0; 3].map(|_| rng.int(-500 * i64::from(ONE), 500 * i64::from(ONE)) as i32);
        let again = reals(back.apply(there.apply(point(p))));
        for i in 0..3 {
            // Half a unit at both ends; R·Rᵀ is the identity to 2⁻²⁷.
            assert!(
                (again[i] - fx(p[i])).abs() <= 1.5 / 65536.0 + 3000.0 * 2f64.powi(-27),
                "{again:?} {p:?}"
            );
        }
    }
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

#[test]
fn s2_composition_is_associative_and_reads_left_to_right() {
    let mut rng = Rng::new(0x206);
    for _ in 0..5000 {
        let mut any = || {
            let turn = Affine::<World, World>::rotation(
                point([0; 3]),
                vector(random_axis(&mut rng)),
                Angle::from_bits(rng.bits()),
            );
            let s = rng.int(i64::from(ONE / 2), i64::from(2 * ONE)) as i32;
            let t = [0; 3].map(|_| rng.int(-50 * i64::from(ONE), 50 * i64::from(ONE)) as i32);
            turn.expect("an axis")
                .then(&Affine::<World, World>::scale(scalar(s)))
                .then(&Affine::<World, World>::translation(vector(t)))
        };
        let (a, b, c) = (any(), any(), any());
        let p = point([0; 3].map(|_| rng.int(-50 * i64::from(ONE), 50 * i64::from(ONE)) as i32));
        let left = reals(a.then(&b).then(&c).apply(p));
        let right = reals(a.then(&b.then(&c)).apply(p));
        let steps = reals(c.apply(b.apply(a.apply(p))));
        for i in 0..3 {
            assert!(
                (left[i] - right[i]).abs() <= 1.0 / 65536.0 + 1e-5 * 2f64.powi(-10),
                "{left:?} {right:?}"
            );
            // Each step rounds its point; later scales of at most 2 enlarge that.
            assert!((left[i] - steps[i]).abs() <= 8.0 / 65536.0, "{left:?} {steps:?}");
        }
    }
}
