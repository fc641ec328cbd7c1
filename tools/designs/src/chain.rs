//! What a design is: a vertex loop.

use crate::{Object, Vertex};
use core::hint::black_box;

/// A vertex on the screen: 8 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// In sub-pixels.
    pub x: i32,
    pub y: i32,
}

impl Corner {
    /// Of a vertex that must be clipped.
    pub const EMPTY: Self = Self { x: i32::MIN, y: 0 };
}

/// A number design, with the numbers of one object in it.
pub trait Design: Sized {
    type Vertex: Vertex;
    /// Sub-pixels in a pixel, as bits.
    const BITS: u32 = 8;
    /// Whether corners are measured from the viewport's centre, or from its top left.
    const FROM_CENTRE: bool = true;

    /// `None` where the design cannot show such an object.
    fn new(object: &Object) -> Option<Self>;
    /// What is counted: near test, projection, range test if integers could wrap, and snap.
    fn corner(&self, vertex: Self::Vertex) -> Corner;
    /// The same before the snap, in pixels, for a vertex that has a place.
    fn before_snap(&self, vertex: Self::Vertex) -> [f64; 2];
}

/// The vertex loop. Constants may stay in registers.
#[inline(never)]
pub fn hoisted<D: Design>(design: &D, vertices: &[D::Vertex], corners: &mut [Corner]) {
    for (corner, &vertex) in corners.iter_mut().zip(vertices) {
        *corner = design.corner(vertex);
    }
}

/// The vertex loop. Constants are loaded when needed: where registers are few, that spills less.
#[inline(never)]
pub fn loaded<D: Design>(design: &D, vertices: &[D::Vertex], corners: &mut [Corner]) {
    for (corner, &vertex) in corners.iter_mut().zip(vertices) {
        *corner = black_box(design).corner(vertex);
    }
}

/// Of corners, to tell that two machines compute the same.
pub fn checksum(corners: impl Iterator<Item = Corner>) -> u32 {
    // FNV-1a, by words.
    corners
        .flat_map(|c| [c.x, c.y])
        .fold(0x811c_9dc5, |sum, word| (sum ^ word as u32).wrapping_mul(0x0100_0193))
}
