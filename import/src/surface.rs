//! The faces of a mesh while it is made, with what the file says of each.

use crate::grid::Grid;
use crate::parts::reversed;
use crate::weld::{Key, Numbered};
use crate::{Axis, Triangles};

/// The most vertices that indices of `u16` can name.
pub(crate) const MOST_VERTICES: usize = 1 << 16;

/// A surface on the grid.
pub(crate) struct Surface {
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) faces: Vec<[usize; 3]>,
    /// The triangle of the file that each face is, or is a piece of.
    pub(crate) triangles: Vec<usize>,
    /// The texture coordinates of each face's corners, in sides of the texture; or nothing.
    pub(crate) coords: Vec<[[f64; 2]; 3]>,
    /// The edges that are lines of the file, the lower vertex first, each once, in ascending order.
    pub(crate) lines: Vec<[usize; 2]>,
}

impl Surface {
    /// Reverses the corners of a face.
    pub(crate) fn reverse(&mut self, face: usize) {
        self.faces[face] = reversed(self.faces[face]);
        self.coords.get_mut(face).into_iter().for_each(|corners| *corners = reversed(*corners));
    }

    /// Adds the back of a face.
    pub(crate) fn add_back(&mut self, face: usize) {
        self.faces.push(reversed(self.faces[face]));
        self.triangles.push(self.triangles[face]);
        self.coords.extend(self.coords.get(face).copied().map(reversed));
    }

    /// Adds lines, each between two of the ends, and vertices where none is.
    pub(crate) fn add_lines(&mut self, ends: &[[i16; 3]]) {
        if ends.is_empty() {
            return;
        }
        let vertices = &mut self.vertices;
        let mut numbers: Numbered =
            vertices.iter().enumerate().map(|(number, vertex)| (key(vertex), number)).collect();
        let mut number = |end: [i16; 3]| {
            *numbers.entry(key(&end)).or_insert_with(|| {
                vertices.push(end);
                vertices.len() - 1
            })
        };
        let lines = ends.chunks_exact(2).filter(|ends| ends[0] != ends[1]);
        let lines = lines.map(|ends| [number(ends[0]), number(ends[1])]).map(|[a, b]| [a.min(b), a.max(b)]);
        self.lines = lines.collect();
        self.lines.sort_unstable();
        self.lines.dedup();
    }

    /// The surface in the axes and units of the file.
    pub(crate) fn in_file(&self, grid: &Grid, scale: f64, up: Axis) -> Triangles {
        let position = |vertex| up.turn_back(grid.position(vertex).map(|c| c / scale));
        Triangles { positions: self.vertices.iter().map(position).collect(), faces: self.faces.clone() }
    }
}

/// The key of a vertex.
pub(crate) fn key(vertex: &[i16; 3]) -> Key {
    vertex.map(|c| c as u64) // as many as there are
}
