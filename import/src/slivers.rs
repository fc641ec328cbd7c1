//! Faces whose corners lie on one line, and the faces beside them.
//!
//! A face on a line covers no pixel, but it may close a surface: where one neighbour has a side from A to C and two others have
//! sides from A to B and from B to C, the face A B C joins them. To leave it out would make a T-junction, at which rounding to
//! pixels opens holes. Therefore the neighbour at A C is cut in two at B, and all neighbours have the corner B then.
//!
//! No vertex moves and no face turns, so normals, planes and creases need no exception, and the mesh has no more faces than with
//! the face on a line.
//!
//! **A closed surface stays closed.** Faces on a line that share sides are a group, and they share each side with an even number
//! of neighbours and of each other. Each face of a group covers a stretch of the line, from one vertex to the next, by two of
//! its sides or by none. So the group's sides cover each stretch an even number of times, and the neighbours' sides do, too. Cut at
//! all vertices of the group at which neighbours' sides end, an even number of neighbours has the stretch as a side. With
//! directions counted, as many run along it in one direction as in the other.

use crate::weld::{of_edge, Numbered};

/// The weights of a face's corners at each corner of a piece of it.
pub(crate) type Weights = [[f64; 3]; 3];

/// The weights of a face that is not cut.
const WHOLE: Weights = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// How often faces may be cut for each side of a group.
const MANY: usize = 16;

/// Faces on a line, in groups, and the positions of vertices.
pub(crate) struct Slivers<P> {
    /// The group of each side, the lower vertex first.
    groups: Numbered,
    /// The vertices of each group at which neighbours' sides end, in the order of the line.
    cuts: Vec<Vec<usize>>,
    position: P,
}

impl<P: Fn(usize) -> [f64; 3]> Slivers<P> {
    /// Groups faces on a line; `faces` are all others. No two vertices have one position.
    pub(crate) fn new<'f>(
        slivers: &[[usize; 3]],
        faces: impl Iterator<Item = &'f [usize; 3]> + Clone,
        position: P,
    ) -> Self {
        let mut sets = Sets((0..slivers.len()).collect());
        let mut groups = Numbered::default();
        for (sliver, corners) in slivers.iter().enumerate() {
            for side in sides(corners) {
                sets.join(sliver, *groups.entry(of_edge(side)).or_insert(sliver));
            }
        }
        groups.values_mut().for_each(|group| *group = sets.first(*group));
        let mut cuts = vec![Vec::new(); slivers.len()];
        let of_groups = |side: [usize; 2]| groups.get(&of_edge(side)).map(|&group| (group, side));
        for (group, side) in faces.clone().flat_map(sides).filter_map(of_groups) {
            cuts[group].extend(side);
        }
        for cuts in &mut cuts {
            // By x, then y, then z: along a line, each of them grows, shrinks or stays throughout.
            cuts.sort_by(|&a, &b| position(a).partial_cmp(&position(b)).unwrap_or(a.cmp(&b)));
            cuts.dedup();
        }
        let mut slivers = Self { groups, cuts, position };
        slivers.leave_many(faces);
        slivers
    }

    /// Leaves out groups at which faces would be cut more than [`MANY`] times as often as the group has sides. At a surface that does
    /// not fold back, no group has as many cuts as sides; but thousands of faces on one side of a file's own making, each cut
    /// thousands of times, would fill the memory.
    fn leave_many<'f>(&mut self, faces: impl Iterator<Item = &'f [usize; 3]>) {
        let (mut sides_of, mut cuts_of) = (vec![0; self.cuts.len()], vec![0; self.cuts.len()]);
        self.groups.values().for_each(|&group| sides_of[group] += 1);
        for [a, b] in faces.flat_map(sides) {
            if let Some(&group) = self.groups.get(&of_edge([a, b])) {
                cuts_of[group] += self.between(a, b, group).len();
            }
        }
        for (group, cuts) in self.cuts.iter_mut().enumerate() {
            if cuts_of[group] > MANY * sides_of[group] {
                cuts.clear();
            }
        }
    }

    /// The pieces of a face, cut at the vertices on its sides; none if it turns out to lie on a line.
    pub(crate) fn pieces(&self, corners: [usize; 3]) -> Vec<([usize; 3], Weights)> {
        let groups = sides(&corners).map(|side| self.groups.get(&of_edge(side)).copied());
        let mut left = vec![(corners, WHOLE, groups)];
        let mut pieces = Vec::new();
        while let Some((corners, weights, groups)) = left.pop() {
            let cut = |side: usize| {
                let group = groups[side]?;
                Some((side, *self.between(corners[side], corners[(side + 1) % 3], group).first()?))
            };
            let Some((from, vertex)) = (0..3).find_map(cut) else {
                // The third corner may lie between the others, too, where a line is one only as far as f64 tells.
                let [a, b, c] = corners;
                if a != b && b != c && c != a {
                    pieces.push((corners, weights));
                }
                continue;
            };
            let to = (from + 1) % 3;
            let along = self.along(corners[from], corners[to], vertex);
            let middle = [0, 1, 2].map(|i| weights[from][i] * (1.0 - along) + weights[to][i] * along);
            let (mut first, mut second) = ((corners, weights, groups), (corners, weights, groups));
            // The new side, from the vertex to the third corner, has no group.
            (first.0[to], first.1[to], first.2[to]) = (vertex, middle, None);
            (second.0[from], second.1[from], second.2[(to + 1) % 3]) = (vertex, middle, None);
            left.extend([second, first]);
        }
        pieces
    }

    /// The vertices of a group's line between two others.
    fn between(&self, a: usize, b: usize, group: usize) -> &[usize] {
        let cuts = &self.cuts[group];
        let [a, b] = [a, b].map(&self.position);
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let first = cuts.partition_point(|&vertex| (self.position)(vertex) <= low);
        let end = cuts.partition_point(|&vertex| (self.position)(vertex) < high);
        cuts.get(first..end).unwrap_or_default() // empty, if neither end is one of them
    }

    /// How far a vertex lies along a side, from 0 to 1.
    fn along(&self, from: usize, to: usize, vertex: usize) -> f64 {
        let [from, to, at] = [from, to, vertex].map(&self.position);
        let length = |axis: usize| (to[axis] - from[axis]).abs();
        let axis = (0..3).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or_default();
        (at[axis] - from[axis]) / (to[axis] - from[axis])
    }
}

/// The sides of a face, from its first, second and third corner on, the lower vertex first.
fn sides(&[a, b, c]: &[usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// Disjoint sets of numbers: for each number another one of its set, or itself (Galler and Fischer 1964).
struct Sets(Vec<usize>);

impl Sets {
    /// The number that stands for a set.
    fn first(&mut self, mut number: usize) -> usize {
        while self.0[number] != number {
            self.0[number] = self.0[self.0[number]];
            number = self.0[number];
        }
        number
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }
}
