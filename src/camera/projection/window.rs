//! The window of a projection.

use crate::math::Scalar;

/// The rectangle of the view plane that the viewport shows, in world units along the axes of view space: on the near plane for
/// a [frustum](crate::Projection::frustum), on any plane z = const for a parallel projection. (Foley et al., *Computer
/// Graphics*, 2nd ed., section 6.2; OpenGL: `left`, `right`, `bottom`, `top` of `glFrustum`.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Smallest x.
    pub left: Scalar,
    /// Largest x.
    pub right: Scalar,
    /// Smallest y.
    pub bottom: Scalar,
    /// Largest y.
    pub top: Scalar,
}

defmt_format!(
    [] Window, self,
    "[{=i32}, {=i32}] x [{=i32}, {=i32}]/65536",
    self.left.to_bits(), self.right.to_bits(), self.bottom.to_bits(), self.top.to_bits()
);
