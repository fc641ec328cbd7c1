//! The house that every view shows: the unit cube with a gable roof, and what is drawn on its faces.
//!
//! It stands on y = 0 with its front, the marked face, in z = 0; the ridge runs along z.

use embedded_graphics::pixelcolor::Rgb888;

pub(crate) const MARKED: Rgb888 = Rgb888::new(255, 210, 92);
const WALL: Rgb888 = Rgb888::new(240, 234, 222);
const ROOF: Rgb888 = Rgb888::new(226, 146, 118);
const FLOOR: Rgb888 = Rgb888::new(190, 198, 208);

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

/// Front, back, right, left, floor, and the right and the left slope of the roof.
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

/// The normal of a face, 32 767 long, and its colour.
pub(crate) fn look(face: usize) -> ([i16; 3], Rgb888) {
    const ONE: i16 = 32_767;
    /// 1/√2.
    const SLANT: i16 = 23_170;
    match face {
        0..=2 => ([0, 0, ONE], MARKED),
        3..=5 => ([0, 0, -ONE], WALL),
        6..=7 => ([ONE, 0, 0], WALL),
        8..=9 => ([-ONE, 0, 0], WALL),
        10..=11 => ([0, -ONE, 0], FLOOR),
        12..=13 => ([SLANT, SLANT, 0], ROOF),
        _ => ([-SLANT, SLANT, 0], ROOF),
    }
}

/// The edges of the body, of which the last three leave the origin along z, y and x.
pub(crate) const EDGES: [[u16; 2]; 15] = [
    [1, 2],
    [2, 3],
    [3, 4],
    [5, 6],
    [6, 7],
    [7, 8],
    [8, 9],
    [9, 5],
    [1, 6],
    [2, 7],
    [3, 8],
    [4, 9],
    [0, 5],
    [0, 4],
    [0, 1],
];

/// Lines on the front, on the right wall and on the right slope.
pub(crate) const DRAWN: [[u16; 2]; 12] = [
    [10, 11],
    [11, 12],
    [12, 13],
    [14, 15],
    [15, 16],
    [16, 17],
    [17, 14],
    [18, 19],
    [20, 21],
    [21, 22],
    [22, 23],
    [23, 20],
];

/// A face that one of these lines lies on.
pub(crate) fn face_of(line: usize) -> u16 {
    match line {
        0..=2 => 0,
        3..=7 => 6,
        _ => 12,
    }
}
