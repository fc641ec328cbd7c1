//! What all lights have in common.

/// A light on one object: the level of light of a face or a vertex, from its normal. [`Lambert`](crate::light::Lambert) is the simplest.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a light",
    label = "not a `Light`",
    note = "use `Lambert`, or another type of the module `light`, or implement `Light`"
)]
pub trait Light {
    /// The light level, 0 … 256, of a face or a vertex with this unit normal (model space, in 2⁻¹⁵). Each light documents its formula and
    /// its error.
    fn level(&self, normal: [i16; 3]) -> u16;

    /// Writes the [`level`](Self::level) of each normal to `levels`, up to the end of the shorter slice. Call it once per frame
    /// for smooth shading with [`Gouraud`](crate::shading::Gouraud) or a [`ShadeTable`](crate::shading::ShadeTable). The normals are those of
    /// vertices: a mesh without [`vertex_normals`](crate::Mesh::vertex_normals) has an empty list, no level is written, and its faces come out
    /// black.
    ///
    /// ```
    /// use pinhole::prelude::*;
    /// let light = Lambert::new(&Affine::<Model, World>::identity(), Vector3::from_ints(0, 0, 1), 56)?;
    /// let mut levels = [0; 3];
    /// light.levels(&[[0, 0, 32767], [28377, 0, 16384], [32767, 0, 0]], &mut levels); // 0, 60 and 90 degrees
    /// assert_eq!(levels, [256, 156, 56]);
    /// # Ok::<(), pinhole::light::LightError>(())
    /// ```
    fn levels(&self, normals: &[[i16; 3]], levels: &mut [u16]) {
        for (level, &normal) in levels.iter_mut().zip(normals) {
            *level = self.level(normal);
        }
    }
}
