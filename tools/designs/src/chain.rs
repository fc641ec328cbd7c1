//! What a design is: a vertex loop.

use crate::{Object, Vertex};
use core::hint::black_box;

/// A vertex on the screen: 8 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScreenVertex {
    /// The horizontal position in sub-pixels.
    pub x: i32,
    pub y: i32,
}

impl ScreenVertex {
    /// The vertex of a point that must be clipped.
    pub const EMPTY: Self = Self { x: i32::MIN, y: 0 };
}

/// A number design, set up for one object.
pub trait Design: Sized {
    type Vertex: Vertex;
    /// The number of sub-pixels in a pixel, as a power of two.
    const BITS: u32 = 8;
    /// Whether corners are measured from the viewport's centre, or from its top left.
    const FROM_CENTRE: bool = true;

    /// Sets the design up. `None` if it cannot show such an object.
    fn new(object: &Object) -> Option<Self>;
    /// The counted part: near test, projection, range test if integers could wrap, and snap.
    fn corner(&self, vertex: Self::Vertex) -> ScreenVertex;
    /// The screen position before the snap, in pixels, of a vertex that has one.
    fn before_snap(&self, vertex: Self::Vertex) -> [f64; 2];
}

/// A loop over vertices.
pub type Loop<D> = fn(&D, &[<D as Design>::Vertex], &mut [ScreenVertex]);

/// The vertex loop in the forms that a compiler may be given: which one is fastest depends on the core and the design.
pub fn ways<D: Design>() -> [Loop<D>; 4] {
    [hoisted::<D, false>, loaded::<D, false>, hoisted::<D, true>, loaded::<D, true>]
}

/// With constants that may stay in registers.
#[inline(never)]
fn hoisted<D: Design, const POINTERS: bool>(
    design: &D,
    vertices: &[D::Vertex],
    corners: &mut [ScreenVertex],
) {
    each::<D, POINTERS>(vertices, corners, |vertex| design.corner(vertex));
}

/// With constants that are loaded when they are needed, which spills less where registers are few.
#[inline(never)]
fn loaded<D: Design, const POINTERS: bool>(design: &D, vertices: &[D::Vertex], corners: &mut [ScreenVertex]) {
    each::<D, POINTERS>(vertices, corners, |vertex| black_box(design).corner(vertex));
}

/// With an index or with pointers. The compiler turns an index into pointers in innermost loops only, and the normalising of w
/// may contain a loop.
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

/// A checksum of corners, to compare what two machines compute.
pub fn checksum(corners: impl Iterator<Item = ScreenVertex>) -> u32 {
    // FNV-1a, by words.
    corners
        .flat_map(|c| [c.x, c.y])
        .fold(0x811c_9dc5, |sum, word| (sum ^ word as u32).wrapping_mul(0x0100_0193))
}
