//! The types of a design's vertices. The error of a design is measured from the vertex in its type.

use crate::num::{dot, nearest32};
use crate::Object;

pub trait Vertex: Copy {
    /// The mesh's vertex, rounded to the bits of this type.
    fn of(object: &Object, vertex: [i16; 3]) -> Self;
    /// The exact position of this vertex in the world, relative to the eye.
    fn relative(self, object: &Object) -> [f64; 3];
}

fn in_world(object: &Object, vertex: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| dot(object.model[i], vertex) + (object.place[i] - object.eye[i]))
}

/// 6 bytes for each vertex.
impl Vertex for [i16; 3] {
    fn of(_: &Object, vertex: [i16; 3]) -> Self {
        vertex
    }
    fn relative(self, object: &Object) -> [f64; 3] {
        in_world(object, self.map(f64::from))
    }
}

/// 12 bytes for each vertex: the same integers.
impl Vertex for [f32; 3] {
    fn of(_: &Object, vertex: [i16; 3]) -> Self {
        vertex.map(f32::from)
    }
    fn relative(self, object: &Object) -> [f64; 3] {
        in_world(object, self.map(f64::from))
    }
}

/// The upper `KEPT` of a coordinate's 16 bits.
#[derive(Clone, Copy)]
pub(crate) struct Coarse<const KEPT: u32, T>([T; 3]);

impl<const KEPT: u32, T: Copy + Into<i32>> Coarse<KEPT, T> {
    pub(crate) const DROPPED: u32 = 16 - KEPT;
    #[inline(always)]
    pub(crate) fn integers(self) -> [i32; 3] {
        self.0.map(Into::into)
    }
}

impl<const KEPT: u32, T: Copy + Into<i32> + TryFrom<i16> + Default> Vertex for Coarse<KEPT, T> {
    fn of(_: &Object, vertex: [i16; 3]) -> Self {
        Self(vertex.map(|c| T::try_from(c >> Self::DROPPED).unwrap_or_default()))
    }
    fn relative(self, object: &Object) -> [f64; 3] {
        in_world(object, self.integers().map(|c| f64::from(c << Self::DROPPED)))
    }
}

/// 12 bytes for each vertex: a point of the world in 2⁻¹⁶, turned and moved beforehand.
#[derive(Clone, Copy)]
pub(crate) struct InWorld(pub(crate) [i32; 3]);

impl Vertex for InWorld {
    fn of(object: &Object, vertex: [i16; 3]) -> Self {
        let vertex = vertex.map(f64::from);
        Self([0, 1, 2].map(|i| nearest32((dot(object.model[i], vertex) + object.place[i]) * 65536.0)))
    }
    fn relative(self, object: &Object) -> [f64; 3] {
        [0, 1, 2].map(|i| f64::from(self.0[i]) / 65536.0 - object.eye[i])
    }
}
