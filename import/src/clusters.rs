//! Clusters: runs of 32 faces that lie close together and are turned alike, so that a renderer leaves out all of them by one test.
//!
//! Faces are ordered by halving, as a k-d tree (Bentley, "Multidimensional Binary Search Trees Used for Associative Searching", 1975), in
//! the six dimensions of their positions and normals. Each cluster then has a ball around its corners and one around its normals, as
//! `pinhole::Mesh::with_planes` describes.

use crate::normals::{cross, unit};

/// The number of faces of a cluster.
const FACES: usize = 32;

/// The places of the faces in their new order. Within a cluster the order stays.
pub(crate) fn order(faces: &[[usize; 3]], vertices: &[[i16; 3]]) -> Vec<usize> {
    // The largest coordinate and a unit normal have nearly equal ranges: as far as two clusters may lie apart, so they may turn.
    let point = |&face: &[usize; 3]| {
        let corners = face.map(|vertex| vertices[vertex]);
        let sum = |axis: usize| corners.iter().map(|corner| i32::from(corner[axis])).sum::<i32>();
        let [x, y, z] = [0, 1, 2].map(sum).map(|sum| sum / 3);
        let [a, b, c] = unit(cross(corners)).map(i32::from);
        [x, y, z, a, b, c]
    };
    let points: Vec<[i32; 6]> = faces.iter().map(point).collect();
    let mut places: Vec<usize> = (0..faces.len()).collect();
    halve(&mut places, &points);
    places
}

/// Halves a list of faces along the dimension in which they extend farthest, down to clusters.
fn halve(places: &mut [usize], points: &[[i32; 6]]) {
    if places.len() <= FACES {
        places.sort_unstable();
        return;
    }
    let extent = |&axis: &usize| {
        let along = || places.iter().map(|&place| points[place][axis]);
        along().max().unwrap_or(0) - along().min().unwrap_or(0)
    };
    let widest = (0..6).max_by_key(extent).unwrap_or(0);
    places.sort_unstable_by_key(|&place| (points[place][widest], place));
    let (first, second) = places.split_at_mut((places.len() / FACES).div_ceil(2) * FACES);
    halve(first, points);
    halve(second, points);
}

/// The eight numbers of each cluster of a mesh.
pub(crate) fn describe(
    faces: &[[u16; 3]],
    vertices: &[[i16; 3]],
    normals: &[[i16; 3]],
    planes: &[i16],
) -> Vec<[i16; 8]> {
    let bits = |c: i16| (c ^ (c >> 15)) as u16;
    let bound = vertices.iter().flatten().fold(0, |all, &c| all | bits(c));
    let up = bound.leading_zeros().saturating_sub(1); // 15 bits and the sign
    let parts = faces.chunks(FACES).zip(normals.chunks(FACES)).zip(planes.chunks(FACES));
    let clusters = parts.map(|((faces, normals), planes)| {
        let corners: Vec<[i32; 3]> =
            faces.iter().flatten().map(|&v| vertices[usize::from(v)].map(|c| i32::from(c) << up)).collect();
        let normals: Vec<[i32; 3]> = normals.iter().map(|normal| normal.map(i32::from)).collect();
        let (centre, radius) = ball(&corners);
        let radius = radius.max(1);
        let (axis, spread) = ball(&normals);
        let from_centre = |(normal, &plane): (&[i32; 3], &i16)| {
            let along: i64 = normal.iter().zip(centre).map(|(&n, c)| i64::from(n) * i64::from(c)).sum();
            (along - (i64::from(plane) << 16)).unsigned_abs().div_ceil(1 << 15)
        };
        let error = normals.iter().zip(planes).map(from_centre).max().unwrap_or(0);
        // In 1/256 of the radius and one unit, and in 2⁷ of normals; one less is stored.
        let error = (error.saturating_sub(1) * 256).div_ceil(radius).saturating_sub(1);
        let spread = spread.div_ceil(128).saturating_sub(1);
        let [x, y, z] = centre.map(|c| c as i16);
        // No vector: such a cluster is never turned away.
        let [a, b, c] = if error < 256 && spread < 256 { axis.map(|c| c as i16) } else { [0; 3] };
        let [error, spread] = [error, spread].map(|bits| bits.min(255) as u16);
        [x, y, z, radius as u16 as i16, a, b, c, (spread << 8 | error) as i16]
    });
    clusters.collect()
}

/// The centre of a small ball around points, and its radius, rounded up. The centre moves to the farthest point by less and less (Bădoiu and
/// Clarkson, "Smaller Core-Sets for Balls", 2003).
fn ball(points: &[[i32; 3]]) -> ([i32; 3], u64) {
    let mut centre = points.first().map_or([0.0; 3], |point| point.map(f64::from));
    for step in 2..66 {
        let square =
            |point: &[i32; 3]| (0..3).map(|i| (f64::from(point[i]) - centre[i]).powi(2)).sum::<f64>();
        let farthest = points.iter().max_by(|a, b| square(a).total_cmp(&square(b)));
        let Some(farthest) = farthest else { break };
        centre = [0, 1, 2].map(|i| centre[i] + (f64::from(farthest[i]) - centre[i]) / f64::from(step));
    }
    let centre = centre.map(|c| c.round() as i32);
    let square = |point: &[i32; 3]| (0..3).map(|i| u64::from(point[i].abs_diff(centre[i])).pow(2)).sum();
    let square: u64 = points.iter().map(square).max().unwrap_or(0);
    let root = square.isqrt();
    (centre, root + u64::from(root * root < square))
}
