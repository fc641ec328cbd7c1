//! The hidden pixels of an edge, in f64: the point of the edge is compared with every face.

use super::line;

/// A vertex on the screen: x and y in pixels, depth in steps.
pub type Vertex = [f64; 3];

/// A pixel of an edge.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub pixel: (i64, i64),
    /// How far the point of the edge lies behind the nearest face that is not adjacent to it, in depth
    /// steps; negative in front of it.
    pub behind: f64,
    /// How far it lies behind the nearest face at the pixel's center; 0 if that face is adjacent to it.
    pub behind_centre: f64,
}

fn cross(a: Vertex, b: Vertex, p: (f64, f64)) -> f64 {
    (b[0] - a[0]) * (p.1 - a[1]) - (b[1] - a[1]) * (p.0 - a[0])
}

/// The depth of a face at a point of the screen, if the face covers it.
pub fn depth([a, b, c]: [Vertex; 3], p: (f64, f64)) -> Option<f64> {
    let whole = cross(a, b, (c[0], c[1]));
    let (wa, wb, wc) = (cross(b, c, p) / whole, cross(c, a, p) / whole, cross(a, b, p) / whole);
    (whole != 0.0 && wa >= 0.0 && wb >= 0.0 && wc >= 0.0).then(|| wa * a[2] + wb * b[2] + wc * c[2])
}

/// All pixels of an edge inside the picture, each at the point of the edge that has the pixel's centre along the
/// major axis; `faces` are the faces that may hide it, by vertex indices.
pub fn samples(
    [u, v]: [u16; 2],
    vertices: &[Vertex],
    faces: &[[u16; 3]],
    width: i64,
    height: i64,
) -> Vec<Sample> {
    let (a, b) = (vertices[usize::from(u)], vertices[usize::from(v)]);
    let pixel = |p: Vertex| (p[0].floor() as i64, p[1].floor() as i64);
    let (p, q) = (pixel(a), pixel(b));
    let major = usize::from(line::is_steep(p, q));
    let beside = |face: &[u16; 3]| face.contains(&u) && face.contains(&v);
    let corners = |face: &[u16; 3]| face.map(|i| vertices[usize::from(i)]);
    // The nearest of the faces at the edge, and the nearest of all others.
    let nearest = |p: (f64, f64), of: bool| {
        let there = faces.iter().filter(|&face| beside(face) == of);
        there.filter_map(|face| depth(corners(face), p)).fold(f64::INFINITY, f64::min)
    };
    let inside = |&(x, y): &(i64, i64)| x >= 0 && y >= 0 && x < width && y < height;
    line::pixels(p, q)
        .into_iter()
        .filter(inside)
        .map(|pixel| {
            let centre = [pixel.0, pixel.1][major] as f64 + 0.5;
            let extent = b[major] - a[major];
            let t = if extent == 0.0 { 0.5 } else { ((centre - a[major]) / extent).clamp(0.0, 1.0) };
            let [x, y, z] = [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t);
            let centre = (pixel.0 as f64 + 0.5, pixel.1 as f64 + 0.5);
            let other = nearest(centre, false);
            // Nearer than a step apart, either may be the one that is seen.
            let behind_centre = if nearest(centre, true) < other + 1.0 { 0.0 } else { z - other };
            Sample { pixel, behind: z - nearest((x, y), false), behind_centre }
        })
        .collect()
}
