//! The edges of a mesh, and how the faces hang together along them.

use crate::normals::turn;
use crate::{Edges, Options, Problem, Topology};

/// One side of a face: an edge, the lower vertex first, the face, and whether the face runs along it upwards. In one
/// number, from the top, which is sorted fast in a build script too: 32 + 32 + 32 + 1 bits. A file of 2³⁰ bytes has fewer
/// vertices and faces than 2³².
#[derive(Clone, Copy)]
pub(crate) struct Side(u128);

impl Side {
    fn new([from, to]: [usize; 2], face: usize) -> Self {
        let (low, high) = (from.min(to) as u128, from.max(to) as u128);
        Side(low << 65 | high << 33 | (face as u128) << 1 | u128::from(from < to))
    }

    fn edge(self) -> [usize; 2] {
        [(self.0 >> 65) as u32 as usize, (self.0 >> 33) as u32 as usize]
    }

    pub(crate) fn face(self) -> usize {
        (self.0 >> 1) as u32 as usize
    }

    pub(crate) fn up(self) -> bool {
        self.0 & 1 == 1
    }
}

/// How the faces of an edge meet.
enum Meeting {
    /// Two faces, in opposite directions.
    Surface,
    Open,
    Twisted,
    Crowded,
}

/// The sides of all faces, sorted: those of an edge together, in the order of the faces.
pub(crate) struct Sides(Vec<Side>);

/// The place of the first face at each kind of fault.
#[derive(Default)]
pub(crate) struct Faults {
    pub(crate) open: Option<usize>,
    pub(crate) twisted: Option<usize>,
    pub(crate) crowded: Option<usize>,
}

impl Sides {
    pub(crate) fn of<I: Into<usize> + Copy>(faces: &[[I; 3]]) -> Self {
        let mut sides = Vec::with_capacity(faces.len() * 3);
        for (face, &corners) in faces.iter().enumerate() {
            let [a, b, c] = corners.map(Into::into);
            for ends in [[a, b], [b, c], [c, a]] {
                sides.push(Side::new(ends, face));
            }
        }
        sides.sort_unstable_by_key(|side: &Side| side.0);
        Sides(sides)
    }

    /// The sides of each edge.
    pub(crate) fn edges(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.edge() == b.edge())
    }

    /// Follows faces whose corners were reversed. The order stays, as the direction is the last bit.
    pub(crate) fn reverse(&mut self, is_reversed: impl Fn(usize) -> bool) {
        for side in &mut self.0 {
            side.0 ^= u128::from(is_reversed(side.face()));
        }
    }

    /// How often the surface is not closed or not oriented, and where first, by the faces' places in the file: a crowded
    /// edge is so from its third face on, a twisted one from its second.
    pub(crate) fn topology(&self, place: impl Fn(usize) -> usize) -> (Topology, Faults) {
        let (mut topology, mut first) = (Topology::default(), Faults::default());
        for sides in self.edges() {
            let (count, fault) = match meeting(sides) {
                Meeting::Surface => continue,
                Meeting::Open => (&mut topology.open, &mut first.open),
                Meeting::Twisted => (&mut topology.twisted, &mut first.twisted),
                Meeting::Crowded => (&mut topology.crowded, &mut first.crowded),
            };
            *count += 1;
            let mut places: Vec<usize> = sides.iter().map(|side| place(side.face())).collect();
            places.sort_unstable();
            let here = places[(places.len() - 1).min(2)];
            *fault = Some(fault.map_or(here, |earlier| earlier.min(here)));
        }
        (topology, first)
    }

    /// The edges that are wanted, features first if they are wanted first, otherwise in ascending order, and, if they are wanted, too, the
    /// faces beside each. `lines` are edges in
    /// ascending order, the lower vertex first, whether a face has them or not. `backs` are the faces that the mesh has a second time, reversed, after
    /// all `crosses.len()` of them: their edges are listed with the backs, too. `colors` are numbers of the faces' colours, or nothing.
    ///
    /// # Errors
    ///
    /// With the faces beside edges, [`Problem::TooManyFaces`]: 65535 stands for no face.
    pub(crate) fn select(
        &self,
        options: &Options,
        lines: &[[usize; 2]],
        crosses: &[[i64; 3]],
        backs: &[usize],
        colors: &[u8],
    ) -> Result<Selected, Problem> {
        let count = crosses.len() + backs.len();
        if options.edge_faces && count > usize::from(u16::MAX) {
            return Err(Problem::TooManyFaces(count));
        }
        let as_indices = |edge: [usize; 2]| edge.map(|vertex| vertex as u16); // a mesh has at most 65536 vertices
        let mut selected = Vec::new();
        let mut are_of_faces = vec![false; lines.len()];
        for sides in self.edges() {
            let line = lines.binary_search(&sides[0].edge()).ok();
            line.into_iter().for_each(|line| are_of_faces[line] = true);
            let is_feature = |degrees| match (meeting(sides), sides) {
                (Meeting::Surface, [a, b]) => turn(crosses[a.face()], crosses[b.face()]) > degrees,
                _ => true,
            };
            let has_two_colors = || matches!(sides, [a, b] if colors.get(a.face()) != colors.get(b.face()));
            let is_later = match options.edges {
                Edges::All => Some(false),
                Edges::None => None,
                Edges::Feature { degrees } => is_feature(degrees).then_some(false),
                Edges::CreasesFirst { degrees } => Some(!(is_feature(degrees) || has_two_colors())),
            };
            let Some(is_later) = is_later.or(line.map(|_| false)) else { continue };
            let edge = (is_later, as_indices(sides[0].edge()));
            if !options.edge_faces {
                selected.push((edge, NO_FACES));
                continue;
            }
            for pair in sides.chunks(2) {
                let face = |i: usize| pair.get(i).map_or(u16::MAX, |side| side.face() as u16);
                selected.push((edge, [face(0), face(1)]));
                let back = |i: usize| {
                    let place = backs.binary_search(&pair.get(i)?.face()).ok()?;
                    Some((crosses.len() + place) as u16) // below 65535
                };
                let two = [back(0), back(1)];
                if two != [None; 2] {
                    selected.push((edge, two.map(|back| back.unwrap_or(u16::MAX))));
                }
            }
        }
        let without_faces = lines.iter().zip(are_of_faces).filter(|(_, is_of_face)| !is_of_face);
        selected.extend(without_faces.map(|(&edge, _)| ((false, as_indices(edge)), NO_FACES)));
        selected.sort_by_key(|&(edge, _)| edge);
        let creases = match options.edges {
            Edges::CreasesFirst { .. } => Some(selected.partition_point(|&((is_later, _), _)| !is_later)),
            _ => None,
        };
        let (edges, mut beside): (Vec<_>, Vec<_>) =
            selected.into_iter().map(|((_, edge), beside)| (edge, beside)).unzip();
        if !options.edge_faces {
            beside.clear();
        }
        Ok(Selected { edges, creases, beside })
    }
}

/// Beside an edge that no face has.
const NO_FACES: [u16; 2] = [u16::MAX; 2];

pub(crate) struct Selected {
    pub(crate) edges: Vec<[u16; 2]>,
    pub(crate) creases: Option<usize>,
    pub(crate) beside: Vec<[u16; 2]>,
}

fn meeting(sides: &[Side]) -> Meeting {
    match sides {
        [_] => Meeting::Open,
        [a, b] if a.up() == b.up() => Meeting::Twisted,
        [_, _] => Meeting::Surface,
        _ => Meeting::Crowded,
    }
}
