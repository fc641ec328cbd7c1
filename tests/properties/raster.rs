//! The rasterizer: partitions, vertex orders, translations, crops.

use crate::cases;
use crate::strategies::{part, pixel, triangle, PICTURE};
use proptest::prelude::*;
use support::bridge::{self, compare};
use support::oracle::cases::{FARTHEST, GUARD};
use support::oracle::coverage::{closed, Area, Counts, P};

/// Splits a triangle of the list at a point of it, in its interior or on its border: in up to three.
fn split(triangles: &mut Vec<[P; 3]>, which: usize, (u, v): (i64, i64), lattice: bool) {
    let t @ [a, b, c] = triangles[which % triangles.len()];
    // a + (b − a)·u/16 + (c − a)·v/16, with u + v ≤ 16.
    let at = |a: i64, b: i64, c: i64| {
        let p = a + ((b - a) * u + (c - a) * v) / 16;
        if lattice {
            p.div_euclid(128) * 128
        } else {
            p
        }
    };
    let p = (at(a.0, b.0, c.0), at(a.1, b.1, c.1));
    if !closed(t, p) || t.contains(&p) {
        return; // rounded out of the triangle, or onto a corner
    }
    triangles.retain(|other| *other != t);
    triangles.extend([[a, b, p], [b, c, p], [c, a, p]]);
}

fn sum(pictures: impl Iterator<Item = Counts>) -> Vec<u32> {
    let mut total = vec![0; PICTURE.width() * PICTURE.height()];
    for picture in pictures {
        for (sum, hits) in total.iter_mut().zip(picture.hits) {
            *sum += hits;
        }
    }
    total
}

proptest! {
    #![proptest_config(cases(10_000))]

    /// The parts of a triangle cover its pixels, each pixel once, borders included: as if every center lay a tiny distance
    /// to its lower right, on no edge.
    #[test]
    fn r8_coverage_of_a_partition_is_one(
        t in triangle(),
        splits in prop::collection::vec((any::<prop::sample::Index>(), 0i64..=16, 0i64..=16, prop::bool::ANY), 1..12),
    ) {
        let mut parts = vec![t];
        for (which, u, v, lattice) in splits {
            let v = v.min(16 - u);
            let n = parts.len();
            split(&mut parts, which.index(n), (u, v), lattice);
        }
        let whole = bridge::triangle(t, PICTURE);
        let covered = sum(parts.iter().map(|&t| bridge::triangle(t, PICTURE)));
        prop_assert!(whole.hits == covered, "{:?}\n{:?}", parts, whole);
    }

    #[test]
    fn r7_orders_and_windings_agree(t in triangle(), area in part()) {
        let [a, b, c] = t;
        let first = bridge::triangle(t, area);
        for other in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            prop_assert!(bridge::triangle(other, area) == first);
        }
    }

    #[test]
    fn r9_coverage_is_the_exact_one(t in triangle(), area in part()) {
        compare::triangle(t, area);
    }

    #[test]
    fn r1_a_triangle_moved_by_whole_pixels(t in triangle(), d in pixel()) {
        let d = (d.0 % 8000, d.1 % 8000);
        let moved = t.map(|p| (p.0 + 256 * d.0, p.1 + 256 * d.1));
        prop_assume!(moved.iter().all(|p| p.0.abs() <= GUARD && p.1.abs() <= GUARD));
        let Area { left, top, right, bottom } = PICTURE;
        let there = Area::new(left + d.0, top + d.1, right + d.0, bottom + d.1);
        prop_assert!(bridge::triangle(moved, there).hits == bridge::triangle(t, PICTURE).hits);
    }

    #[test]
    fn l2_a_line_moved_by_whole_pixels(a in pixel(), b in pixel(), d in pixel()) {
        let moved = [a, b].map(|p| (p.0 + d.0, p.1 + d.1));
        prop_assume!(moved.iter().all(|p| p.0.abs() <= FARTHEST && p.1.abs() <= FARTHEST));
        // The limits of a scissor are 32768.
        prop_assume!(d.0.abs() < 32_700 && d.1.abs() < 32_700);
        let Area { left, top, right, bottom } = PICTURE;
        let there = Area::new(left + d.0, top + d.1, right + d.0, bottom + d.1);
        prop_assert!(bridge::line(moved[0], moved[1], there).hits == bridge::line(a, b, PICTURE).hits);
    }

    #[test]
    fn l2_and_r9_clipped_is_a_crop_of_unclipped(t in triangle(), a in pixel(), b in pixel(), area in part()) {
        for (whole, cut) in [
            (bridge::triangle(t, PICTURE), bridge::triangle(t, area)),
            (bridge::line(a, b, PICTURE), bridge::line(a, b, area)),
        ] {
            for (x, y) in area.pixels() {
                prop_assert_eq!(cut.at(x, y), whole.at(x, y));
            }
        }
    }

    #[test]
    fn l3_lines_are_the_same_both_ways(a in pixel(), b in pixel(), area in part()) {
        prop_assert!(bridge::line(a, b, area) == bridge::line(b, a, area));
        compare::line_both_ways(a, b, area);
    }
}
