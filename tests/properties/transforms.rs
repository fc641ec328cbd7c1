//! Transforms compose as matrices do, and their inverses return points to where they were.

use crate::cases;
use crate::strategies::{factor, shift, step, turn};
use pinhole::space::{Model, World};
use pinhole::{Affine, Point3};
use proptest::prelude::*;
use support::bridge::pair::{ModelBits, Step};
use support::bridge::{point, reals};
use support::oracle::chain::fx;

/// How far the steps can stretch a vector, and how far they take the origin at most.
fn reach(steps: &[Step]) -> (f64, f64) {
    steps.iter().fold((1.0, 0.0), |(stretch, away), step| match step {
        Step::Scale(f) => {
            let f = fx(f[0]);
            (stretch * f, away * f)
        }
        Step::Move(t) => (stretch, away + t.map(|c| fx(c).abs()).iter().sum::<f64>()),
        _ => (stretch, away),
    })
}

fn worst(a: Point3<World>, b: Point3<World>) -> f64 {
    let (a, b) = (reals(a), reals(b));
    (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

fn largest(p: [i32; 3]) -> f64 {
    p.map(|c| fx(c).abs()).iter().sum()
}

const UNIT: f64 = 1.0 / 65536.0;

/// Of what the steps make of a vector: each composition rounds coefficients to 2⁻³¹ of the largest, and there are up to
/// eight of them.
const CHAIN: f64 = 1.0 / (1 << 28) as f64;

/// Of a world that reaches ±32768, what does not saturate on the way.
const ROOM: f64 = 30_000.0;

proptest! {
    #![proptest_config(cases(15_000))]

    #[test]
    fn then_is_associative(
        a in prop::collection::vec(step(), 1..4),
        b in prop::collection::vec(step(), 1..4),
        c in prop::collection::vec(step(), 1..4),
        p in [shift(500), shift(500), shift(500)],
    ) {
        let all = [&a[..], &b, &c].concat();
        let (stretch, away) = reach(&all);
        let size = stretch * largest(p) + away;
        prop_assume!(size < ROOM);
        let [a, b, c] = [a, b, c].map(|steps| ModelBits(steps).library());
        let back = Affine::<World, Model>::identity();
        let left = a.then(&back).then(&b).then(&back).then(&c);
        let right = a.then(&back).then(&b.then(&back).then(&c));
        let off = worst(left.apply(point(p)), right.apply(point(p)));
        // Half a unit each, and the chain's rounding.
        prop_assert!(off <= UNIT + CHAIN * size, "{off} of {size}");
    }

    #[test]
    fn then_is_one_after_the_other(
        a in prop::collection::vec(step(), 1..5),
        b in prop::collection::vec(step(), 1..5),
        p in [shift(500), shift(500), shift(500)],
    ) {
        let ((sa, ta), (sb, tb)) = (reach(&a), reach(&b));
        let middle = sa * largest(p) + ta;
        let size = sb * middle + tb;
        prop_assume!(middle < ROOM && size < ROOM);
        let [a, b] = [a, b].map(|steps| ModelBits(steps).library());
        let back = Affine::<World, Model>::identity();
        let composed = a.then(&back).then(&b).apply(point(p));
        let stepped = b.apply(back.apply(a.apply(point(p))));
        // The point between is rounded by half a unit in each coordinate, which b stretches.
        let off = worst(composed, stepped);
        prop_assert!(off <= UNIT + 0.5 * UNIT * 3f64.sqrt() * sb + CHAIN * size, "{off} of {size}");
    }

    #[test]
    fn identity_changes_no_transform(a in prop::collection::vec(step(), 0..5), p in any::<[i32; 3]>()) {
        let a = ModelBits(a).library();
        let (before, after) = (Affine::<Model, Model>::identity().then(&a), a.then(&Affine::<World, World>::identity()));
        prop_assert_eq!(before.apply(point(p)), a.apply(point(p)));
        prop_assert_eq!(after.apply(point(p)), a.apply(point(p)));
    }

    #[test]
    fn the_inverse_returns_points_to_where_they_were(
        first in turn(),
        scale in [factor(), factor(), factor()],
        second in turn(),
        move_by in [shift(2000), shift(2000), shift(2000)],
        p in [shift(500), shift(500), shift(500)],
    ) {
        let scales = scale.map(fx);
        let (large, small) =
            (scales.iter().fold(0f64, |m, s| m.max(*s)), scales.iter().fold(f64::MAX, |m, s| m.min(*s)));
        let size = large * largest(p) + largest(move_by);
        prop_assume!(size < ROOM);
        let mut steps = first.0;
        steps.push(Step::Scale(scale));
        steps.extend(second.0);
        steps.push(Step::Move(move_by));
        let a = ModelBits(steps).library();
        let inverse = a.inverse();
        // Stretches that differ 65536-fold lie beyond the bound on flatness.
        prop_assume!(large / small < 4000.0 || inverse.is_ok());
        let inverse = inverse.expect("not singular");
        let there = a.apply(point(p));
        let again = reals(inverse.apply(there));
        // The image is rounded by half a unit; 2⁻²⁸ times the ratio of stretches is the inverse's bound.
        let bound = 0.5 * UNIT + (0.5 * UNIT * 3f64.sqrt() + 2.0 * 2f64.powi(-28) * large / small * size) / small;
        for i in 0..3 {
            prop_assert!((again[i] - fx(p[i])).abs() <= bound, "{again:?} {p:?} {bound}");
        }
    }

    #[test]
    fn the_rigid_inverse_returns_points_to_where_they_were(
        first in turn(),
        second in turn(),
        move_by in [shift(2000), shift(2000), shift(2000)],
        p in [shift(2000), shift(2000), shift(2000)],
    ) {
        let steps = [first.0, second.0, vec![Step::Move(move_by)]].concat();
        let a = ModelBits(steps).library();
        let inverse = a.rigid_inverse();
        prop_assert!(inverse.is_ok());
        let again = reals(inverse.expect("rigid").apply(a.apply(point(p))));
        // Half a unit, turned, and half a unit; R·Rᵀ is the identity to 2⁻²⁷.
        let bound = 0.5 * UNIT * (1.0 + 3f64.sqrt()) + 2f64.powi(-26) * (largest(p) + largest(move_by));
        for i in 0..3 {
            prop_assert!((again[i] - fx(p[i])).abs() <= bound, "{again:?} {p:?} {bound}");
        }
    }
}
