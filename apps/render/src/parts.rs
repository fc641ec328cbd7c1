//! A mesh of any size in parts whose vertices and faces 16-bit numbers can name.

use pinhole::{Mesh, Scalar};
use std::collections::{BTreeMap, HashMap};

pub struct Part {
    /// Which of the mesh's vertices its own are, but for the first: see [`Part::vertices`].
    indices: Vec<usize>,
    pub faces: Vec<[u16; 3]>,
    /// The sides of the faces, each once, or once for every two of the faces beside it; empty before
    /// [`Part::find_edges`].
    pub edges: Vec<[u16; 2]>,
    /// Those faces.
    pub beside: Vec<[u16; 2]>,
    /// The number of its first triangle.
    pub first: usize,
}

const MOST: usize = 65_536;
/// Each with three edges of its own: [`pinhole::Transformed::edges`] records as many as 16 bits count.
const MOST_FACES: usize = 65_535 / 3;

/// The triangles, in their order. Vertices at one place are one, so that faces meet in files that
/// have corners of their own for each.
pub fn parts(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Vec<Part> {
    let mut places = HashMap::new();
    let same: Vec<usize> = vertices
        .iter()
        .enumerate()
        // Adding 0.0 makes one of the two zeros.
        .map(|(index, v)| *places.entry(v.map(|c| (c + 0.0).to_bits())).or_insert(index))
        .collect();
    let empty =
        |first| Part { indices: Vec::new(), faces: Vec::new(), edges: Vec::new(), beside: Vec::new(), first };
    let mut parts = Vec::new();
    let (mut part, mut names) = (empty(0), HashMap::new());
    for (number, triangle) in triangles.iter().enumerate() {
        if part.indices.len() + 4 > MOST || part.faces.len() == MOST_FACES {
            parts.push(std::mem::replace(&mut part, empty(number)));
            names.clear();
        }
        part.faces.push(triangle.map(|index| {
            *names.entry(same[index]).or_insert_with(|| {
                part.indices.push(same[index]);
                part.indices.len() as u16 // below MOST
            })
        }));
    }
    parts.push(part);
    parts
}

impl Part {
    pub fn find_edges(&mut self) {
        let mut edges = BTreeMap::<[u16; 2], Vec<u16>>::new();
        for (number, &[a, b, c]) in self.faces.iter().enumerate() {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                edges.entry([a.min(b), a.max(b)]).or_default().push(number as u16);
                // below MOST_FACES
            }
        }
        let pair = |faces: &[u16]| [0, 1].map(|i| faces.get(i).copied().unwrap_or(Mesh::<Scalar>::NO_FACE));
        for (edge, faces) in edges {
            for two in faces.chunks(2) {
                self.edges.push(edge);
                self.beside.push(pair(two));
            }
        }
    }

    /// Its vertices out of the mesh's. A format is chosen for each part by its largest coordinate: all
    /// parts get the vertex that has it as their first, so that what they share lands on the same place.
    pub fn vertices(&self, all: &[[Scalar; 3]]) -> Vec<[Scalar; 3]> {
        let largest = |v: &&[Scalar; 3]| v.map(|c| c.to_bits() ^ (c.to_bits() >> 31)).into_iter().max();
        let first = all.iter().max_by_key(largest).copied().unwrap_or_default();
        std::iter::once(first).chain(self.indices.iter().map(|&index| all[index])).collect()
    }
}
