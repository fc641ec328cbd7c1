//! Vertices at the same position become one, and faces that are left without area or twice go.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

/// What is left after welding: for each new vertex the old one it stands for, and the faces, indexing the new ones in
/// the order in which the faces name them first.
pub(crate) struct Welded {
    pub(crate) vertices: Vec<usize>,
    pub(crate) faces: Vec<[usize; 3]>,
    /// For each face its place among those given.
    pub(crate) sources: Vec<usize>,
    /// Vertices at the position of an earlier one.
    pub(crate) welded: usize,
    /// Vertices (after welding) that no face names.
    pub(crate) unused: usize,
    /// The places of the faces that were dropped because they have no area.
    pub(crate) degenerate: Vec<usize>,
    /// The places of the faces that were dropped because they are there already.
    pub(crate) duplicate: Vec<usize>,
}

/// Welds vertices of equal keys. `is_flat` says of three different vertices whether they lie on one line.
pub(crate) fn weld<K: Copy + Eq + Hash>(
    keys: &[K],
    faces: &[[usize; 3]],
    is_flat: impl Fn([K; 3]) -> bool,
) -> Welded {
    let mut first_with = HashMap::with_capacity(keys.len());
    let representative: Vec<usize> =
        keys.iter().enumerate().map(|(vertex, key)| *first_with.entry(*key).or_insert(vertex)).collect();

    let mut new_index = HashMap::with_capacity(first_with.len());
    let mut seen = HashSet::with_capacity(faces.len());
    let mut out = Welded {
        vertices: Vec::new(),
        faces: Vec::with_capacity(faces.len()),
        sources: Vec::with_capacity(faces.len()),
        welded: keys.len() - first_with.len(),
        unused: 0,
        degenerate: Vec::new(),
        duplicate: Vec::new(),
    };
    for (place, face) in faces.iter().enumerate() {
        let face = face.map(|vertex| representative[vertex]);
        let [a, b, c] = face;
        if a == b || b == c || c == a || is_flat(face.map(|vertex| keys[vertex])) {
            out.degenerate.push(place);
        } else if !seen.insert(smallest_first(face)) {
            out.duplicate.push(place);
        } else {
            out.sources.push(place);
            out.faces.push(face.map(|vertex| {
                *new_index.entry(vertex).or_insert_with(|| {
                    out.vertices.push(vertex);
                    out.vertices.len() - 1
                })
            }));
        }
    }
    out.unused = first_with.len() - out.vertices.len();
    out
}

/// The same triangle with the same winding, whichever corner it began with.
fn smallest_first([a, b, c]: [usize; 3]) -> [usize; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
