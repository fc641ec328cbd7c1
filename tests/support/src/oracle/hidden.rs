//! The hidden pixels of an edge, in f64: the point of the edge is compared with every face.

use super::line;

/// A vertex on the screen: x and y in pixels, depth in steps.
pub type Vertex = [f64; 3];

fn cross(a: Vertex, b: Vertex, p: (f64, f64)) -> f64 {
    (b[0] - a[0]) * (p.1 - a[1]) - (b[1] - a[1]) * (p.0 - a[0])
}

/// The depth of a face at a point of the screen, if the face covers it.
pub fn depth([a, b, c]: [Vertex; 3], p: (f64, f64)) -> Option<f64> {
    let whole = cross(a, b, (c[0], c[1]));
    let (wa, wb, wc) = (cross(b, c, p) / whole, cross(c, a, p) / whole, cross(a, b, p) / whole);
    (whole != 0.0 && wa >= 0.0 && wb >= 0.0 && wc >= 0.0).then(|| wa * a[2] + wb * b[2] + wc * c[2])
}

/// A face with the box around it.
pub struct Face {
    indices: [u16; 3],
    corners: [Vertex; 3],
    least: Vertex,
    most: Vertex,
}

/// The front faces of a mesh, with the exact positions of its vertices.
pub fn front_faces(faces: &[[u16; 3]], vertices: &[Vertex]) -> Vec<Face> {
    let faces = faces.iter().map(|&indices| {
        let corners = indices.map(|index| vertices[usize::from(index)]);
        let bound = |by: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|i| corners.map(|c| c[i]).into_iter().reduce(by).unwrap())
        };
        Face { indices, corners, least: bound(f64::min), most: bound(f64::max) }
    });
    faces.filter(|&Face { corners: [a, b, c], .. }| cross(a, b, (c[0], c[1])) < 0.0).collect()
    // y down
}

impl Face {
    /// Whether the face has these two corners.
    pub fn has_edge(&self, edge: [u16; 2]) -> bool {
        edge.iter().all(|end| self.indices.contains(end))
    }

    /// Whether the face lies before a point of the screen, by more than the errors of this computation.
    fn hides(&self, [x, y, z]: Vertex) -> bool {
        let [least, most] = [self.least, self.most];
        let is_near = z > least[2] + ERROR && x >= least[0] && x <= most[0] && y >= least[1] && y <= most[1];
        is_near && depth(self.corners, (x, y)).is_some_and(|depth| z > depth + ERROR)
    }
}

/// Positions have errors of 2⁻³² of a pixel and of a step, and faces may be steep.
const ERROR: f64 = 0.02;

/// Whether an edge is in sight in each of its pixels: at the point of the edge that has the pixel's centre along the major axis,
/// no face but those beside the edge lies before it.
pub fn in_sight(edge: [u16; 2], pixels: &[(i64, i64)], vertices: &[Vertex], faces: &[Face]) -> Vec<bool> {
    let [a, b] = edge.map(|index| vertices[usize::from(index)]);
    let (Some(&first), Some(&last)) = (pixels.first(), pixels.last()) else { return Vec::new() };
    let major = usize::from(line::is_steep(first, last));
    let point = |pixel: &(i64, i64)| {
        let centre = [pixel.0, pixel.1][major] as f64 + 0.5;
        let extent = b[major] - a[major];
        let t = if extent == 0.0 { 0.5 } else { ((centre - a[major]) / extent).clamp(0.0, 1.0) };
        [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t)
    };
    let is_seen = |at: Vertex| !faces.iter().any(|face| face.hides(at) && !face.has_edge(edge));
    pixels.iter().map(|pixel| is_seen(point(pixel))).collect()
}
