//! Scenes through the library onto recorders, with a colour type that no library knows.

use crate::oracle::target::{Recorder, Refused};
use embedded_graphics_core::pixelcolor::raw::RawU16;
use embedded_graphics_core::pixelcolor::PixelColor;
use pinhole::{Corner, Placed, Statistics};

/// A foreign colour: the index of the face (or whatever the test likes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ink(pub(crate) u16);

impl PixelColor for Ink {
    type Raw = RawU16;
}

/// The cube −1 … 1 in i16: vertex k has x, y, z = ±1 by bits 0, 1, 2.
pub(crate) const CUBE: [[i16; 3]; 8] =
    [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]];

/// Counter-clockwise from outside: +x, −x, +y, −y, +z, −z, two each.
pub(crate) const CUBE_FACES: [[u16; 3]; 12] = [
    [1, 3, 7],
    [1, 7, 5],
    [0, 4, 6],
    [0, 6, 2],
    [2, 6, 7],
    [2, 7, 3],
    [0, 1, 5],
    [0, 5, 4],
    [4, 5, 7],
    [4, 7, 6],
    [0, 2, 3],
    [0, 3, 1],
];

/// The same seen from inside.
pub(crate) fn room_faces() -> [[u16; 3]; 12] {
    CUBE_FACES.map(|[a, b, c]| [a, c, b])
}

pub(crate) const CUBE_EDGES: [[u16; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Front faces in mesh order; face k in Ink(k).
pub(crate) fn solid(placed: &Placed<'_>, target: &mut Recorder<Ink>) -> Result<Statistics, Refused> {
    let mut cache = [Corner::default(); 64];
    placed.solid(|face| Ink(face as u16), &mut cache, target)
}

pub(crate) fn wireframe(placed: &Placed<'_>, target: &mut Recorder<Ink>) -> Result<Statistics, Refused> {
    let mut cache = [Corner::default(); 64];
    placed.wireframe(Ink(7), &mut cache, target)
}
