//! A1, R8: triangles on opposite sides of shared edges cover every centre in the interior of their
//! union exactly once, and on its border at most once.

use std::collections::BTreeMap;
use support::bridge;
use support::oracle::coverage::{centre, closed, edge, on_segment, Area, Counts, P};
use support::oracle::rng::Rng;

struct Partition {
    points: Vec<P>,
    triangles: Vec<[usize; 3]>,
}

impl Partition {
    fn corners(&self, t: usize) -> [P; 3] {
        self.triangles[t].map(|k| self.points[k])
    }

    /// The edges that one triangle only has.
    fn border(&self) -> Vec<(P, P)> {
        let mut uses: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for t in &self.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                *uses.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
        uses.into_iter()
            .inspect(|(e, n)| assert!(*n <= 2, "edge {e:?} is shared by {n}: no partition"))
            .filter(|&(_, n)| n == 1)
            .map(|((a, b), _)| (self.points[a], self.points[b]))
            .collect()
    }

    /// Draws every triangle, in some vertex order, and checks every centre of the area.
    fn check(&self, area: Area, rng: &mut Rng) -> (u64, u64) {
        let mut drawn = Counts::new(area);
        for t in 0..self.triangles.len() {
            let mut corners = self.corners(t);
            rng.shuffle(&mut corners);
            let counts = bridge::triangle(corners, area);
            for (d, c) in drawn.hits.iter_mut().zip(counts.hits) {
                *d += c;
            }
        }
        let border = self.border();
        let (mut inside, mut ties) = (0, 0);
        for (x, y) in area.pixels() {
            let p = centre(x, y);
            let hits = drawn.at(x, y);
            if border.iter().any(|&(a, b)| on_segment(a, b, p)) {
                ties += 1;
                assert!(hits <= 1, "({x}, {y}) on the border is hit {hits} times");
            } else if (0..self.triangles.len()).any(|t| closed(self.corners(t), p)) {
                inside += 1;
                assert_eq!(hits, 1, "({x}, {y}) inside\n{drawn:?}");
            } else {
                assert_eq!(hits, 0, "({x}, {y}) outside\n{drawn:?}");
            }
        }
        (inside, ties)
    }
}

/// The area of pixels around points, with a margin.
fn around(points: &[P]) -> Area {
    let (x, y) = (points.iter().map(|p| p.0), points.iter().map(|p| p.1));
    Area::new(
        x.clone().min().unwrap_or(0).div_euclid(256) - 1,
        y.clone().min().unwrap_or(0).div_euclid(256) - 1,
        x.max().unwrap_or(0).div_euclid(256) + 2,
        y.max().unwrap_or(0).div_euclid(256) + 2,
    )
}

/// A fan around `hub`: a blade between each two neighbours in direction. Needs every turn between
/// neighbours to be below half a turn.
fn fan(hub: P, blades: usize, radius: impl Fn(usize) -> f64) -> Partition {
    let mut points = vec![hub];
    for k in 0..blades {
        let a = core::f64::consts::TAU * k as f64 / blades as f64;
        let (s, c) = a.sin_cos();
        let r = radius(k);
        let p = (hub.0 + (r * c).round() as i64, hub.1 + (r * s).round() as i64);
        // Only strictly onwards in direction, so that blades never overlap.
        let last = points[points.len() - 1];
        if p != hub && (points.len() == 1 || edge(hub, last, p) > 0) {
            points.push(p);
        }
    }
    // The wrap-around blade must turn onwards too.
    while points.len() > 3 && edge(hub, points[points.len() - 1], points[1]) <= 0 {
        points.pop();
    }
    let n = points.len() - 1;
    Partition { triangles: (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect(), points }
}

#[test]
fn a1_fans_of_360_blades_around_a_center_are_watertight() {
    let mut rng = Rng::new(0xA11);
    for radius in [3.0, 100.0, 500.0, 2560.0, 3007.5, 8191.0] {
        for hub in [centre(0, 0), centre(-5, 7), (0, 0), (256, 128), (17, -33)] {
            let fan = fan(hub, 360, |_| radius);
            let (inside, _) = fan.check(around(&fan.points), &mut rng);
            let px = (radius / 256.0 - 1.0).max(0.0);
            assert!(inside as f64 >= 2.0 * px * px);
            if hub == centre(0, 0) {
                assert!(inside >= 1);
            }
        }
    }
}

#[test]
fn a1_jagged_fans_are_watertight() {
    let mut rng = Rng::new(0xA12);
    for k in 0..60 {
        let radii: Vec<f64> = (0..90).map(|_| rng.real(20.0, 3000.0)).collect();
        let hub = if k % 2 == 0 { centre(3, -2) } else { (rng.int(-500, 500), rng.int(-500, 500)) };
        let fan = fan(hub, 90, |k| radii[k]);
        fan.check(around(&fan.points), &mut rng);
    }
}

#[test]
fn a1_a_fan_of_2000_tiny_triangles_is_watertight() {
    let mut rng = Rng::new(0xA13);
    let fan = fan(centre(1, 1), 2000, |_| 1500.0);
    assert!(fan.triangles.len() > 1900);
    fan.check(around(&fan.points), &mut rng);
}

#[test]
fn a1_fans_at_the_guard_band_are_watertight() {
    let mut rng = Rng::new(0xA14);
    let far = 8192 * 256;
    for hub in
        [(far - 900, far - 900), (-far + 900, far - 900), (-far + 896, -far + 896), (far - 896, -far + 896)]
    {
        let fan = fan(hub, 360, |_| 890.0);
        let (inside, _) = fan.check(around(&fan.points), &mut rng);
        assert!(inside > 20);
    }
    // As large as the band allows, looked at around the hub and at the rim.
    for hub in [centre(0, 0), (0, 0), centre(-2000, 1500)] {
        let fan = fan(hub, 360, |_| f64::from(6000 * 256));
        for (x, y) in [(0, 0), (5990, 0), (-3000, 5100), (2999, 3001)] {
            let (x, y) = (x + hub.0 / 256, y + hub.1 / 256);
            fan.check(Area::new(x - 12, y - 12, x + 12, y + 12), &mut rng);
        }
    }
}

#[test]
fn a1_strips_one_pixel_wide_are_watertight() {
    let mut rng = Rng::new(0xA15);
    for k in 0..200 {
        // Two parallel rows of points, a pixel (or less) apart, in a zigzag.
        let (dx, dy) = match k % 4 {
            0 => (256, 0),
            1 => (0, 256),
            2 => (256, 256),
            _ => (rng.int(-300, 300), rng.int(-300, 300)),
        };
        if (dx, dy) == (0, 0) {
            continue;
        }
        let across = match k % 4 {
            0 => (0, 256),
            1 => (-256, 0),
            _ => {
                let n = ((dx * dx + dy * dy) as f64).sqrt();
                ((-256.0 * dy as f64 / n).round() as i64, (256.0 * dx as f64 / n).round() as i64)
            }
        };
        let start = [centre(0, 0), (0, 0), (rng.int(-999, 999), rng.int(-999, 999))][rng.below(3)];
        let n = 12;
        let points: Vec<P> = (0..=n)
            .flat_map(|i| {
                let a = (start.0 + i * dx, start.1 + i * dy);
                [a, (a.0 + across.0, a.1 + across.1)]
            })
            .collect();
        let triangles = (0..points.len() - 2).map(|i| [i, i + 1, i + 2]).collect();
        let strip = Partition { points, triangles };
        strip.check(around(&strip.points), &mut rng);
    }
}

/// Splits a triangle or an edge at random points again and again, then flips edges.
fn random_partition(rng: &mut Rng, outline: &[P], step: i64, inserts: usize) -> Partition {
    let mut points = outline.to_vec();
    let mut triangles: Vec<[usize; 3]> = (1..outline.len() - 1).map(|k| [0, k, k + 1]).collect();
    for _ in 0..inserts {
        let t = triangles[rng.below(triangles.len())];
        let [a, b, c] = t.map(|k| points[k]);
        // A random point of its bounding box, on the lattice.
        let (l, r) = (a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0));
        let (u, d) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1));
        let q = |v: i64| v.div_euclid(step) * step;
        let p = (q(rng.int(l, r)), q(rng.int(u, d)));
        if points.contains(&p) || !closed([a, b, c], p) {
            continue;
        }
        // Split every triangle that holds it (two if it lies on an edge).
        let new = points.len();
        points.push(p);
        let mut next = Vec::new();
        for t in triangles {
            let corners = t.map(|k| points[k]);
            if !closed(corners, p) {
                next.push(t);
                continue;
            }
            for k in 0..3 {
                let (i, j) = (t[k], t[(k + 1) % 3]);
                if edge(points[i], points[j], p) != 0 {
                    next.push([i, j, new]);
                }
            }
        }
        triangles = next;
    }
    // Flip the diagonal of random convex quadrilaterals: away from the history of splits.
    for _ in 0..4 * inserts {
        let (s, t) = (rng.below(triangles.len()), rng.below(triangles.len()));
        let (one, two) = (triangles[s], triangles[t]);
        let shared: Vec<usize> = one.iter().copied().filter(|k| two.contains(k)).collect();
        if s == t || shared.len() != 2 {
            continue;
        }
        let (i, j) = (shared[0], shared[1]);
        let Some(&k) = one.iter().find(|k| !shared.contains(k)) else {
            continue;
        };
        let Some(&l) = two.iter().find(|k| !shared.contains(k)) else {
            continue;
        };
        let side = |a: usize, b: usize, p: usize| edge(points[a], points[b], points[p]).signum();
        if side(k, l, i) * side(k, l, j) < 0 && side(i, j, k) * side(i, j, l) < 0 {
            triangles[s] = [k, l, i];
            triangles[t] = [k, l, j];
        }
    }
    Partition { points, triangles }
}

fn partitions(seed: u64, count: usize, step: i64) -> (u64, u64) {
    let mut rng = Rng::new(seed);
    let mut seen = (0, 0);
    for k in 0..count {
        let size = step * (4000 / step);
        let outline: Vec<P> = if k % 2 == 0 {
            vec![(0, 0), (size, 0), (size, size), (0, size)]
        } else {
            // Half a pixel off: the outline runs through centres.
            vec![(128, 128), (128 + size, 128), (128 + size, 128 + size), (128, 128 + size)]
        };
        let partition = random_partition(&mut rng, &outline, step, 25);
        let (inside, ties) = partition.check(around(&outline), &mut rng);
        seen = (seen.0 + inside, seen.1 + ties);
    }
    seen
}

#[test]
fn a1_r8_random_partitions_are_watertight() {
    assert!(partitions(0x81, 60, 1).0 > 10_000);
    // On centres and borders, and on pixel corners.
    let (inside, ties) = partitions(0x82, 60, 128);
    assert!(inside > 10_000 && ties > 500);
    partitions(0x83, 60, 256);
}

#[test]
fn a1_r8_random_partitions_of_a_huge_square_are_watertight() {
    let mut rng = Rng::new(0x84);
    let far = 8192 * 256;
    let outline = [(-far, -far), (far, -far), (far, far), (-far, far)];
    for step in [1, 128] {
        for _ in 0..25 {
            let partition = random_partition(&mut rng, &outline, step, 40);
            // Around a vertex, where many meet.
            for _ in 0..6 {
                let p = partition.points[rng.below(partition.points.len())];
                let (x, y) = (p.0.div_euclid(256), p.1.div_euclid(256));
                partition.check(Area::new(x - 5, y - 5, x + 6, y + 6), &mut rng);
            }
        }
    }
}
