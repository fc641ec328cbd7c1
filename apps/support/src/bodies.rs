//! Bodies for tests: closed surfaces of triangles, and the files that they come in.

use std::f64::consts::TAU;
use std::fmt::Write;

/// Triangles of a body: the corners of each, counter-clockwise seen from outside.
pub type Body = Vec<[[f64; 3]; 3]>;

/// A prism over a polygon in x and y with a hole of the same number of corners, from 0 to `height`: its walls, and the rings
/// between them.
pub fn prism(outline: &[[f64; 2]], hole: &[[f64; 2]], height: f64) -> Body {
    let mut body = Body::new();
    let mut quad = |a, b, c, d| body.extend([[a, b, c], [a, c, d]]);
    let n = outline.len().min(hole.len());
    for i in 0..n {
        let j = (i + 1) % n;
        let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
        quad(at(outline[i], 0.0), at(outline[j], 0.0), at(outline[j], height), at(outline[i], height));
        quad(at(hole[j], 0.0), at(hole[i], 0.0), at(hole[i], height), at(hole[j], height));
        quad(at(outline[i], height), at(outline[j], height), at(hole[j], height), at(hole[i], height));
        quad(at(outline[j], 0.0), at(outline[i], 0.0), at(hole[i], 0.0), at(hole[j], 0.0));
    }
    body
}

/// Corners on a circle, each at a radius of its own.
pub fn circle(corners: usize, radius: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    let at = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / corners as f64).sin_cos();
        [radius(i) * cos, radius(i) * sin]
    };
    (0..corners).map(at).collect()
}

/// A gear with a hole, 300 mm wide and 60 mm high along z.
pub fn gear() -> Body {
    let teeth = |i: usize| if i % 4 < 2 { 150.0 } else { 120.0 };
    prism(&circle(32, teeth), &circle(32, |_| 50.0), 60.0)
}

/// A torus about z.
pub fn torus(radius: f64, tube: f64, steps: usize, sides: usize) -> Body {
    let (mut body, line) = (Body::new(), circle(sides, |_| tube));
    let at = |side: usize, step: usize| {
        let (sin, cos) = (TAU * (step % steps) as f64 / steps as f64).sin_cos();
        let [away, z] = line[side % sides];
        [(radius + away) * cos, (radius + away) * sin, z]
    };
    for (side, step) in (0..sides).flat_map(|side| (0..steps).map(move |step| (side, step))) {
        let [a, b] = [at(side, step), at(side, step + 1)];
        let [c, d] = [at(side + 1, step + 1), at(side + 1, step)];
        body.extend([[a, b, c], [a, c, d]]);
    }
    body
}

/// A box from the origin.
pub fn cuboid([a, b, c]: [f64; 3]) -> Body {
    let at = |i: usize| [a * (i & 1) as f64, b * (i >> 1 & 1) as f64, c * (i >> 2) as f64];
    let sides = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
    sides.iter().flat_map(|&[p, q, r, s]| [[p, q, r], [p, r, s]]).map(|t| t.map(at)).collect()
}

/// The body with each of its points moved by `to`.
pub fn moved(body: &[[[f64; 3]; 3]], to: impl Fn([f64; 3]) -> [f64; 3]) -> Body {
    body.iter().map(|corners| corners.map(&to)).collect()
}

/// The body inside out.
pub fn reversed(body: &[[[f64; 3]; 3]]) -> Body {
    body.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

/// A binary STL file.
pub fn stl(body: &[[[f64; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((body.len() as u32).to_le_bytes());
    for corners in body {
        bytes.extend([0; 12]);
        bytes.extend(corners.iter().flatten().flat_map(|&c| (c as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// An OBJ file, each triangle with corners of its own.
pub fn obj(body: &[[[f64; 3]; 3]]) -> String {
    let mut text = String::new();
    for corners in body {
        for [x, y, z] in corners {
            let _ = writeln!(text, "v {x} {y} {z}"); // text takes all
        }
        text += "f -3 -2 -1\n";
    }
    text
}
