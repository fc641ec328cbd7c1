//! The edges of a mesh, and how the faces hang together along them.

use crate::normals::turn;
use crate::{Edges, Problem, Topology};

/// One side of a face: an edge, the lower vertex first, the face, and whether the face runs along it upwards. In one
/// number, from the top, which is sorted fast in a build script too: 16 + 16 + 31 + 1 bits. No file has 2³¹ faces.
#[derive(Clone, Copy)]
struct Side(u64);

impl Side {
    fn new([from, to]: [u16; 2], face: usize) -> Self {
        let (low, high) = (u64::from(from.min(to)), u64::from(from.max(to)));
        Side(low << 48 | high << 32 | (face as u64) << 1 | u64::from(from < to))
    }

    fn edge(self) -> [u16; 2] {
        [(self.0 >> 48) as u16, (self.0 >> 32) as u16]
    }

    fn face(self) -> usize {
        (self.0 as u32 >> 1) as usize
    }

    fn up(self) -> bool {
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
    pub(crate) fn of(faces: &[[u16; 3]]) -> Self {
        let mut sides = Vec::with_capacity(faces.len() * 3);
        for (face, &[a, b, c]) in faces.iter().enumerate() {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                sides.push(Side::new([from, to], face));
            }
        }
        sides.sort_unstable_by_key(|side: &Side| side.0);
        Sides(sides)
    }

    fn edges(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.edge() == b.edge())
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

    /// The edges that are wanted, in ascending order, and with `beside` the faces beside each.
    ///
    /// # Errors
    ///
    /// With `beside`, [`Problem::TooManyFaces`]: 65535 stands for no face.
    pub(crate) fn select(
        &self,
        edges: Edges,
        beside: bool,
        crosses: &[[i64; 3]],
    ) -> Result<Selected, Problem> {
        let mut selected = Selected::default();
        if beside && crosses.len() > usize::from(u16::MAX) {
            return Err(Problem::TooManyFaces(crosses.len()));
        }
        for sides in self.edges() {
            let wanted = match edges {
                Edges::All => true,
                Edges::None => false,
                Edges::Feature { degrees } => match (meeting(sides), sides) {
                    (Meeting::Surface, [a, b]) => turn(crosses[a.face()], crosses[b.face()]) > degrees,
                    _ => true,
                },
            };
            if wanted && beside {
                for pair in sides.chunks(2) {
                    let face = |i: usize| pair.get(i).map_or(u16::MAX, |side| side.face() as u16);
                    selected.edges.push(sides[0].edge());
                    selected.beside.push([face(0), face(1)]);
                }
            } else if wanted {
                selected.edges.push(sides[0].edge());
            }
        }
        Ok(selected)
    }
}

#[derive(Default)]
pub(crate) struct Selected {
    pub(crate) edges: Vec<[u16; 2]>,
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
