//! What a design is: a vertex loop.

use crate::{Object, Vertex};
use core::hint::black_box;

/// A vertex on the screen: 8 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScreenVertex {
    /// In sub-pixels.
    pub x: i32,
    pub y: i32,
}

impl ScreenVertex {
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
    /// The counted part: near test, projection, range test if integers could wrap, and snap.
    fn corner(&self, vertex: Self::Vertex) -> ScreenVertex;
    /// The screen position before the snap, in pixels, of a vertex that has one.
    fn before_snap(&self, vertex: Self::Vertex) -> [f64; 2];
}

/// A loop over vertices.
pub type Loop<D> = fn(&D, &[<D as Design>::Vertex], &mut [ScreenVertex]);

/// The vertex loop, in the ways in which a compiler may be given it: it depends on the core and the design which is best.
pub fn ways<D: Design>() -> [Loop<D>; 4] {
    [hoisted::<D, false>, loaded::<D, false>, hoisted::<D, true>, loaded::<D, true>]
}

/// Constants may stay in registers.
#[inline(never)]
fn hoisted<D: Design, const POINTERS: bool>(
    design: &D,
    vertices: &[D::Vertex],
    corners: &mut [ScreenVertex],
) {
    each::<D, POINTERS>(vertices, corners, |vertex| design.corner(vertex));
}

/// Constants are loaded when needed: where registers are few, that spills less.
#[inline(never)]
fn loaded<D: Design, const POINTERS: bool>(design: &D, vertices: &[D::Vertex], corners: &mut [ScreenVertex]) {
    each::<D, POINTERS>(vertices, corners, |vertex| black_box(design).corner(vertex));
}

/// By an index, or by pointers. Of an index the compiler makes pointers in innermost loops alone, and normalising w may be
/// another.
#[inline(always)]
fn each<D: Design, const POINTERS: bool>(
    vertices: &[D::Vertex],
    corners: &mut [ScreenVertex],
    corner_of: impl Fn(D::Vertex) -> ScreenVertex,
) {
    if POINTERS {
        for (corner, &vertex) in corners.iter_mut().zip(&mut vertices.iter()) {
            *corner = corner_of(vertex);
        }
    } else {
        for (corner, &vertex) in corners.iter_mut().zip(vertices) {
            *corner = corner_of(vertex);
        }
    }
}

/// Of corners, to tell that two machines compute the same.
pub fn checksum(corners: impl Iterator<Item = ScreenVertex>) -> u32 {
    // FNV-1a, by words.
    corners
        .flat_map(|c| [c.x, c.y])
        .fold(0x811c_9dc5, |sum, word| (sum ^ word as u32).wrapping_mul(0x0100_0193))
}
