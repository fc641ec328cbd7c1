//! The house that every view shows: the unit cube with a gable roof, and what is drawn on its faces.
//!
//! It stands on y = 0 with its front, the marked face, in z = 0; the ridge runs along z. It is convex, so an edge is
//! seen exactly where one of its two faces is.

use pinhole::Mesh;

/// Coordinates are in 1/16.
pub(crate) const EXPONENT: i8 = -4;

/// The five corners of the front, the five of the back, then the door's, the window's and the skylight's.
pub(crate) const VERTICES: [[i16; 3]; 24] = [
    [0, 0, 0],
    [16, 0, 0],
    [16, 16, 0],
    [8, 24, 0],
    [0, 16, 0],
    [0, 0, -16],
    [16, 0, -16],
    [16, 16, -16],
    [8, 24, -16],
    [0, 16, -16],
    // The door, left of the middle of the front.
    [3, 0, 0],
    [3, 9, 0],
    [7, 9, 0],
    [7, 0, 0],
    // The window in the right wall, and the ends of its bars.
    [16, 6, -5],
    [16, 6, -11],
    [16, 12, -11],
    [16, 12, -5],
    [16, 6, -8],
    [16, 12, -8],
    // The skylight in the right slope of the roof: x + y = 32.
    [14, 18, -4],
    [14, 18, -9],
    [11, 21, -9],
    [11, 21, -4],
];

/// A flat side of the surface.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Front,
    Back,
    Right,
    Left,
    Floor,
    RoofRight,
    RoofLeft,
}
use Side::{Back, Floor, Front, Left, Right, RoofLeft, RoofRight};

pub(crate) const FACES: [[u16; 3]; 16] = [
    [0, 1, 2],
    [0, 2, 4],
    [4, 2, 3],
    [6, 5, 9],
    [6, 9, 7],
    [7, 9, 8],
    [1, 6, 7],
    [1, 7, 2],
    [5, 0, 4],
    [5, 4, 9],
    [5, 6, 1],
    [5, 1, 0],
    [2, 7, 8],
    [2, 8, 3],
    [9, 4, 3],
    [9, 3, 8],
];

/// The side that each face belongs to.
pub(crate) const SIDES: [Side; 16] = [
    Front, Front, Front, Back, Back, Back, Right, Right, Left, Left, Floor, Floor, RoofRight, RoofRight,
    RoofLeft, RoofLeft,
];

impl Side {
    /// Outwards, 32 767 long.
    pub(crate) fn normal(self) -> [i16; 3] {
        const ONE: i16 = 32_767;
        /// 1/√2.
        const SLANT: i16 = 23_170;
        match self {
            Front => [0, 0, ONE],
            Back => [0, 0, -ONE],
            Right => [ONE, 0, 0],
            Left => [-ONE, 0, 0],
            Floor => [0, -ONE, 0],
            RoofRight => [SLANT, SLANT, 0],
            RoofLeft => [-SLANT, SLANT, 0],
        }
    }
}

/// The edges of the body with the two sides that meet there. The first three leave the origin along x, y and z.
pub(crate) const EDGES: [([u16; 2], [Side; 2]); 15] = [
    ([0, 1], [Front, Floor]),
    ([0, 4], [Front, Left]),
    ([0, 5], [Left, Floor]),
    ([1, 2], [Front, Right]),
    ([2, 3], [Front, RoofRight]),
    ([3, 4], [Front, RoofLeft]),
    ([5, 6], [Back, Floor]),
    ([6, 7], [Back, Right]),
    ([7, 8], [Back, RoofRight]),
    ([8, 9], [Back, RoofLeft]),
    ([9, 5], [Back, Left]),
    ([1, 6], [Right, Floor]),
    ([2, 7], [Right, RoofRight]),
    ([3, 8], [RoofLeft, RoofRight]),
    ([4, 9], [Left, RoofLeft]),
];

/// Lines on a side, visible where the side is.
pub(crate) const DRAWN: [([u16; 2], Side); 12] = [
    ([10, 11], Front),
    ([11, 12], Front),
    ([12, 13], Front),
    ([14, 15], Right),
    ([15, 16], Right),
    ([16, 17], Right),
    ([17, 14], Right),
    ([18, 19], Right),
    ([20, 21], RoofRight),
    ([21, 22], RoofRight),
    ([22, 23], RoofRight),
    ([23, 20], RoofRight),
];

/// The surface.
pub(crate) const HOUSE: Mesh<'static> = match Mesh::new(&VERTICES, EXPONENT, &FACES) {
    Ok(mesh) => mesh,
    Err(_) => panic!("faces"), // at compile time
};
