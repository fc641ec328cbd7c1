//! docs/spec.md, section 2: quaternions of micromath, frames and inverses, and hierarchies: world = parent's world · local, a node moves
//! its descendants, and invalid parents are refused. The errors of rotations, quaternions, compositions, inverses and normals are in
//! `tests/bounds.rs`.

use pinhole::space::{Model, World};
use pinhole::{
    math::MathError,
    mesh::{Hierarchy, MeshError, Node},
    Affine, Angle,
};
use support::bridge::pair::{ModelBits, Step, ONE};
use support::bridge::{point, reals, scalar, vector};
use support::oracle::chain::{self, fx3, M3};
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
        let ours = Affine::<Model, World>::try_from(quaternion).expect("a rotation");
        let exact = by_quaternion(unit(q.map(f64::from)));
        for (row, exact) in ours.to_matrix().iter().zip(exact) {
            worst = row.iter().zip(exact).map(|(c, exact)| (c - exact).abs()).fold(worst, f64::max);
        }
    }
    assert!(worst <= 2f64.powi(-27), "2^{}", worst.log2());
    let zero = scalar(0);
    assert_eq!(Affine::<Model, World>::from_quaternion([zero; 4]), Err(MathError::ZeroLength));
    let from = |w: f32, x: f32| Affine::<Model, World>::try_from(micromath::Quaternion::new(w, x, 0.0, 0.0));
    assert_eq!(from(0.0, 0.0), Err(MathError::ZeroLength));
    assert_eq!(from(f32::NAN, 0.0), Err(MathError::NotFinite));
    assert_eq!(from(1.0, f32::INFINITY), Err(MathError::NotFinite));
    assert_eq!(from(40_000.0, 0.0), Err(MathError::OutOfRange));
    let about_nothing = Affine::<Model, World>::rotation(point([0; 3]), vector([0; 3]), Angle::degrees(90));
    assert_eq!(about_nothing, Err(MathError::ZeroLength));
}

#[test]
fn s2_singular_frames_are_refused_exactly_at_the_bound() {
    let x = vector::<World>([ONE, 0, 0]);
    let y = vector([0, ONE, 0]);
    let frame = |c: [i32; 3]| {
        Affine::<Model, World>::from_frame(x, y, vector(c), point([0; 3])).inverse().map(|_| ())
    };
    // c in the plane of a and b.
    assert_eq!(frame([ONE, ONE, 0]), Err(MathError::Singular));
    assert_eq!(frame([0; 3]), Err(MathError::Singular));
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
        assert_eq!(leaning(h), if wanted { Ok(()) } else { Err(MathError::Singular) }, "{h}");
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
    assert_eq!(flat.inverse().map(|_| ()), Err(MathError::Singular));
}

fn random_local(rng: &mut Rng) -> ModelBits {
    let mut steps = ModelBits::random_rotation(rng);
    steps.0.push(Step::Move([0; 3].map(|_| rng.int(-5 * i64::from(ONE), 5 * i64::from(ONE)) as i32)));
    steps
}

#[test]
fn s2_world_is_parents_world_times_local() {
    let mut rng = Rng::new(0x21);
    for _ in 0..300 {
        let count = 1 + rng.below(30);
        let parents: Vec<Option<u16>> =
            (0..count).map(|i| (i > 0 && !rng.one_in(5)).then(|| rng.below(i.max(1)) as u16)).collect();
        let mut locals: Vec<ModelBits> = (0..count).map(|_| random_local(&mut rng)).collect();
        let mut nodes: Vec<Node> = parents
            .iter()
            .zip(&locals)
            .map(|(p, l)| match p {
                None => Node::root(l.local()),
                Some(p) => Node::child(*p, l.local()),
            })
            .collect();
        let mut tree = Hierarchy::new(&mut nodes).expect("parents come first");
        for round in 0..3 {
            let mut exact: Vec<chain::Affine> = Vec::new();
            for i in 0..count {
                let own = locals[i].exact();
                exact.push(parents[i].map_or(own, |p| own.then(&exact[usize::from(p)])));
            }
            for (i, exact) in exact.iter().enumerate() {
                let p = [ONE, -2 * ONE, 3 * ONE];
                let got = reals(tree.world(i).expect("a node").apply(point(p)));
                let want = exact.apply(fx3(p));
                for k in 0..3 {
                    // Up to 30 compositions of 2⁻³⁰ on at most 150 units.
                    assert!((got[k] - want[k]).abs() <= 0.6 / 65536.0, "{round} {i}: {got:?} {want:?}");
                }
            }
            // A node moves: itself and all below it, nothing else.
            let moved = rng.below(count);
            let before: Vec<_> = (0..count).map(|i| *tree.world(i).expect("a node")).collect();
            locals[moved] = random_local(&mut rng);
            assert!(tree.set_local(moved, locals[moved].local()));
            assert_eq!(tree.world(moved), Some(&before[moved]), "not before the update");
            tree.update();
            for (i, before) in before.iter().enumerate() {
                let mut up = Some(i);
                while let Some(k) = up.filter(|&k| k != moved) {
                    up = parents[k].map(usize::from);
                }
                if up.is_none() {
                    assert_eq!(tree.world(i), Some(before), "{i} is not below {moved}");
                } else {
                    assert_ne!(tree.world(i), Some(before), "{i} is below {moved}");
                }
            }
        }
        assert!(!tree.set_local(count, Affine::identity()));
        assert_eq!(tree.world(count), None);
    }
}

#[test]
fn s2_forward_and_own_parents_are_refused() {
    let node = |p| Node::child(p, Affine::identity());
    let root = Node::root(Affine::identity());
    for (mut nodes, error) in [
        (vec![node(0)], (0, 0)),
        (vec![root, node(1)], (1, 1)),
        (vec![root, node(2), node(0)], (1, 2)),
        (vec![root, node(0), node(u16::MAX)], (2, u16::MAX)),
        // A cycle needs a forward parent.
        (vec![root, node(3), node(1), node(2)], (1, 3)),
    ] {
        let wanted = MeshError::Parent { node: error.0, parent: error.1 };
        assert_eq!(Hierarchy::new(&mut nodes).map(|_| ()), Err(wanted));
    }
    assert!(Hierarchy::new(&mut []).is_ok());
}
