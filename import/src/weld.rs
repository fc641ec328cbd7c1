//! Vertices at the same position become one, and faces that are left without area or twice go.

use crate::slivers::{Slivers, Weights};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// The mesh after welding: for each new vertex the index of an old one, and the faces. New vertices are numbered in the order in
/// which the faces use them first.
#[derive(Default)]
pub(crate) struct Welded {
    pub(crate) vertices: Vec<usize>,
    pub(crate) faces: Vec<[usize; 3]>,
    /// For each face its index in the input.
    pub(crate) sources: Vec<usize>,
    /// The faces that are pieces of a face of the input, in ascending order, and which.
    pub(crate) pieces: Vec<(usize, Weights)>,
    /// Vertices at the position of an earlier one.
    pub(crate) welded: usize,
    /// Vertices (after welding) that no face names.
    pub(crate) unused: usize,
    /// The places of the faces that were dropped because they have no area.
    pub(crate) degenerate: Vec<usize>,
    /// The places of the faces that were dropped because they are there already. None are, if that would open a closed surface.
    pub(crate) duplicate: Vec<usize>,
    /// How many faces there are more because faces were cut.
    pub(crate) cut: usize,
}

/// Welds vertices of equal keys, each of which is a position. `is_flat` says of three different positions whether they lie on one
/// line.
pub(crate) fn weld(
    keys: &[Key],
    faces: &[[usize; 3]],
    position: &dyn Fn(Key) -> [f64; 3],
    is_flat: &dyn Fn([Key; 3]) -> bool,
) -> Welded {
    let mut first_with = Numbered::with_capacity_and_hasher(keys.len(), BuildHasherDefault::default());
    let representative: Vec<usize> =
        keys.iter().enumerate().map(|(vertex, key)| *first_with.entry(*key).or_insert(vertex)).collect();

    let mut new_index = vec![None; keys.len()];
    let mut seen = Numbered::with_capacity_and_hasher(faces.len(), BuildHasherDefault::default());
    let mut out = Welded {
        faces: Vec::with_capacity(faces.len()),
        sources: Vec::with_capacity(faces.len()),
        welded: keys.len() - first_with.len(),
        ..Welded::default()
    };
    let (mut with_area, mut slivers) = (Vec::with_capacity(faces.len()), Vec::new());
    for (place, face) in faces.iter().enumerate() {
        let face = face.map(|vertex| representative[vertex]);
        let [a, b, c] = face;
        let is_point_or_side = a == b || b == c || c == a;
        if is_point_or_side || is_flat(face.map(|vertex| keys[vertex])) {
            out.degenerate.push(place);
            slivers.extend((!is_point_or_side).then_some(face));
        } else {
            with_area.push((place, face));
        }
    }
    let slivers = Slivers::new(&slivers, with_area.iter().map(|(_, face)| face), |v| position(keys[v]));
    let mut duplicates = Vec::new();
    for &(place, face) in &with_area {
        let pieces = slivers.pieces(face);
        if pieces.is_empty() {
            out.degenerate.push(place);
            continue;
        }
        out.cut += pieces.len() - 1;
        for (corners, weights) in pieces {
            let is_first = seen.insert(smallest_first(corners).map(|vertex| vertex as u64), place).is_none();
            let is_whole = corners == face;
            let corners = corners.map(|vertex| {
                *new_index[vertex].get_or_insert_with(|| {
                    out.vertices.push(vertex);
                    out.vertices.len() - 1
                })
            });
            let piece = (place, corners, (!is_whole).then_some(weights));
            match is_first {
                true => out.push(piece),
                false => duplicates.push(piece),
            }
        }
    }
    let with_duplicates = || out.faces.iter().chain(duplicates.iter().map(|(_, face, _)| face));
    if !duplicates.is_empty() && !is_closed(out.faces.iter()) && is_closed(with_duplicates()) {
        duplicates.into_iter().for_each(|piece| out.push(piece));
    } else {
        out.duplicate = duplicates.into_iter().map(|(place, ..)| place).collect();
    }
    out.unused = first_with.len() - out.vertices.len();
    out
}

/// Whether as many faces run along each side in one direction as in the other.
fn is_closed<'f>(faces: impl Iterator<Item = &'f [usize; 3]>) -> bool {
    let mut sides = Numbered::default();
    for &[a, b, c] in faces {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let sum = sides.entry(of_edge([a.min(b), a.max(b)])).or_default();
            *sum = sum.wrapping_add(if a < b { 1 } else { usize::MAX }); // 1, or −1
        }
    }
    sides.into_values().all(|sum| sum == 0)
}

impl Welded {
    fn push(&mut self, (place, face, weights): (usize, [usize; 3], Option<Weights>)) {
        self.pieces.extend(weights.map(|weights| (self.faces.len(), weights)));
        self.sources.push(place);
        self.faces.push(face);
    }

    /// Values at the corners of a face, by those at the corners of the face of the input.
    pub(crate) fn values(&self, face: usize, values: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
        let Ok(place) = self.pieces.binary_search_by_key(&face, |piece| piece.0) else { return values };
        self.pieces[place]
            .1
            .map(|of| [0, 1].map(|axis| (0..3).map(|corner| of[corner] * values[corner][axis]).sum()))
    }
}

/// Rotates a triangle's indices so that the smallest comes first: equal triangles of equal winding get equal indices.
fn smallest_first([a, b, c]: [usize; 3]) -> [usize; 3] {
    [a, b, c].min([b, c, a]).min([c, a, b])
}

/// The key of a map: the bits of a vertex's coordinates, or the vertices of an edge and 0.
pub(crate) type Key = [u64; 3];

/// Keys and a number for each. All maps from numbers are of this one type, so that the planner's page has its code once.
pub(crate) type Numbered = HashMap<Key, usize, BuildHasherDefault<Mix>>;

/// Texts and a number for each.
pub(crate) type Names<'t> = HashMap<&'t str, usize, BuildHasherDefault<Mix>>;

/// The key of an edge.
pub(crate) fn of_edge([a, b]: [usize; 2]) -> Key {
    [a as u64, b as u64, 0]
}

/// A hash by one multiplication a number: build scripts are compiled without optimisation, where the standard one takes most
/// of the time. Nobody gains by a model that is slow to weld.
#[derive(Default)]
pub(crate) struct Mix(u64);

impl Mix {
    fn mix(&mut self, number: u64) {
        // An odd constant, 2⁶⁴ over the golden ratio (Knuth, "The Art of Computer Programming" 3, section 6.4). Both halves of
        // the product: a float that is a small integer differs from others in its upper bits only, and the map looks
        // at the lowest ones.
        let product = u128::from(self.0 ^ number) * 0x9e37_79b9_7f4a_7c15;
        self.0 = (product >> 64) as u64 ^ product as u64;
    }
}

impl Hasher for Mix {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut number = [0; 8];
            number[..chunk.len()].copy_from_slice(chunk);
            self.mix(u64::from_le_bytes(number));
        }
    }

    fn write_usize(&mut self, number: usize) {
        self.mix(number as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::Mix;
    use std::collections::HashSet;
    use std::hash::{BuildHasher, BuildHasherDefault};

    /// A map of 2¹⁶ keys looks at 16 low bits and 7 high ones. Of 2¹⁶ random numbers, a fraction of 1 − 1/e is distinct: 41 427.
    #[test]
    fn keys_of_grids_are_spread() {
        let hash = BuildHasherDefault::<Mix>::default();
        let grid = || (0..1 << 16).map(|i: u32| [i & 63, i >> 6 & 63, i >> 12]);
        let count = |hashes: &mut dyn Iterator<Item = u64>| {
            let hashes: Vec<u64> = hashes.collect();
            let low: HashSet<u64> = hashes.iter().map(|h| h & 0xffff).collect();
            let high: HashSet<u64> = hashes.iter().map(|h| h >> 57).collect();
            (low.len(), high.len())
        };
        let spreads = [
            count(&mut grid().map(|p| hash.hash_one(p.map(|c| f64::from(c).to_bits())))),
            count(&mut grid().map(|p| hash.hash_one(p.map(|c| (f64::from(c) * 0.1).to_bits())))),
            count(&mut grid().map(|p| hash.hash_one(p.map(|c| (c as f32).to_bits())))),
            count(&mut grid().map(|p| hash.hash_one(p.map(|c| c as i16 - 32)))),
            count(&mut grid().map(|p| hash.hash_one(p.map(|c| c as usize)))),
        ];
        assert!(spreads.iter().all(|&(low, high)| low > 37_000 && high == 128), "{spreads:?}");
    }
}
