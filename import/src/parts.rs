//! The connected parts of a surface, and which of their faces show the wrong side.
//!
//! Faces are connected across the edges that exactly two of them share. In a part, winding is made consistent by flood fill:
//! the faces that have less area than the others are the wrong ones. Whether a consistent part points outwards is then
//! decided by its signed volume (Zhang and Chen, "Efficient feature extraction for 2D/3D objects in mesh representation",
//! 2001), of an open part about the mean of its corners.

use crate::bodies::{Body, Nesting};
use crate::edges::Sides;
use crate::normals::{cross, length};

/// The connected parts of a surface.
pub(crate) struct Parts {
    /// The part of each face.
    of_face: Vec<usize>,
    /// Whether the face is wound against the larger area of its part.
    against: Vec<bool>,
    pub(crate) parts: Vec<Part>,
}

/// A connected part.
pub(crate) struct Part {
    /// Its first face.
    first: usize,
    /// Whether each of its edges has two of its faces.
    is_closed: bool,
    /// Whether two neighbours are wound in opposite directions.
    pub(crate) is_mixed: bool,
    /// Whether no winding is consistent, as on a Möbius strip.
    pub(crate) is_one_sided: bool,
    /// Whether the larger area shows its back to the outside.
    is_inward: bool,
}

impl Part {
    /// Whether it is a body whose faces all show their front to the outside.
    fn is_sound(&self) -> bool {
        self.is_closed && !self.is_mixed && !self.is_inward
    }

    /// Whether its winding is consistent and points inwards.
    pub(crate) fn is_inside_out(&self) -> bool {
        !self.is_mixed && self.is_inward
    }
}

/// An open part counts as inward where its volume is more than this, negative, in units of area^3/2. A ball has 0.094, a
/// cube 0.068; a flat sheet that is a bit uneven has less than this.
const CLEARLY: f64 = 0.005;

impl Parts {
    pub(crate) fn of(faces: &[[usize; 3]], vertices: &[[i16; 3]], sides: &Sides) -> Self {
        let mut found = Self::connected(faces.len(), sides);
        let corners = |face: usize| faces[face].map(|vertex| vertices[vertex]);
        let mut lists = vec![Vec::new(); found.parts.len()];
        for (face, &part) in found.of_face.iter().enumerate() {
            lists[part].push(face);
        }
        let mut bodies = Vec::with_capacity(lists.len());
        for (part, list) in found.parts.iter_mut().zip(&lists) {
            let area = |face: usize| length(cross(corners(face)).map(|c| c as f64)) / 2.0;
            let (mut with, mut against) = (0.0, 0.0);
            for &face in list {
                *(if found.against[face] { &mut against } else { &mut with }) += area(face);
            }
            if against > with {
                list.iter().for_each(|&face| found.against[face] ^= true);
            }
            let mut body = Body::default();
            for &face in list {
                let [a, b, c] = corners(face);
                body.add(if found.against[face] { [a, c, b] } else { [a, b, c] });
            }
            let area = with + against;
            let is_clearly_inward = body.volume() < -CLEARLY * area * area.sqrt();
            part.is_inward = !part.is_closed && !part.is_one_sided && is_clearly_inward;
            bodies.push(body);
        }
        // A closed part that points inwards is right where it is a cavity: inside an odd number of others.
        let is_closed = |part: &usize| found.parts[*part].is_closed && !found.parts[*part].is_one_sided;
        let closed: Vec<usize> = (0..bodies.len()).filter(is_closed).collect();
        let mut nesting = Nesting::new(closed.iter().map(|&part| &bodies[part]).collect());
        for (body, &part) in closed.iter().enumerate() {
            if bodies[part].volume() < 0.0 {
                found.parts[part].is_inward = nesting.depth(body).is_multiple_of(2);
            }
        }
        found
    }

    /// The parts, with `against` relative to each part's first face.
    fn connected(count: usize, sides: &Sides) -> Self {
        let mut beside = vec![[None; 3]; count];
        for edge in sides.edges() {
            if let [a, b] = edge {
                for (here, there) in [(a, b), (b, a)] {
                    let free = beside[here.face()].iter_mut().find(|beside| beside.is_none());
                    if let Some(free) = free {
                        *free = Some((there.face(), a.up() == b.up()));
                    }
                }
            }
        }
        let mut of_face = vec![usize::MAX; count];
        let mut against = vec![false; count];
        let mut parts = Vec::new();
        for first in 0..count {
            if of_face[first] != usize::MAX {
                continue;
            }
            let number = parts.len();
            let mut part =
                Part { first, is_closed: true, is_mixed: false, is_one_sided: false, is_inward: false };
            of_face[first] = number;
            let mut left = vec![first];
            while let Some(face) = left.pop() {
                for (other, is_opposite) in beside[face].into_iter().flatten() {
                    part.is_mixed |= is_opposite;
                    let wanted = against[face] ^ is_opposite;
                    if of_face[other] == usize::MAX {
                        of_face[other] = number;
                        against[other] = wanted;
                        left.push(other);
                    } else {
                        part.is_one_sided |= against[other] != wanted;
                    }
                }
            }
            parts.push(part);
        }
        for edge in sides.edges() {
            // Where more than two faces meet, two of each part.
            let mut of_parts: Vec<(usize, bool)> =
                edge.iter().map(|side| (of_face[side.face()], side.up() ^ against[side.face()])).collect();
            of_parts.sort_unstable();
            for sides in of_parts.chunk_by(|a, b| a.0 == b.0) {
                if !matches!(sides, [(_, false), (_, true)]) {
                    parts[sides[0].0].is_closed = false;
                }
            }
        }
        Parts { of_face, against, parts }
    }

    /// Whether a face must be reversed to be wound as its part is and, if that can be told, to show its front to the outside.
    pub(crate) fn is_wrong(&self, face: usize) -> bool {
        let part = &self.parts[self.of_face[face]];
        !part.is_one_sided && self.against[face] ^ part.is_inward
    }

    /// Tells that the faces that are wrong were reversed.
    pub(crate) fn set_right(&mut self) {
        for (part, against) in self.of_face.iter().zip(&mut self.against) {
            *against &= self.parts[*part].is_one_sided;
        }
        for part in &mut self.parts {
            part.is_mixed &= part.is_one_sided;
            part.is_inward = false;
        }
    }

    /// The faces, ascending, that can be seen from behind: those of parts that are not sound.
    pub(crate) fn seen_from_behind(&self) -> Vec<usize> {
        let is_seen = |face: &usize| !self.parts[self.of_face[*face]].is_sound();
        (0..self.of_face.len()).filter(is_seen).collect()
    }

    /// The number of parts that are inside out, and the first face of the first of them.
    pub(crate) fn inside_out(&self) -> (usize, Option<usize>) {
        let mut faces = self.parts.iter().filter(|part| part.is_inside_out()).map(|part| part.first);
        let first = faces.next();
        (faces.count() + usize::from(first.is_some()), first)
    }
}

/// The corners of a triangle that is turned over; the first stays.
pub(crate) fn reversed<T>([a, b, c]: [T; 3]) -> [T; 3] {
    [a, c, b]
}
