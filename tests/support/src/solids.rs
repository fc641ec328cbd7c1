//! Solids: convex ones, ones with holes, and scenes of several bodies.

use crate::bridge::draw::{CUBE, CUBE_FACES};
use crate::oracle::chain::{cross, dot, normalise};
use crate::oracle::rng::Rng;
use core::f64::consts::TAU;
use std::collections::BTreeMap;

/// A solid whose edges are drawn.
pub struct Solid {
    pub vertices: Vec<[i16; 3]>,
    pub exponent: i8,
    pub faces: Vec<[u16; 3]>,
    pub edges: Vec<[u16; 2]>,
}

type Faces = Vec<[u16; 3]>;

impl Solid {
    /// A solid with all edges of its faces.
    pub fn new(vertices: Vec<[i16; 3]>, exponent: i8, faces: Faces) -> Self {
        let edges = beside(&faces).into_keys().collect();
        Self { vertices, exponent, faces, edges }
    }

    /// A solid without the edges inside flat surfaces.
    fn with_creases(vertices: Vec<[i16; 3]>, faces: Faces) -> Self {
        let normal = |face: u16| Self::normal(&vertices, faces[usize::from(face)]);
        let is_flat = |faces: &[u16]| matches!(*faces, [a, b] if dot(normal(a), normal(b)) > 0.9999);
        let edges = beside(&faces).into_iter().filter(|(_, faces)| !is_flat(faces)).map(|(edge, _)| edge);
        let edges = edges.collect();
        Self { vertices, exponent: -13, faces, edges }
    }

    /// The unit normal of a face.
    fn normal(vertices: &[[i16; 3]], face: [u16; 3]) -> [f64; 3] {
        let [a, b, c] = face.map(|i| vertices[usize::from(i)].map(f64::from));
        let way = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] - a[i]);
        normalise(cross(way(b), way(c)))
    }

    /// The normals of all faces, in 2⁻¹⁵.
    pub fn normals(&self) -> Vec<[i16; 3]> {
        let normal = |&face| Self::normal(&self.vertices, face).map(|c| (c * 32_767.0).round() as i16);
        self.faces.iter().map(normal).collect()
    }

    /// The faces adjacent to each edge, by a map instead of the library's search.
    pub fn edge_faces(&self) -> Vec<[u16; 2]> {
        let beside = beside(&self.faces);
        // An edge that is listed again gets the next two faces.
        let mut listed = BTreeMap::<[u16; 2], usize>::new();
        let pair = |edge: &[u16; 2]| {
            let times = listed.entry(*edge).or_default();
            *times += 2;
            [*times - 2, *times - 1].map(|i| beside[edge].get(i).copied().unwrap_or(u16::MAX))
        };
        self.edges.iter().map(pair).collect()
    }
}

/// The faces that have each edge, by its vertices.
pub fn beside(faces: &[[u16; 3]]) -> BTreeMap<[u16; 2], Vec<u16>> {
    let mut beside = BTreeMap::<[u16; 2], Vec<u16>>::new();
    for (number, &[a, b, c]) in faces.iter().enumerate() {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            beside.entry([a.min(b), a.max(b)]).or_default().push(number as u16);
        }
    }
    beside
}

fn turned(i: u16, n: u16, radius: f64, y: f64) -> [i16; 3] {
    let (s, c) = (f64::from(i) / f64::from(n) * TAU).sin_cos();
    [radius * c, y, -radius * s].map(|v| v as i16)
}

pub fn cube() -> Solid {
    blocks(&[([0.0; 3], [16_384.0; 3])])
}

/// Boxes, each by its centre and half its sides.
pub fn blocks(all: &[([f64; 3], [f64; 3])]) -> Solid {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (centre, half) in all {
        let first = vertices.len() as u16;
        vertices.extend(CUBE.map(|v| [0, 1, 2].map(|i| (centre[i] + half[i] * f64::from(v[i])) as i16)));
        faces.extend(CUBE_FACES.map(|face| face.map(|i| first + i)));
    }
    Solid::with_creases(vertices, faces)
}

/// A box of any sides.
pub fn block(rng: &mut Rng) -> Solid {
    blocks(&[([0.0; 3], [0; 3].map(|_| rng.real(800.0, 14_000.0)))])
}

/// The convex hull of points on a sphere, by trying all triples.
pub fn hull(rng: &mut Rng, count: usize) -> Solid {
    loop {
        let points: Vec<_> = (0..count).map(|_| rng.direction().map(|c| (c * 14_000.0) as i16)).collect();
        let way =
            |from: usize, to: usize| [0, 1, 2].map(|i| i64::from(points[to][i]) - i64::from(points[from][i]));
        let is_face = |&[i, j, k]: &[usize; 3]| {
            let (u, v) = (way(i, j), way(i, k));
            let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let is_behind = |m| (0..3).map(|axis| normal[axis] * way(i, m)[axis]).sum::<i64>() < 0;
            i < j && i < k && j != k && (0..count).all(|m| [i, j, k].contains(&m) || is_behind(m))
        };
        let triples = (0..count.pow(3)).map(|t| [t / (count * count), t / count % count, t % count]);
        let faces: Faces = triples.filter(is_face).map(|face| face.map(|i| i as u16)).collect();
        // No four in a plane: a closed hull of V corners has 2·V − 4 faces.
        if faces.len() == 2 * count - 4 {
            return Solid::with_creases(points, faces);
        }
    }
}

/// A prism or a frustum; its caps are fans of slender triangles.
pub fn prism(rng: &mut Rng) -> Solid {
    let n = rng.int(3, 24) as u16;
    let (radius, height) = (rng.real(2_000.0, 14_000.0), rng.real(1_000.0, 14_000.0));
    let top = radius * [1.0, 0.5][rng.below(2)];
    let mut vertices: Vec<_> = (0..n).map(|i| turned(i, n, radius, -height)).collect();
    vertices.extend((0..n).map(|i| turned(i, n, top, height)));
    let mut faces = Vec::new();
    for i in 0..n {
        let next = (i + 1) % n;
        faces.extend([[i, next, n + next], [i, n + next, n + i]]);
    }
    for i in 1..n - 1 {
        faces.extend([[0, i + 1, i], [n, n + i, n + i + 1]]);
    }
    Solid::with_creases(vertices, faces)
}

pub fn torus(around: u16, across: u16) -> Solid {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for i in 0..around {
        for j in 0..across {
            let (t, d) = (f64::from(j) / f64::from(across) * TAU).sin_cos();
            vertices.push(turned(i, around, 16_000.0 + 7_000.0 * d, 7_000.0 * t));
            let at = |i: u16, j: u16| (i % around) * across + j % across;
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    Solid::new(vertices, -13, faces)
}

/// A gear of nine teeth with a hole.
pub fn gear() -> Solid {
    const N: u16 = 36;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for y in [-4_000.0, 4_000.0] {
        vertices.extend((0..N).map(|i| turned(i, N, 8_000.0, y)));
        vertices.extend((0..N).map(|i| turned(i, N, if i % 4 < 2 { 20_000.0 } else { 15_000.0 }, y)));
    }
    let mut quad = |[a, b, c, d]: [u16; 4]| faces.extend([[a, b, c], [a, c, d]]);
    for i in 0..N {
        let [[hole, hole_top], [rim, rim_top]] =
            [[0, 2 * N], [N, 3 * N]].map(|at| at.map(|at| [at + i, at + (i + 1) % N]));
        quad([rim[0], rim[1], rim_top[1], rim_top[0]]);
        quad([hole[1], hole[0], hole_top[0], hole_top[1]]);
        quad([hole_top[0], rim_top[0], rim_top[1], hole_top[1]]);
        quad([hole[1], rim[1], rim[0], hole[0]]);
    }
    Solid::with_creases(vertices, faces)
}

/// Houses among fences.
pub fn village(rng: &mut Rng) -> Solid {
    let mut all: Vec<_> = (0..8)
        .map(|_| {
            let half = [0; 3].map(|_| rng.real(1_000.0, 4_000.0));
            ([rng.real(-20_000.0, 20_000.0), half[1] - 8_000.0, rng.real(-20_000.0, 20_000.0)], half)
        })
        .collect();
    for i in 0..24 {
        let along = f64::from(i) * 1_900.0 - 22_000.0;
        let post = [250.0, 1_500.0, 250.0];
        all.extend([([along, -6_500.0, 14_000.0], post), ([14_000.0, -6_500.0, along], post)]);
    }
    blocks(&all)
}

/// A house with a roof, a chimney, windows, a fence, a mast and a tree, on a meadow.
pub fn house() -> Solid {
    const UNIT: f64 = 6_000.0;
    let mut all = vec![
        ([-4.0, -0.05, -4.0], [3.0, 0.0, 3.0]),
        ([-1.2, 0.0, -0.8], [1.2, 1.2, 0.8]),
        ([0.4, 1.3, -0.35], [0.7, 2.4, -0.05]),
        ([-0.2, 0.0, 0.8], [0.2, 0.75, 0.84]),
        ([-0.95, 0.45, 0.8], [-0.5, 0.85, 0.83]),
        ([0.5, 0.45, 0.8], [0.95, 0.85, 0.83]),
        ([-2.7, 0.3, 2.21], [2.5, 0.36, 2.26]),
        ([2.0, 0.0, -1.3], [2.06, 3.0, -1.24]),
        ([-2.3, 0.0, -0.1], [-2.15, 1.0, 0.05]),
        ([-2.7, 0.9, -0.5], [-1.75, 1.9, 0.45]),
    ];
    all.extend(
        (0..9).map(|post| -2.6 + 0.62 * f64::from(post)).map(|x| ([x, 0.0, 2.2], [x + 0.07, 0.45, 2.27])),
    );
    let lowered = |[x, y, z]: [f64; 3]| [x, y - 0.55, z].map(|c| c * UNIT);
    let boxes = all.into_iter().map(|(low, high)| {
        let (low, high) = (lowered(low), lowered(high));
        ([0, 1, 2].map(|i| (low[i] + high[i]) / 2.0), [0, 1, 2].map(|i| (high[i] - low[i]) / 2.0))
    });
    let Solid { mut vertices, mut faces, .. } = blocks(&boxes.collect::<Vec<_>>());
    // The roof: two eaves and a ridge.
    let first = vertices.len() as u16;
    for x in [-1.3, 1.3] {
        let corners = [[x, 1.15, 0.95], [x, 1.15, -0.95], [x, 2.0, 0.0]];
        vertices.extend(corners.map(|corner| lowered(corner).map(|c| c as i16)));
    }
    let roof = [[0, 2, 1], [3, 4, 5], [0, 3, 5], [0, 5, 2], [4, 1, 2], [4, 2, 5], [1, 4, 3], [1, 3, 0]];
    faces.extend(roof.map(|face| face.map(|corner| first + corner)));
    Solid { exponent: -12, ..Solid::with_creases(vertices, faces) }
}

/// Three boxes through each other.
pub fn crossing(rng: &mut Rng) -> Solid {
    let mut block = || {
        let centre = [0; 3].map(|_| rng.real(-6_000.0, 6_000.0));
        (centre, [0; 3].map(|_| rng.real(2_000.0, 14_000.0)))
    };
    blocks(&[block(), block(), block()])
}

pub fn pot() -> Solid {
    Solid::new(teapot::VERTICES.to_vec(), teapot::EXPONENT - 2, teapot::FACES.to_vec())
}

/// Slender tetrahedra through each other.
pub fn splinters(rng: &mut Rng) -> Solid {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for _ in 0..25 {
        let first = vertices.len() as u16;
        let at = [0; 3].map(|_| rng.real(-12_000.0, 12_000.0));
        let mut corners = [0; 4].map(|_| [0, 1, 2].map(|i| (at[i] + rng.real(-9_000.0, 9_000.0)) as i16));
        let way = |i: usize, k: usize| f64::from(corners[i][k]) - f64::from(corners[0][k]);
        let [p, q, r] = [1, 2, 3].map(|i| [0, 1, 2].map(|k| way(i, k)));
        if dot(cross(p, q), r) < 0.0 {
            corners.swap(1, 2);
        }
        vertices.extend(corners);
        // Outwards where the fourth lies on the positive side of the first three.
        faces.extend([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|f| f.map(|i| first + i)));
    }
    Solid::new(vertices, -13, faces)
}
