//! A1, R8: triangles on opposite sides of shared edges cover every centre in the interior of their union exactly once.

use support::bridge;
use support::oracle::coverage::{centre, edge, Area, Counts, P};
use support::oracle::rng::Rng;

/// A square of n × n cells whose corners are moved about, on a lattice; each cell is cut along either diagonal. From the outline inwards
/// every centre is covered once, and outside of it none; on the outline at most once.
fn check(rng: &mut Rng, n: i64, side: i64, step: i64, origin: P, windows: &[Area]) -> (u64, u64) {
    let cell = side / n;
    let mut points = Vec::new();
    for (row, column) in (0..=n).flat_map(|row| (0..=n).map(move |column| (row, column))) {
        let mut at = |k: i64| {
            // Corners of a cell stay apart, so that it is convex.
            let slip = if k == 0 || k == n { 0 } else { rng.int(-cell / 5, cell / 5) / step * step };
            k * cell + slip
        };
        points.push((origin.0 + at(column), origin.1 + at(row)));
    }
    let corner = |row: i64, column: i64| points[(row * (n + 1) + column) as usize];
    let mut triangles = Vec::new();
    for (row, column) in (0..n).flat_map(|row| (0..n).map(move |column| (row, column))) {
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(y, x)| corner(row + y, column + x));
        let mut pair = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]][rng.below(2)];
        assert!(pair.iter().all(|t| edge(t[0], t[1], t[2]) > 0), "no partition");
        pair.iter_mut().for_each(|t| rng.shuffle(t));
        triangles.extend(pair);
    }
    let (mut inside, mut border) = (0, 0);
    for &area in windows {
        let mut drawn = Counts::new(area);
        for &t in &triangles {
            drawn.hits.iter_mut().zip(bridge::triangle(t, area).hits).for_each(|(sum, hit)| *sum += hit);
        }
        for (x, y) in area.pixels() {
            let (p, hits) = (centre(x, y), drawn.at(x, y));
            let [u, v] = [p.0 - origin.0, p.1 - origin.1].map(|c| c.min(n * cell - c));
            match u.min(v) {
                1.. => assert_eq!(hits, 1, "({x}, {y})\n{drawn:?}"),
                0 => assert!(hits <= 1, "({x}, {y}) on the outline is hit {hits} times"),
                _ => assert_eq!(hits, 0, "({x}, {y})\n{drawn:?}"),
            }
            (inside, border) = (inside + u64::from(u.min(v) > 0), border + u64::from(u.min(v) == 0));
        }
    }
    (inside, border)
}

#[test]
fn a1_r8_partitions_are_watertight() {
    let mut rng = Rng::new(0x81);
    // Any corners, corners on centres and borders of pixels, and on pixel corners; the outline runs through centres or pixel corners.
    for step in [1, 128, 256] {
        for origin in [(0, 0), (128, 128), (8191 * 256 - 4800, -8192 * 256)] {
            let (x, y) = (origin.0 / 256, origin.1 / 256);
            let mut seen = (0, 0);
            // From triangles of a few sub-pixels to triangles of several pixels.
            for n in [1, 2, 3, 7, 60] {
                for _ in 0..6 {
                    let window = Area::new(x - 1, y - 1, x + 21, y + 21);
                    let (inside, border) = check(&mut rng, n, 4800, step, origin, &[window]);
                    seen = (seen.0 + inside, seen.1 + border);
                }
            }
            assert!(seen.0 > 8000 && (seen.1 > 500 || origin != (128, 128)), "{seen:?}");
        }
    }
}

/// As large as the guard band, about its corners, its middle and anywhere.
#[test]
fn a1_r8_partitions_of_a_huge_square_are_watertight() {
    let (mut rng, far) = (Rng::new(0x84), 8192);
    for step in [1, 128] {
        for n in [1, 2, 3, 7] {
            let mut windows = vec![];
            for _ in 0..12 {
                let [x, y] = [0; 2].map(|_| [-far, 0, far - 11, rng.int(-far, far - 11)][rng.below(4)]);
                windows.push(Area::new(x, y, x + 11, y + 11));
            }
            check(&mut rng, n, 2 * far * 256, step, (-far * 256, -far * 256), &windows);
        }
    }
}
