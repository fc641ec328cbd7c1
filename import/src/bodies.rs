//! The bodies that parts of a surface bound, and which of them lie in which.

use crate::boxes::{flat, Bounds, Boxes};
use std::cell::OnceCell;

/// The triangles of a part, and their bounding box.
#[derive(Default)]
pub(crate) struct Body {
    triangles: Vec<[[i16; 3]; 3]>,
    low: Option<[i16; 3]>,
    high: [i16; 3],
}

impl Body {
    pub(crate) fn add(&mut self, triangle: [[i16; 3]; 3]) {
        let (mut low, mut high) = (self.low.unwrap_or(triangle[0]), self.high);
        if self.low.is_none() {
            high = triangle[0];
        }
        for vertex in triangle {
            low = [0, 1, 2].map(|axis| low[axis].min(vertex[axis]));
            high = [0, 1, 2].map(|axis| high[axis].max(vertex[axis]));
        }
        (self.low, self.high) = (Some(low), high);
        self.triangles.push(triangle);
    }

    /// The volume between the triangles and the mean of their corners, which lies in a flat sheet, too. Exactly zero where it is, for a
    /// closed body: sums are of integers.
    pub(crate) fn volume(&self) -> f64 {
        let corners = self.triangles.as_flattened();
        let sum = |axis: usize| corners.iter().map(|corner| i64::from(corner[axis])).sum::<i64>();
        let twice = [0, 1, 2].map(|axis| 2 * sum(axis) / corners.len().max(1) as i64);
        let six_tetrahedra = |triangle: &[[i16; 3]; 3]| {
            // From the mean, in half units: 17 bits, products of 51, six of them.
            let [a, b, c] = triangle.map(|v| [0, 1, 2].map(|axis| 2 * i64::from(v[axis]) - twice[axis]));
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            i128::from(a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1))
        };
        self.triangles.iter().map(six_tetrahedra).sum::<i128>() as f64 / 48.0
    }

    /// The bounding box and, as a fourth axis, the sum of its sides.
    fn bounds(&self) -> Bounds {
        let [low, high] = [self.low.unwrap_or_default(), self.high].map(|corner| corner.map(i64::from));
        let size = (0..3).map(|axis| high[axis] - low[axis]).sum();
        [low, high].map(|[x, y, z]| [x, y, z, size])
    }
}

/// Closed bodies, and in how many others each of them lies.
pub(crate) struct Nesting<'b> {
    bodies: Vec<&'b Body>,
    volumes: Vec<f64>,
    bounds: Vec<Bounds>,
    tree: Boxes,
    /// The triangles of each body, seen along z, if they were looked at.
    triangles: Vec<OnceCell<Boxes>>,
    /// In how many others each body lies, if that is known.
    depths: Vec<Option<usize>>,
}

impl<'b> Nesting<'b> {
    pub(crate) fn new(bodies: Vec<&'b Body>) -> Self {
        let bounds: Vec<_> = bodies.iter().map(|body| body.bounds()).collect();
        Self {
            volumes: bodies.iter().map(|body| body.volume().abs()).collect(),
            tree: Boxes::new(&bounds),
            triangles: bodies.iter().map(|_| OnceCell::new()).collect(),
            depths: vec![None; bodies.len()],
            bounds,
            bodies,
        }
    }

    /// In how many others a body lies: one more than the smallest body in which it lies.
    pub(crate) fn depth(&mut self, body: usize) -> usize {
        let (mut inner, mut next, mut depth) = (Vec::new(), Some(body), 0);
        while let Some(body) = next {
            if let Some(known) = self.depths[body] {
                depth = known + 1;
                break;
            }
            inner.push(body);
            next = self.around(body);
        }
        for body in inner.into_iter().rev() {
            self.depths[body] = Some(depth);
            depth += 1;
        }
        self.depths[body].unwrap_or_default()
    }

    /// The smallest body in which another one lies.
    fn around(&self, body: usize) -> Option<usize> {
        let [low, high] = self.bounds[body];
        let mut contains = |bounds: &Bounds| {
            (0..3).all(|axis| bounds[0][axis] <= low[axis] && high[axis] <= bounds[1][axis])
                && low[3] <= bounds[1][3]
        };
        let size = |body: usize| (self.bounds[body][0][3], self.volumes[body], body);
        self.tree.first(&mut contains, &mut |other| size(other) > size(body) && self.holds(other, body))
    }

    /// Whether the first vertex of a body lies in another one: by how often the surface of that winds around it, which is how
    /// often a ray from the vertex along z leaves more than it enters.
    fn holds(&self, body: usize, inner: usize) -> bool {
        let Some(&[eye, ..]) = self.bodies[inner].triangles.first() else { return false };
        let eye = eye.map(i64::from);
        let triangles = &self.bodies[body].triangles;
        let tree = self.triangles[body].get_or_init(|| {
            let of = |triangle: &[[i16; 3]; 3]| {
                let side = |axis: usize| triangle.map(|vertex| i64::from(vertex[axis]));
                let ends = |of: fn(i64, i64) -> i64| {
                    [0, 1].map(|axis| side(axis).into_iter().fold(side(axis)[0], of))
                };
                flat([ends(i64::min), ends(i64::max)])
            };
            Boxes::new(&triangles.iter().map(of).collect::<Vec<_>>())
        });
        let mut windings = 0;
        let [x, y, _] = eye;
        let [at, _] = flat([[x, y]; 2]);
        let mut meets =
            |[low, high]: &Bounds| (0..4).all(|axis| low[axis] <= at[axis] && at[axis] <= high[axis]);
        tree.first(&mut meets, &mut |triangle| {
            windings += crossing(triangles[triangle].map(|vertex| vertex.map(i64::from)), eye);
            false
        });
        windings != 0
    }
}

/// 1 if the ray from a point along z leaves the body at a triangle, −1 if it enters there, 0 if it misses. The point is moved by (ε, ε²,
/// ε³), which is less than any number, so the ray meets no edge (Edelsbrunner and Mücke, "Simulation of Simplicity", 1990).
fn crossing([a, b, c]: [[i64; 3]; 3], eye: [i64; 3]) -> i32 {
    let minus = |p: [i64; 3], q: [i64; 3]| [0, 1, 2].map(|axis| p[axis] - q[axis]);
    // Sides have 17 bits, products 34.
    let (u, v, to) = (minus(b, a), minus(c, a), minus(eye, a));
    let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]);
    let first = |terms: &[i64]| terms.iter().copied().find(|&term| term != 0).unwrap_or_default().signum();
    let side = |from: [i64; 3], to: [i64; 3]| {
        let ([x, y, _], [dx, dy, _]) = (minus(to, from), minus(eye, from));
        first(&[x * dy - y * dx, -y, x])
    };
    let up = normal[2].signum();
    // Products of 34 and 17 bits, three of them.
    let above = first(&[(0..3).map(|axis| normal[axis] * to[axis]).sum(), normal[0], normal[1], normal[2]]);
    let is_hit =
        up != 0 && above == -up && [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| side(from, to) == up);
    i32::from(is_hit) * up as i32
}

#[cfg(test)]
mod tests {
    use super::{Body, Nesting};

    /// An octahedron, of which no face is along an axis, or turned inside out.
    fn octahedron([x, y, z]: [i16; 3], radius: i16, is_outward: bool) -> Body {
        let mut body = Body::default();
        for octant in 0..8 {
            let sign = [0, 1, 2].map(|axis| if octant >> axis & 1 == 1 { radius } else { -radius });
            let corners = [[x + sign[0], y, z], [x, y + sign[1], z], [x, y, z + sign[2]]];
            let is_even = (octant as u32).count_ones() % 2 == 1;
            let [a, b, c] = corners;
            body.add(if is_even == is_outward { [a, b, c] } else { [a, c, b] });
        }
        body
    }

    /// Looks at boxes.
    fn looks(nesting: &Nesting<'_>) -> usize {
        let of_triangles =
            nesting.triangles.iter().filter_map(|tree| tree.get()).map(|tree| tree.looks.get());
        nesting.tree.looks.get() + of_triangles.sum::<usize>()
    }

    #[test]
    fn bodies_lie_in_as_many_others_as_were_put_around_them() {
        // Shells in shells, of which each has another one beside it, whose bounding box reaches into it.
        let radius = |shell: usize| 4000 >> shell;
        let mut bodies = Vec::new();
        let mut wanted = Vec::new();
        for shell in 0..9 {
            bodies.push(octahedron([100, -200, 300], radius(shell), shell % 2 == 0));
            wanted.push(shell);
            let off = radius(shell) * 2 / 5;
            bodies.push(octahedron([100 + off, -200 + off, 300 + off], radius(shell) / 8, true));
            wanted.push(shell);
        }
        assert!((octahedron([0; 3], 3, true).volume() - 36.0).abs() < 1e-9);
        let mut nesting = Nesting::new(bodies.iter().collect());
        let found: Vec<usize> = (0..bodies.len()).map(|body| nesting.depth(body)).collect();
        assert_eq!(found, wanted);
    }

    #[test]
    fn looks_grow_no_faster_than_the_bodies_and_the_height_of_a_tree() {
        let nested: fn(usize) -> Body = |i| octahedron([0; 3], 1 + i as i16, i % 2 == 0);
        let beside: fn(usize) -> Body =
            |i| octahedron([40 * (i % 32) as i16, 40 * (i / 32) as i16, 7], 5, false);
        let in_one: fn(usize) -> Body = |i| match i {
            0 => octahedron([600; 3], 20_000, true),
            _ => octahedron([40 * (i % 32) as i16, 40 * (i / 32) as i16, 7], 5, false),
        };
        for (body, depth) in [(nested, None), (beside, Some(0)), (in_one, Some(1))] {
            for count in [250, 1000, 4000] {
                let bodies: Vec<Body> = (0..count).map(body).collect();
                let mut nesting = Nesting::new(bodies.iter().collect());
                for i in 1..count {
                    assert_eq!(nesting.depth(i), depth.unwrap_or(count - 1 - i), "{i} of {count}");
                }
                let most = 8 * count * count.ilog2() as usize;
                assert!(looks(&nesting) < most, "{} of {count}", looks(&nesting));
            }
        }
    }
}
