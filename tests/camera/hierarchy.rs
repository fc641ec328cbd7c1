//! docs/spec.md, section 2, scene hierarchy: world = parent's world · local, a node moves its descendants, invalid parents are refused, one
//! mesh under many nodes and many meshes under one, and no drift.

use pinhole::space::Model;
use pinhole::{Affine, Angle, Hierarchy, HierarchyError, Mesh, Node};
use support::bridge;
use support::bridge::draw::{solid, CUBE, CUBE_FACES};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{point, reals, vector};
use support::oracle::chain::{self, fx3};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

fn local(steps: &ModelBits) -> Affine<Model, Model> {
    let mut all = Affine::identity();
    for step in &steps.0 {
        all = all.then(&match *step {
            Step::X(a) => Affine::rotation_x(Angle::from_bits(a)),
            Step::Y(a) => Affine::rotation_y(Angle::from_bits(a)),
            Step::Z(a) => Affine::rotation_z(Angle::from_bits(a)),
            Step::Scale([s, ..]) => Affine::scale(bridge::scalar(s)),
            Step::Move(t) => Affine::translation(vector(t)),
        });
    }
    all
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
                None => Node::root(local(l)),
                Some(p) => Node::child(*p, local(l)),
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
            assert!(tree.set_local(moved, local(&locals[moved])));
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
        let wanted = HierarchyError { node: error.0, parent: error.1 };
        assert_eq!(Hierarchy::new(&mut nodes).map(|_| ()), Err(wanted));
    }
    assert!(Hierarchy::new(&mut []).is_ok());
}

#[test]
fn s2_one_mesh_may_stand_under_many_nodes() {
    let camera = CameraBits {
        view: ViewBits::LookAt([0, 0, 20 * ONE], [0; 3], [0, ONE, 0]),
        projection: ProjectionBits::Orthographic([-10 * ONE, 10 * ONE, -10 * ONE, 10 * ONE], ONE, 50 * ONE),
        viewport: (0, 0, 80, 80),
    }
    .library();
    let at = |x: i16, y: i16| Affine::<Model, Model>::translation(pinhole::Vector3::from_ints(x, y, 0));
    let mut nodes = [
        Node::root(at(0, -6)),
        Node::child(0, at(-6, 0)),
        Node::child(0, at(6, 0)),
        Node::child(2, at(0, 12)),
    ];
    let tree = Hierarchy::new(&mut nodes).expect("a tree");
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let mut target = Recorder::sized(80, 80);
    for node in tree.nodes() {
        solid(&camera.place(&mesh, node.world()), &mut target).expect("no error");
    }
    // Cubes of 8 × 8 px about their places: 4 px a unit, y down.
    let mut wanted = std::collections::BTreeSet::new();
    for (x, y) in [(0, -6), (-6, -6), (6, -6), (6, 6)] {
        for i in -4..4 {
            for j in -4..4 {
                wanted.insert((40 + 4 * x + i, 40 - 4 * y + j));
            }
        }
    }
    assert_eq!(target.pixels.keys().copied().collect::<std::collections::BTreeSet<_>>(), wanted);
}
