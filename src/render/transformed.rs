//! Vertices on the screen, and what becomes of faces and edges there.

use super::{Cull, Placed};
use crate::camera::{Corner, Image};
use crate::clip::{self, Carried};
use crate::math::{Coordinate, Homogeneous};
use crate::raster::{self, ScreenPoint};
use heapless::Vec;

/// A placed mesh with its vertices on the screen, each transformed once. `DEPTH` tells whether their
/// depth was computed too.
///
/// Vertices beyond the end of the corners lent are computed whenever a face or an edge needs them: the
/// picture is the same, so a mesh may be larger than its storage. [`Placed::transform`] has an example.
#[derive(Clone, Copy, Debug)]
pub struct Transformed<'a, V = i16, const DEPTH: bool = false> {
    pub(super) placed: Placed<'a, V>,
    corners: &'a [Corner],
}

/// A corner of a cut face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<K> {
    pub(super) image: Image,
    pub(super) carried: K,
}

/// What becomes of a face.
pub(super) enum Outcome<K> {
    Culled,
    Degenerate,
    Outside,
    /// All corners as they are, and [`raster::area`].
    Whole([Image; 3], i64),
    /// What the planes leave, as a fan.
    Cut(Vec<Piece<K>, { clip::CORNERS }>),
}

impl<'a, V: Coordinate, const DEPTH: bool> Transformed<'a, V, DEPTH> {
    /// Fills the corners from the start of the vertex list.
    pub(super) fn new(placed: Placed<'a, V>, corners: &'a mut [Corner]) -> Self {
        for (corner, &vertex) in corners.iter_mut().zip(placed.mesh.vertices()) {
            *corner = placed.placement.project::<V, DEPTH>(vertex);
        }
        Self { placed, corners }
    }

    /// With corners that were filled elsewhere.
    pub(super) fn with_corners(placed: Placed<'a, V>, corners: &'a [Corner]) -> Self {
        Self { placed, corners }
    }

    #[inline(always)]
    pub(super) fn corner(&self, index: u16) -> Corner {
        match self.corners.get(usize::from(index)) {
            Some(corner) => *corner,
            None => self.uncached(index),
        }
    }

    #[cold]
    fn uncached(&self, index: u16) -> Corner {
        let vertex = self.placed.mesh.vertices().get(usize::from(index)); // checked by Mesh: always there
        vertex.map_or(Corner::EMPTY, |&v| self.placed.placement.project::<V, DEPTH>(v))
    }

    /// The vertex in clip space; the indices were checked by [`Mesh`](crate::Mesh).
    fn clip_vertex(&self, index: u16) -> Option<Homogeneous> {
        self.placed.mesh.vertices().get(usize::from(index)).map(|&v| self.placed.placement.clip(v))
    }

    /// The ends of an edge on the screen and whether the planes took anything of it, or `None` when
    /// they take it all.
    #[inline(always)]
    pub(super) fn edge(&self, [a, b]: [u16; 2]) -> Option<([Image; 2], bool)> {
        let (from, to) = (self.corner(a), self.corner(b));
        if from.whole() && to.whole() {
            let placement = &self.placed.placement;
            Some(([placement.at(from), placement.at(to)], false))
        } else {
            self.cut_edge(a, b)
        }
    }

    #[cold]
    fn cut_edge(&self, a: u16, b: u16) -> Option<([Image; 2], bool)> {
        let placement = &self.placed.placement;
        let whole = (self.clip_vertex(a)?, self.clip_vertex(b)?);
        let (a, b) = clip::line_at(whole.0, whole.1, placement.planes(), |i, p| placement.distance(i, p))?;
        Some(([placement.image(&a), placement.image(&b)], (a, b) != whole))
    }

    /// Step 3 of the pipeline, for one face.
    #[inline(always)]
    pub(super) fn sort_out<K: Carried>(&self, face: [u16; 3]) -> Outcome<K> {
        let corners = face.map(|i| self.corner(i));
        let [a, b, c] = corners;
        if !(a.whole() && b.whole() && c.whole()) {
            return self.cut_face(face);
        }
        let area = raster::area(&[a.offset(), b.offset(), c.offset()]);
        self.turned(area, || Outcome::Whole(corners.map(|corner| self.placed.placement.at(corner)), area))
    }

    /// Leaves out what has no area, or is turned away.
    #[inline(always)]
    fn turned<K>(&self, area: i64, drawn: impl FnOnce() -> Outcome<K>) -> Outcome<K> {
        if area == 0 {
            Outcome::Degenerate
        } else if area < 0 && self.placed.cull == Cull::Back {
            Outcome::Culled
        } else {
            drawn()
        }
    }

    #[cold]
    fn cut_face<K: Carried>(&self, [a, b, c]: [u16; 3]) -> Outcome<K> {
        let placement = &self.placed.placement;
        let (Some(a), Some(b), Some(c)) = (self.clip_vertex(a), self.clip_vertex(b), self.clip_vertex(c))
        else {
            return Outcome::Outside;
        };
        let distance = |i: usize, p: &(Homogeneous, K)| placement.distance(i, &p.0);
        let face = [(a, K::of(0)), (b, K::of(1)), (c, K::of(2))];
        if face.iter().all(|p| clip::outcode(p, placement.planes(), distance) == 0) {
            // Only farther out than corners reach.
            let corners = face.map(|(point, _)| placement.image(&point));
            let area = raster::area(&corners.map(|c| c.point));
            return self.turned(area, || Outcome::Whole(corners, area));
        }
        let polygon = clip::triangle_at(face, placement.planes(), distance);
        if polygon.len() < 3 {
            return Outcome::Outside;
        }
        let mut corners = Vec::<Piece<K>, { clip::CORNERS }>::new();
        for (point, carried) in &polygon {
            // As many as the polygon can have.
            let _ = corners.push(Piece { image: placement.image(point), carried: *carried });
        }
        let area: i64 = fan(&corners).map(|piece| raster::area(&points(&piece))).sum(); // < 7·2⁴⁵
        self.turned(area, || {
            if area < 0 {
                corners.reverse(); // pieces are counter-clockwise from here on
            }
            Outcome::Cut(corners)
        })
    }
}

/// The triangles of a convex polygon about its first corner.
fn fan<K: Copy>(corners: &[Piece<K>]) -> impl Iterator<Item = [Piece<K>; 3]> + '_ {
    corners.split_first().into_iter().flat_map(|(&first, rest)| {
        rest.windows(2).filter_map(move |pair| match *pair {
            [a, b] => Some([first, a, b]),
            _ => None,
        })
    })
}

/// Those triangles of the fan that face as the polygon does, each with its area: rounding of the
/// corners may turn a sliver over, which would be drawn on top of its neighbour.
pub(super) fn pieces<K: Copy>(corners: &[Piece<K>]) -> impl Iterator<Item = ([Piece<K>; 3], i64)> + '_ {
    fan(corners).map(|piece| (piece, raster::area(&points(&piece)))).filter(|&(_, area)| area > 0)
}

fn points<K: Copy>(piece: &[Piece<K>; 3]) -> [ScreenPoint; 3] {
    piece.map(|corner| corner.image.point)
}

#[cfg(feature = "defmt")]
impl<V, const DEPTH: bool> defmt::Format for Transformed<'_, V, DEPTH> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{}, {=usize} corners kept", self.placed, self.corners.len());
    }
}
