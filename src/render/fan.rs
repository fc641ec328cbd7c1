//! What is drawn of a face: itself, or the triangles of a polygon that the planes left.

use super::{put, Cull, Ink};
use crate::camera::Image;
use crate::clip::{Carried, Order, CORNERS, PLACES};
use crate::raster::{self, Piece, ScreenPoint};
use heapless::Vec;

/// What becomes of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    Culled,
    Degenerate,
    Outside,
    /// With its corners as they are.
    Whole,
    /// As the planes leave it.
    Cut,
}

impl Outcome {
    #[inline(always)]
    pub(super) fn is_drawn(self) -> bool {
        matches!(self, Self::Whole | Self::Cut)
    }
}

impl Cull {
    /// Leaves out what has no area, or is turned away.
    #[inline(always)]
    pub(super) fn turned(self, area: i64, drawn: Outcome) -> Outcome {
        if area == 0 {
            Outcome::Degenerate
        } else if area < 0 && self == Self::Back {
            Outcome::Culled
        } else {
            drawn
        }
    }
}

/// The triangles of one face, one after the other. There is room for one face, used for all of a mesh.
pub(super) struct Pieces {
    corners: [Image; 3],
    /// [`raster::area`] of these: 0 when there is no triangle, or none any more.
    pub(super) area: i64,
    /// The corners of a face that was cut, none for a whole one.
    polygon: Vec<Image, CORNERS>,
    /// Where they were cut, which is where they are carried.
    order: Order,
    /// Whether it is taken from its last corner to its first.
    turned: bool,
    /// The second corner of this triangle; the first is the polygon's.
    at: u8,
}

impl Pieces {
    /// A whole face.
    #[inline(always)]
    pub(super) fn whole(&mut self, corners: [Image; 3], area: i64) {
        self.corners = corners;
        self.area = area;
        self.polygon.clear();
    }

    /// A convex polygon, with the area of all of it.
    pub(super) fn begin(&mut self, order: Order, image: impl Fn(usize) -> Image) {
        self.polygon.clear();
        for &at in &order {
            let _ = self.polygon.push(image(at.into())); // as many as the order can have
        }
        self.order = order;
        (self.turned, self.at) = (false, 0);
        let mut area = 0; // < 7·2⁴⁵
        while self.step() {
            area += self.area;
        }
        self.area = area;
    }

    /// Takes a polygon's only triangle for a whole face.
    pub(super) fn end(&mut self) {
        self.polygon.clear();
    }

    /// To the first triangle of a polygon, all of which are counter-clockwise from here on.
    pub(super) fn face_viewer(&mut self) {
        (self.turned, self.at) = (self.area < 0, 0);
        self.advance();
    }

    /// Where the polygon's corner of this number stands.
    fn place(&self, corner: usize) -> usize {
        if self.turned {
            self.polygon.len().wrapping_sub(corner + 1) // where there are not so many, none stands there
        } else {
            corner
        }
    }

    /// To the next triangle of the fan about the first corner, if there is one more.
    #[inline(never)] // rare: small is better
    fn step(&mut self) -> bool {
        let at = usize::from(self.at);
        let corner = |at: usize| self.polygon.get(self.place(at)).copied();
        let (Some(a), Some(b), Some(c)) = (corner(0), corner(at + 1), corner(at + 2)) else {
            return false;
        };
        self.corners = [a, b, c];
        self.area = raster::area(&self.points());
        self.at += 1;
        true
    }

    /// To the next triangle of the fan that faces as the polygon does: rounding of the corners may turn a
    /// sliver over, which would be drawn on top of its neighbour.
    #[cold]
    #[inline(never)]
    fn advance(&mut self) {
        while self.step() {
            if self.area > 0 {
                return;
            }
        }
        self.area = 0;
    }

    pub(super) fn points(&self) -> [ScreenPoint; 3] {
        self.corners.map(|c| c.point)
    }

    /// This triangle and its area, not zero.
    #[inline(always)]
    pub(super) fn piece(&self) -> Option<(&[Image; 3], i64)> {
        (self.area != 0).then_some((&self.corners, self.area))
    }

    /// To the next triangle.
    #[inline(always)]
    pub(super) fn next(&mut self) {
        if self.polygon.is_empty() {
            self.area = 0;
        } else {
            self.advance();
        }
    }

    /// Puts this triangle there, if there is one.
    #[cold]
    #[inline(never)]
    pub(super) fn put_into(&self, piece: &mut Piece<'_>) -> bool {
        let some = self.piece();
        if let Some((corners, area)) = some {
            put::<true>(piece, corners, area);
        }
        some.is_some()
    }

    /// The same with the next one.
    #[cold]
    #[inline(never)]
    pub(super) fn next_into(&mut self, piece: &mut Piece<'_>) -> bool {
        self.next();
        self.put_into(piece)
    }
}

/// What the corners of a face carry, whatever that is.
pub(super) trait Carries {
    /// Of the whole face.
    fn begin(&mut self);

    /// Takes it along where an edge is cut: see [`Cut::put`](crate::clip::Cut::put).
    fn carry(&mut self, at: usize, inside: usize, outside: usize, t: i32);
}

impl<K: Carried> Carries for [K; PLACES] {
    fn begin(&mut self) {
        for (corner, carried) in self.iter_mut().take(3).enumerate() {
            *carried = K::of(corner);
        }
    }

    fn carry(&mut self, at: usize, inside: usize, outside: usize, t: i32) {
        if let (Some(a), Some(b)) = (self.get(inside), self.get(outside)) {
            let carried = a.towards(b, t.into());
            if let Some(place) = self.get_mut(at) {
                *place = carried;
            }
        }
    }
}

/// The triangles of one face, with what their corners carry.
pub(super) struct Fan<K> {
    pub(super) pieces: Pieces,
    pub(super) carried: [K; PLACES],
}

impl<K: Carried> Fan<K> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let corner = Image { point: ScreenPoint::ORIGIN, depth: 0 };
        Self {
            pieces: Pieces {
                corners: [corner; 3],
                area: 0,
                polygon: Vec::new(),
                order: Vec::new(),
                turned: false,
                at: 0,
            },
            carried: [K::of(0); PLACES],
        }
    }

    /// What this triangle is filled with.
    #[inline(always)]
    pub(super) fn ink<I: Ink<Carried = K>>(&self, ink: &I) -> I {
        if self.pieces.polygon.is_empty() {
            *ink
        } else {
            let at = usize::from(self.pieces.at);
            ink.piece([0, at, at + 1].map(|corner| {
                let place = self.pieces.order.get(self.pieces.place(corner)).copied().unwrap_or(0);
                self.carried.get(usize::from(place)).copied().unwrap_or_else(|| K::of(0))
            }))
        }
    }
}
