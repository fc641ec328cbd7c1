//! Clipping to the view volume: geometry inside is unchanged, and clipped geometry is inside.

use crate::cases;
use crate::strategies::shift;
use pinhole::clip::{self, ClipVertex};
use pinhole::space::View;
use pinhole::{ClipPoint, Outcode, Projection};
use proptest::prelude::*;
use support::bridge::pair::{window, ONE};
use support::bridge::{point, scalar};

fn projections() -> [Projection; 3] {
    let square = |half: i32| window([-half, half, -half, half]);
    [
        Projection::frustum(square(ONE), scalar(ONE), scalar(20 * ONE)).expect("a frustum"),
        Projection::orthographic(square(5 * ONE), scalar(ONE), scalar(20 * ONE)).expect("a box"),
        Projection::frustum(window([-ONE / 8, ONE, -ONE, ONE / 4]), scalar(ONE / 4), scalar(1000 * ONE))
            .expect("a frustum"),
    ]
}

/// In view space: on the planes and edges of the volumes, or anywhere about them.
fn view_point() -> impl Strategy<Value = [i32; 3]> {
    prop_oneof![
        [-5i32..=5, -5i32..=5, -21i32..=1].prop_map(|p| p.map(|c| c * ONE)),
        (shift(8), shift(8), -30 * ONE..2 * ONE).prop_map(|(x, y, z)| [x, y, z]),
        [shift(2000), shift(2000), shift(2000)],
    ]
}

/// How far a point lies outside the volume at most, in units of its numbers.
fn outside(p: &ClipPoint) -> i64 {
    let [x, y, z, w] = p.xyzw().map(i64::from);
    [x, y, z].map(|c| c.abs() - w).into_iter().fold(0, i64::max)
}

/// The documented 2⁻²⁷ of the largest corner, whose numbers have up to 30 bits.
const ROUNDING: i64 = 1 << 3;

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn a_clipped_line_is_inside_and_clipping_is_idempotent(
        a in view_point(), b in view_point(), which in 0usize..3,
    ) {
        let projection = &projections()[which];
        let (a, b) = (projection.apply(point::<View>(a)), projection.apply(point::<View>(b)));
        let shared = a.outcode().and(b.outcode()) != Outcode::INSIDE;
        let Some((p, q)) = clip::line(a, b) else { return Ok(()) };
        // Both outside one plane: invisible, unless the smaller one is on it once both are in the larger one's units.
        let unit = a.exponent().max(b.exponent());
        let out = |p: &ClipPoint| outside(p) as f64 * f64::from(p.exponent() - unit).exp2();
        prop_assert!(!shared || out(&a).min(out(&b)) <= 1.0, "{a:?} {b:?}");
        prop_assert!(outside(&p) <= ROUNDING && outside(&q) <= ROUNDING, "{p:?} {q:?}");
        // The other way round: the same ends.
        prop_assert_eq!(clip::line(b, a), Some((q, p)));
        if a.outcode().or(b.outcode()) == Outcode::INSIDE {
            prop_assert_eq!((p.ndc(), q.ndc()), (a.ndc(), b.ndc()));
        }
        // Once more: an end that is inside stays to the bit; one that rounding left outside comes no farther out.
        match clip::line(p, q) {
            Some((r, s)) => {
                for (before, after) in [(p, r), (q, s)] {
                    if before.outcode() == Outcode::INSIDE {
                        prop_assert_eq!(before, after);
                    }
                    prop_assert!(outside(&after) <= ROUNDING);
                }
            }
            // All of it within rounding of a plane.
            None => prop_assert!(outside(&p) > 0 || outside(&q) > 0),
        }
    }

    #[test]
    fn a_clipped_triangle_is_inside_and_clipping_is_idempotent(
        corners in [view_point(), view_point(), view_point()],
        attributes in any::<[[i16; 2]; 3]>(),
        which in 0usize..3,
    ) {
        let projection = &projections()[which];
        let vertex = |k: usize| ClipVertex {
            point: projection.apply(point::<View>(corners[k])),
            attributes: attributes[k].map(i32::from),
        };
        let t = [vertex(0), vertex(1), vertex(2)];
        let polygon = clip::triangle(t);
        prop_assert!(polygon.is_empty() || polygon.len() >= 3);
        for corner in &polygon {
            prop_assert!(outside(&corner.point) <= ROUNDING, "{corner:?}");
            // Interpolated, never beyond the three values.
            for k in 0..2 {
                let values = t.map(|v| v.attributes[k]);
                let (low, high) = (values.iter().min().unwrap(), values.iter().max().unwrap());
                prop_assert!((low..=high).contains(&&corner.attributes[k]));
            }
        }
        // Each fan triangle that is inside stays to the bit.
        for k in 2..polygon.len() {
            let part = [polygon[0], polygon[k - 1], polygon[k]];
            if part.iter().all(|v| v.point.outcode() == Outcode::INSIDE) {
                prop_assert_eq!(&clip::triangle(part)[..], &part);
            }
        }
    }
}
