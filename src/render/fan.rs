//! What is drawn of a face: itself, or the triangles of a polygon that the planes left.

use super::{put, Cull, Ink};
use crate::camera::Image;
use crate::clip::{Carried, Order, PLACES};
use crate::math::num::{after, keep_rolled};
use crate::math::Homogeneous;
use crate::raster::{self, Piece, Scissor};

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
    /// Corners: in clip space while planes cut, then on the screen.
    pub(super) places: [Homogeneous; PLACES],
    /// Where those of the polygon stand, which is where they are carried.
    pub(super) order: Order,
    /// Whether planes took something of the face.
    cut: bool,
    /// Whether the polygon is taken from its last corner to its first.
    turned: bool,
    /// Where the fan stands: the next triangle's corners are the first one, and the two behind this.
    at: u8,
}

impl Pieces {
    /// A face with all of its corners on the screen, to [begin](Self::begin) with.
    pub(super) fn whole(&mut self, corners: &[Image; 3]) {
        for (place, corner) in self.places.iter_mut().zip(corners) {
            *place = corner.held();
        }
        self.order.clear();
        let _ = self.order.extend_from_slice(&[0, 1, 2]); // there is room
    }

    /// A convex polygon, which is on the screen: what becomes of it. One that is not cut is farther out than corners reach, or
    /// was not kept.
    #[inline(never)] // its frame is gone when it returns
    pub(super) fn begin(&mut self, cull: Cull, cut: bool) -> Outcome {
        (self.cut, self.turned, self.at) = (cut, false, 0);
        let (mut area, mut corners) = (0, [Image::ORIGIN; 3]);
        while let Some(piece) = self.step(&mut corners) {
            area += piece; // < 7·2⁴⁵
        }
        // All triangles of one that was cut are counter-clockwise from here on.
        (self.turned, self.at) = (cut && area < 0, 0);
        cull.turned(area, if cut { Outcome::Cut } else { Outcome::Whole })
    }

    /// Where the polygon may cover pixels, though a piece may be left out.
    pub(super) fn reach(&self) -> Scissor {
        let mut reach = Scissor::NOTHING;
        for &at in &self.order {
            keep_rolled();
            if let Some(place) = self.places.get(usize::from(at)) {
                reach = reach.enclosing(&Scissor::of(&[Image::of_held(place).point; 3]));
            }
        }
        reach
    }

    /// Where the polygon's corner of this number stands.
    fn place(&self, corner: usize) -> usize {
        let corner = if self.turned { self.order.len().wrapping_sub(corner + 1) } else { corner };
        self.order.get(corner).map_or(PLACES, |&place| place.into()) // where there are not so many, none stands there
    }

    /// The next triangle of the fan about the first corner, and its area, if there is one more.
    #[inline(never)] // rare: small is better
    fn step(&mut self, corners: &mut [Image; 3]) -> Option<i64> {
        let at = usize::from(self.at);
        let mut i = 0;
        while let Some(image) = corners.get_mut(i) {
            let corner = if i == 0 { 0 } else { at + i };
            *image = Image::of_held(self.places.get(self.place(corner))?);
            i = after(i);
        }
        self.at += 1;
        Some(raster::area(&corners.map(|corner| corner.point)))
    }

    /// The next triangle of the fan that faces as the polygon does, and its area, not zero: rounding of the corners may
    /// turn a sliver over, which would be drawn on top of its neighbour.
    #[cold]
    #[inline(never)]
    pub(super) fn next(&mut self, corners: &mut [Image; 3]) -> Option<i64> {
        loop {
            let area = self.step(corners)?;
            if area > 0 || !self.cut {
                return Some(area);
            }
        }
    }

    /// Puts it there, if there is one.
    #[cold]
    #[inline(never)]
    pub(super) fn next_into(&mut self, piece: &mut Piece<'_>) -> bool {
        let mut corners = [Image::ORIGIN; 3];
        let area = self.next(&mut corners);
        if let Some(area) = area {
            put::<true>(piece, &corners, area);
        }
        area.is_some()
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
        Self {
            pieces: Pieces {
                places: [Homogeneous::ZERO; PLACES],
                order: Order::new(),
                cut: false,
                turned: false,
                at: 0,
            },
            carried: [K::of(0); PLACES],
        }
    }

    /// What the triangle that was last is filled with.
    #[inline(always)]
    pub(super) fn ink<I: Ink<Carried = K>>(&self, ink: &I) -> I {
        if self.pieces.cut {
            let at = usize::from(self.pieces.at);
            ink.piece([0, at, at + 1].map(|corner| {
                self.carried.get(self.pieces.place(corner)).copied().unwrap_or_else(|| K::of(0))
            }))
        } else {
            *ink
        }
    }
}
