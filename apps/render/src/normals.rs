//! Normals at the corners of faces: smooth over round shapes, but not over sharp edges.

use std::collections::HashMap;

/// A unit normal in 2⁻¹⁵ for each corner of each triangle: the mean of the normals of the faces around the vertex that differ
/// from this face's by at most `crease` degrees, weighted by their angles at the vertex. 0 makes every face flat, 180 makes
/// all edges smooth. The normal is zero for triangles without area.
///
/// Weights: Thürmer and Wüthrich, *Computing vertex normals from polygonal facets*, 1998.
pub(crate) fn corners(vertices: &[[f64; 3]], triangles: &[[usize; 3]], crease: f64) -> Vec<[[i16; 3]; 3]> {
    let faces: Vec<[f64; 3]> = triangles.iter().map(|t| normal(t.map(|i| vertices[i]))).collect();
    let place = |index: usize| vertices[index].map(|c| (c + 0.0).to_bits());
    let mut around = HashMap::<_, Vec<(usize, f64)>>::new();
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        for [at, to, from] in [[a, b, c], [b, c, a], [c, a, b]] {
            let angle = angle(vertices[at], vertices[to], vertices[from]);
            around.entry(place(at)).or_default().push((number, angle));
        }
    }
    // A face turns by nothing from itself, roughly. Beyond 154 degrees, whatever the crease, it is the back of a face in a
    // two-sided surface, and the normal of one side must not cancel that of the other.
    let least = crease.to_radians().cos().max(-0.9) - 1e-9;
    let smooth = |number: usize, index: usize| {
        let mut sum = [0.0; 3];
        for &(other, angle) in &around[&place(index)] {
            if dot(faces[number], faces[other]) >= least {
                sum = [0, 1, 2].map(|i| sum[i] + angle * faces[other][i]);
            }
        }
        let sum = unit(sum);
        short(if sum == [0.0; 3] { faces[number] } else { sum })
    };
    triangles.iter().enumerate().map(|(number, t)| t.map(|index| smooth(number, index))).collect()
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (p, q) = (minus(b, a), minus(c, a));
    unit([(1, 2), (2, 0), (0, 1)].map(|(i, j)| p[i] * q[j] - p[j] * q[i]))
}

/// The angle at a corner, between the directions to the other two.
fn angle(at: [f64; 3], to: [f64; 3], from: [f64; 3]) -> f64 {
    dot(unit(minus(to, at)), unit(minus(from, at))).clamp(-1.0, 1.0).acos()
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Scales a vector to length 1; zero stays zero.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| if length > 0.0 { c / length } else { 0.0 })
}

fn short(v: [f64; 3]) -> [i16; 3] {
    v.map(|c| (c * 32_767.0).round() as i16)
}
