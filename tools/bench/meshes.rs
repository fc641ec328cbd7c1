//! Meshes of any number of triangles, for measuring growth with the size: `build.rs` makes constants of them.

/// Vertices and faces, counter-clockwise from outside.
pub(crate) type Shape = (Vec<[f64; 3]>, Vec<[u16; 3]>);

/// A tube of radius 0.4 round a circle of radius 1: `2·around·across` triangles.
fn torus(around: u16, across: u16) -> Shape {
    let at = |i: u16, j: u16| {
        let ((s, c), (t, d)) = (turn(i, around), turn(j, across));
        [(1.0 + 0.4 * d) * c, (1.0 + 0.4 * d) * s, 0.4 * t]
    };
    let (vertices, index) = (grid(around, across, at), |i: u16, j: u16| i % around * across + j % across);
    (vertices, quads(around, across, index))
}

/// A sphere of radius 1: `2·around·(down − 1)` triangles.
fn sphere(around: u16, down: u16) -> Shape {
    let ring = |i: u16, j: u16| {
        let ((s, c), polar) = (turn(i, around), f64::from(j + 1) / f64::from(down) * std::f64::consts::PI);
        [polar.sin() * c, polar.sin() * s, polar.cos()]
    };
    let rings = down - 1;
    let mut vertices = grid(around, rings, ring);
    let (north, south) = (around * rings, around * rings + 1);
    vertices.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let index = |i: u16, j: u16| i % around * rings + j;
    // Down the ring, i × j points inwards: the other way round.
    let mut faces: Vec<_> = quads(around, rings - 1, index).into_iter().map(|[a, b, c]| [a, c, b]).collect();
    for i in 0..around {
        faces.push([north, index(i, 0), index(i + 1, 0)]);
        faces.push([south, index(i + 1, rings - 1), index(i, rings - 1)]);
    }
    (vertices, faces)
}

/// Land with hills, 4 by 4 and open, y up: `2·side²` triangles.
fn sheet(side: u16) -> Shape {
    let at = |i: u16, j: u16| {
        let [x, z] = [i, j].map(|i| f64::from(i) / f64::from(side) * 4.0 - 2.0);
        [x, 0.2 * (3.0 * x).sin() * (2.5 * z).cos() - 0.5, z]
    };
    let index = |i: u16, j: u16| i * (side + 1) + j;
    let faces = quads(side, side, index).into_iter().map(|[a, b, c]| [a, c, b]).collect();
    (grid(side + 1, side + 1, at), faces)
}

/// A corner, the two sides of a field at it, and the numbers of fields along them.
pub(crate) type Side = ([f64; 3], [f64; 3], [f64; 3], [u16; 2]);

/// Flat sides, each with vertices of its own: two triangles for each field.
pub(crate) fn sided(sides: &[Side]) -> Shape {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (from, u, v, [m, n]) in sides {
        let first = vertices.len() as u16;
        let at = |i: u16, j: u16| [0, 1, 2].map(|c| from[c] + f64::from(i) * u[c] + f64::from(j) * v[c]);
        vertices.extend(grid(m + 1, n + 1, at));
        faces.extend(quads(*m, *n, |i, j| first + i * (n + 1) + j));
    }
    (vertices, faces)
}

fn grid<T>(m: u16, n: u16, at: impl Fn(u16, u16) -> T) -> Vec<T> {
    (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| at(i, j)).collect()
}

/// Any of these shapes, by its name.
pub(crate) fn named(kind: &str, [m, n]: [u16; 2]) -> Option<Shape> {
    Some(match kind {
        "torus" => torus(m, n),
        "sphere" => sphere(m, n),
        "sheet" => sheet(m),
        _ => return None,
    })
}

/// Two triangles for each field, with i × j to the front.
pub(crate) fn quads<T: Copy>(m: u16, n: u16, index: impl Fn(u16, u16) -> T) -> Vec<[T; 3]> {
    let field = |(i, j): (u16, u16)| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).flat_map(field).collect()
}

/// Sine and cosine of a part of a turn.
fn turn(i: u16, of: u16) -> (f64, f64) {
    (f64::from(i) / f64::from(of) * std::f64::consts::TAU).sin_cos()
}
