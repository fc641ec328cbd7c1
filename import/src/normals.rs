//! Normals of faces and vertices, from vertices on the grid.

/// `(b − a) × (c − a)`, exactly: differences have 17 bits, products 34.
pub(crate) fn cross([a, b, c]: [[i16; 3]; 3]) -> [i64; 3] {
    let d = |p: [i16; 3], axis: usize| i64::from(p[axis]) - i64::from(a[axis]);
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| d(b, i) * d(c, j) - d(b, j) * d(c, i))
}

/// Whether three points lie on one line, as far as f64 tells: where it does not, they may as well.
pub(crate) fn on_one_line([a, b, c]: [[f64; 3]; 3]) -> bool {
    let side = |to: [f64; 3]| about_one([0, 1, 2].map(|axis| to[axis] - a[axis]));
    let (u, v) = (side(b), side(c));
    [(1, 2), (2, 0), (0, 1)].iter().all(|&(i, j)| u[i] * v[j] == u[j] * v[i])
}

/// The vector times a power of two, so that products of such are too small for f64 only where they do not count.
fn about_one(vector: [f64; 3]) -> [f64; 3] {
    let largest = vector.iter().fold(0.0f64, |largest, c| c.abs().max(largest));
    // Without its mantissa; what is too small to be divided by stays.
    let power = f64::from_bits(largest.to_bits() & f64::INFINITY.to_bits());
    vector.map(|c| if power.is_normal() { c / power } else { c })
}

/// The angle between two vectors that are not zero, in degrees: exact where it is 0, 90 or 180.
pub(crate) fn turn(a: [i64; 3], b: [i64; 3]) -> f64 {
    // 35 bits each: products of 70, three of them.
    let [a, b] = [a, b].map(|v| v.map(i128::from));
    let along: i128 = (0..3).map(|i| a[i] * b[i]).sum();
    let across = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| (a[i] * b[j] - a[j] * b[i]) as f64);
    length(across).atan2(along as f64).to_degrees()
}

/// The direction of a vector that is not zero, 32767 = 1.
pub(crate) fn unit(vector: [i64; 3]) -> [i16; 3] {
    rounded(direction(vector))
}

/// For each vertex the mean of its faces' normals, weighted by the angle of the face there (Thürmer and Wüthrich 1998).
/// Where they cancel, as on both sides of a sheet, the normal of the first face.
pub(crate) fn of_vertices(points: &[[i16; 3]], faces: &[[usize; 3]], crosses: &[[i64; 3]]) -> Vec<[i16; 3]> {
    let mut sums = vec![[0.0; 3]; points.len()];
    let mut first = vec![None; points.len()];
    for (face, &cross) in faces.iter().zip(crosses) {
        let normal = direction(cross);
        let at = face.map(|vertex| points[vertex].map(i64::from));
        for corner in 0..3 {
            let vertex = face[corner];
            let [here, one, other] = [at[corner], at[(corner + 1) % 3], at[(corner + 2) % 3]];
            let [u, v] = [one, other].map(|to| direction([0, 1, 2].map(|axis| to[axis] - here[axis])));
            // acos loses half the digits at small angles; that is a weight's error of 1e-8.
            let angle = (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]).clamp(-1.0, 1.0).acos();
            for axis in 0..3 {
                sums[vertex][axis] += angle * normal[axis];
            }
            first[vertex].get_or_insert(normal);
        }
    }
    let mean = |(sum, first): (&[f64; 3], &Option<[f64; 3]>)| {
        // Angles add up to a few radians: less than this is what rounding left of nothing.
        let sum = if length(*sum) > 1e-6 { *sum } else { first.unwrap_or([0.0, 1.0, 0.0]) };
        rounded(sum.map(|c| c / length(sum)))
    };
    sums.iter().zip(&first).map(mean).collect()
}

fn direction(vector: [i64; 3]) -> [f64; 3] {
    let vector = vector.map(|c| c as f64);
    let length = length(vector);
    vector.map(|c| c / length)
}

pub(crate) fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn rounded(direction: [f64; 3]) -> [i16; 3] {
    direction.map(|c| (c * 32767.0).round() as i16)
}
