//! The object before a camera, in f64, from which every design makes its numbers.

use crate::num::dot;

/// A mesh of i16 vertices before a perspective camera. World coordinates; on the screen y runs downwards, and what is in
/// view lies at positive z.
#[derive(Clone, Copy, Debug)]
pub struct Object {
    /// From a vertex's integers to the world; the mesh's unit is a factor of it.
    pub model: [[f64; 3]; 3],
    pub place: [f64; 3],
    /// The camera's axes: right, down and forward.
    pub axes: [[f64; 3]; 3],
    pub eye: [f64; 3],
    /// Both in pixels.
    pub focal: f64,
    pub centre: [f64; 2],
    /// Distances.
    pub near: f64,
    pub far: f64,
}

impl Object {
    /// The largest coordinate of a vertex.
    pub const REACH: f64 = 32_768.0;

    /// Model to view: a vertex's integers to the camera's axes.
    pub fn linear(&self) -> [[f64; 3]; 3] {
        self.axes.map(|row| [0, 1, 2].map(|j| (0..3).map(|k| row[k] * self.model[k][j]).sum()))
    }

    /// The mesh's origin relative to the eye, in view coordinates.
    pub fn offset(&self) -> [f64; 3] {
        let from_eye = [0, 1, 2].map(|i| self.place[i] - self.eye[i]);
        self.axes.map(|row| dot(row, from_eye))
    }

    /// Where a point of the world, given relative to the eye, lies on the screen: pixels from the viewport's centre, and its
    /// distance.
    pub fn image(&self, from_eye: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|row| dot(row, from_eye));
        [x / z * self.focal, y / z * self.focal, z]
    }

    /// The least power of two, in pixels, that reaches beyond the picture from its centre.
    pub(crate) fn half_picture(&self) -> i32 {
        crate::num::log2_above(1.1 * self.centre[0].max(self.centre[1]))
    }
}
