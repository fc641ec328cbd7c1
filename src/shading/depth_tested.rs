//! Faces of a painter that are tested against a depth buffer.

use super::shader::inner_with_corners;
use super::{CornerValues, Shader};

/// A shader with the depths of its triangle's corners, for a [`Painter`](crate::draw::Painter) whose faces are drawn from far to near and
/// tested against a depth buffer: [`Painter::draw`](crate::draw::Painter::draw), in bands
/// [`PaintersOrder::draw`](crate::draw::PaintersOrder::draw). It takes 12 bytes a face more than the shader.
///
/// This is how translucent faces are drawn among opaque ones: opaque faces first, with the depth buffer; then the painter's faces,
/// whose depth is tested and, if they are [`Translucent`](crate::shading::Translucent), not stored.
///
/// ```
/// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
/// use pinhole::{color::Half, prelude::*, shading::{DepthTested, Translucent}, Angle};
/// const VERTICES: [[i16; 3]; 3] = [[-2, -2, 0], [2, -2, 0], [0, 2, 0]];
/// let mesh = Mesh::new(&VERTICES, 0, &[[0, 1, 2]])?;
/// let viewport = Viewport::new(Point::zero(), Size::new(32, 32))?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(8), Angle::ZERO, Angle::ZERO);
/// let lens = Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_int(1), Scalar::from_int(20))?;
/// let camera = Camera::new(&view, &lens, &viewport);
/// let at = |z| camera.place(&mesh, &Affine::translation(Vector3::from_ints(0, 0, z)));
/// let (mut pixels, mut depths) = ([Gray8::BLACK; 32 * 32], [0; 32 * 32]);
/// let mut picture = Picture::new(&mut pixels, viewport.size())?;
/// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
/// // A wall, then three panes: one behind it, and two before it, of which the nearer one is added first.
/// at(0).faces(|_| Gray8::new(100)).draw(&mut picture.pixels().depth_tested(&mut depth))?;
/// let mut painter = Painter::<DepthTested<Translucent<Gray8, Half>>, 9, 3>::new();
/// for (z, luma) in [(2, 200), (1, 0), (-1, 255)] {
///     at(z).faces(|_| DepthTested::new(Translucent::new(Gray8::new(luma), Half))).sorted(&mut painter)?;
/// }
/// painter.draw(&mut picture.pixels().depth_tested(&mut depth))?;
/// assert_eq!(picture.colors()[16 * 32 + 16], Gray8::new(125)); // (200 + (0 + 100) / 2) / 2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DepthTested<S> {
    shader: S,
    /// At the corners, in 16.8.
    depths: [i32; 3],
}

impl<S> DepthTested<S> {
    /// A shader for a face whose depth is tested.
    pub const fn new(shader: S) -> Self {
        Self { shader, depths: [0; 3] }
    }

    /// The shader, and the depths of the triangle's corners in 16.8.
    #[inline(always)]
    pub(crate) const fn parts(&self) -> (&S, [i32; 3]) {
        (&self.shader, self.depths)
    }
}

impl<S: Shader> Shader for DepthTested<S> {
    type Varying = S::Varying;
    const NEEDS_DEPTH: bool = true;
    const NEEDS_W: bool = S::NEEDS_W;

    fn sub_face(&self, corners: [S::Varying; 3]) -> Self {
        Self { shader: self.shader.sub_face(corners), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        Self { shader: inner_with_corners(&self.shader, corners), depths: corners.depths() }
    }
}
