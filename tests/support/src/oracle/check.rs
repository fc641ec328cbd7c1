//! The oracles are checked by cases worked out by hand and by second derivations.

use super::cases::{self, CLASSES};
use super::chain::{fx, Affine};
use super::coverage::{covers, rows, Area};
use super::line;
use super::rng::Rng;

#[test]
fn coverage_by_steps_equals_coverage_by_edges() {
    let mut rng = Rng::new(2);
    for class in CLASSES {
        for _ in 0..2000 {
            let t = cases::triangle(&mut rng, class);
            for area in [cases::window(&mut rng, &t, 9), cases::window(&mut rng, &t, 64)] {
                let steps = rows(t, area);
                for (x, y) in (Area { bottom: area.top + 9, ..area }).pixels() {
                    let row = steps[(y - area.top) as usize];
                    assert_eq!(
                        row >> (x - area.left) & 1 == 1,
                        covers(t, x, y),
                        "{class:?} {t:?} ({x}, {y})"
                    );
                }
            }
        }
    }
}

#[test]
fn line_ties_by_hand() {
    assert_eq!(line::pixels((0, 0), (2, 1)), [(0, 0), (1, 0), (2, 1)]);
    assert_eq!(line::pixels((2, 1), (0, 0)), [(0, 0), (1, 0), (2, 1)]);
    assert_eq!(line::pixels((0, 1), (2, 0)), [(0, 1), (1, 1), (2, 0)]);
    assert_eq!(line::pixels((0, 0), (1, 2)), [(0, 0), (0, 1), (1, 2)]);
    // Downwards in x is the same pair of ends as upwards: the tie stays with the smaller x.
    assert_eq!(line::pixels((1, 0), (0, 2)), [(0, 2), (0, 1), (1, 0)]);
    assert_eq!(line::pixels((5, 5), (5, 5)), [(5, 5)]);
    assert_eq!(line::runs((0, 0), (2, 1), &line::pixels((0, 0), (2, 1))), 2);
}

#[test]
fn a_clipped_line_is_the_line_cut() {
    let mut rng = Rng::new(4);
    for _ in 0..20_000 {
        let mut p = || (rng.int(-30, 30), rng.int(-30, 30));
        let (a, b) = (p(), p());
        let (x, y) = p();
        let area = Area::new(x, y, x + rng.int(0, 30), y + rng.int(0, 30));
        let cut: Vec<_> = line::pixels(a, b).into_iter().filter(|&(x, y)| area.contains(x, y)).collect();
        assert_eq!(line::clipped(a, b, area), cut, "{a:?} {b:?} {area:?}");
    }
}

#[test]
fn line_equals_the_midpoint_algorithm() {
    // docs/spec.md, section 7: d₀ = 2dy − dx; E adds 2dy, NE adds 2(dy − dx); d ≤ 0 chooses E. First octant.
    for dx in 0i64..70 {
        for dy in 0..=dx {
            let (mut d, mut y, mut pixels) = (2 * dy - dx, 0, vec![]);
            for x in 0..=dx {
                pixels.push((x, y));
                if d <= 0 {
                    d += 2 * dy;
                } else {
                    d += 2 * (dy - dx);
                    y += 1;
                }
            }
            assert_eq!(line::pixels((0, 0), (dx, dy)), pixels);
        }
    }
}

#[test]
fn then_reads_left_to_right() {
    let a = Affine::rotation_z(1 << 30);
    let b = Affine::translation([65536, 0, 0]);
    assert_eq!(a.then(&b).apply([1.0, 0.0, 0.0]), [1.0, 1.0, 0.0]);
    assert_eq!(b.then(&a).apply([1.0, 0.0, 0.0]), [0.0, 2.0, 0.0]);
    assert_eq!(fx(-65536), -1.0);
}
