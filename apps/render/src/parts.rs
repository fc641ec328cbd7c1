//! Splits a mesh of any size into parts whose vertices and faces fit 16-bit indices.

use crate::camera::cross;
use crate::light::{dot, minus};
use pinhole::{Mesh, Scalar};
use std::collections::{BTreeMap, HashMap};

pub struct Part {
    /// Indices into the mesh's vertices, for all vertices of the part but the first: see [`Part::vertices`].
    indices: Vec<usize>,
    pub faces: Vec<[u16; 3]>,
    /// Edges of the faces. Empty until [`Part::find_edges`] is called.
    edges: Vec<Edge>,
    /// Index of its first triangle in the mesh.
    pub first: usize,
}

/// An edge with two of its faces; an edge with more than two faces occurs once for every two of them.
struct Edge {
    ends: [u16; 2],
    beside: [u16; 2],
    /// Whether it is drawn from all sides; other edges are drawn where they are silhouettes.
    is_feature: bool,
}

const MOST: usize = 65_536;
/// Three edges per face must fit the 16-bit counters of [`pinhole::draw::TransformedMesh::bin_edges`].
const MOST_FACES: usize = 65_535 / 3;

/// Splits the triangles into parts, in order. Vertices with equal coordinates are merged, because formats such as STL
/// repeat them for every face.
pub fn parts(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Vec<Part> {
    let mut places = HashMap::new();
    let same: Vec<usize> = vertices
        .iter()
        .enumerate()
        // Adding 0.0 turns -0.0 into 0.0.
        .map(|(index, v)| *places.entry(v.map(|c| (c + 0.0).to_bits())).or_insert(index))
        .collect();
    let empty = |first| Part { indices: Vec::new(), faces: Vec::new(), edges: Vec::new(), first };
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
    /// Finds the edges. Features are those at which the surface turns by more than some degrees, or ends, or all: the diagonals of
    /// flat faces turn by nothing. `all` are the mesh's vertices.
    pub fn find_edges(&mut self, all: &[[f64; 3]], degrees: Option<f64>) {
        let at = |vertex: u16| all[self.indices[usize::from(vertex) - 1]]; // the first one is no face's
        let normal = |face: u16| {
            let [a, b, c] = self.faces[usize::from(face)].map(at);
            cross(minus(b, a), minus(c, a))
        };
        let turns = |faces: &[u16]| {
            let (&[a, b], Some(degrees)) = (faces, degrees) else { return true };
            let (n, m) = (normal(a), normal(b));
            let across = cross(n, m);
            dot(across, across).sqrt().atan2(dot(n, m)).to_degrees() > degrees
        };
        let mut edges = BTreeMap::<[u16; 2], Vec<u16>>::new();
        for (number, &[a, b, c]) in self.faces.iter().enumerate() {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                edges.entry([a.min(b), a.max(b)]).or_default().push(number as u16);
                // below MOST_FACES
            }
        }
        let corners = |face: &u16| {
            let mut corners = self.faces[usize::from(*face)];
            corners.sort_unstable();
            corners
        };
        let pair = |faces: &[u16]| [0, 1].map(|i| faces.get(i).copied().unwrap_or(Mesh::<Scalar>::NO_FACE));
        for (ends, faces) in edges {
            // The two sides of a surface are one surface.
            let is_back = |(place, face): &(usize, &u16)| {
                faces[..*place].iter().any(|earlier| corners(earlier) == corners(face))
            };
            let sides = faces.iter().enumerate().filter(|side| !is_back(side));
            let is_feature = turns(&sides.map(|(_, &face)| face).collect::<Vec<_>>());
            self.edges.extend(faces.chunks(2).map(|two| Edge { ends, beside: pair(two), is_feature }));
        }
    }

    /// All edges, and the two faces beside each.
    pub fn all_edges(&self) -> (Vec<[u16; 2]>, Vec<[u16; 2]>) {
        self.edges.iter().map(|edge| (edge.ends, edge.beside)).unzip()
    }

    /// Whether the surface turns or ends at an edge, one of [all](Self::all_edges).
    pub fn is_feature(&self, edge: usize) -> bool {
        self.edges.get(edge).is_some_and(|edge| edge.is_feature)
    }

    /// The triangles of the mesh beside an edge, one of [all](Self::all_edges).
    pub fn triangles_beside(&self, edge: usize) -> [Option<usize>; 2] {
        let beside = self.edges.get(edge).map_or([Mesh::<Scalar>::NO_FACE; 2], |edge| edge.beside);
        beside.map(|face| (face != Mesh::<Scalar>::NO_FACE).then_some(self.first + usize::from(face)))
    }

    /// The edges to draw, and the two faces beside each: features and, if it is known how each triangle of the mesh faces the eye
    /// ([`Scene::facings`]), silhouettes, which lie between a front and a back face.
    ///
    /// [`Scene::facings`]: crate::scene::Scene::facings
    pub fn drawn_edges(&self, facings: Option<&[i8]>) -> (Vec<[u16; 2]>, Vec<[u16; 2]>) {
        let is_silhouette = |edge: &Edge| {
            let facing = |face: u16| facings?.get(self.first + usize::from(face)); // none for NO_FACE, beyond MOST_FACES
            matches!(edge.beside.map(facing), [Some(a), Some(b)] if a * b < 0)
        };
        let drawn = self.edges.iter().filter(|edge| edge.is_feature || is_silhouette(edge));
        drawn.map(|edge| (edge.ends, edge.beside)).unzip()
    }

    /// Vertices of the part. The number format of a part depends on its largest coordinate, so every part gets the mesh's
    /// vertex with the largest coordinate as its first: vertices that parts share then round to equal positions.
    pub fn vertices(&self, all: &[[Scalar; 3]]) -> Vec<[Scalar; 3]> {
        let largest = |v: &&[Scalar; 3]| v.map(|c| c.to_bits() ^ (c.to_bits() >> 31)).into_iter().max();
        let first = all.iter().max_by_key(largest).copied().unwrap_or_default();
        std::iter::once(first).chain(self.indices.iter().map(|&index| all[index])).collect()
    }
}
