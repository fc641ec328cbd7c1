//! Bounding spheres.

use super::{Point3, Scalar};
use crate::space::Model;

/// A bounding sphere of a mesh, in model coordinates.
///
/// ```
/// use pinhole::{Mesh, Scalar, Sphere};
/// const VERTICES: [[i16; 3]; 2] = [[-3, 0, 0], [1, 0, 0]];
/// let mesh = Mesh::new(&VERTICES, 0, &[]).unwrap();
/// let sphere: Sphere = mesh.bounding_sphere();
/// assert!(sphere.radius >= Scalar::from_num(2) && sphere.radius < Scalar::from_num(2.01));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sphere {
    /// The centre, in model units.
    pub centre: Point3<Model>,
    /// The radius, in model units. A negative radius counts as zero. `Scalar::MAX` stands for a radius beyond the range of
    /// [`Scalar`]: such a sphere is always [`Partly`](crate::Visibility::Partly) visible.
    pub radius: Scalar,
}

#[cfg(feature = "defmt")]
impl defmt::Format for Sphere {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{} radius {=i32}/65536", self.centre, self.radius.to_bits());
    }
}
