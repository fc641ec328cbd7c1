//! Fog at vertices.

use super::linear::Fog;
use crate::camera::Camera;
use crate::math::num::{add, mul_wide, scale};
use crate::math::unrolled::map3;
use crate::math::Affine;
use crate::space::{Model, World};

/// The factor of fog at the vertices of one object: fog that costs no instruction per pixel. The distance before the
/// camera is a linear form of a vertex's coordinates, and so is the factor between the fog's start and end: a vertex takes three
/// multiplications.
///
/// A factor is 256 without fog and 0 where nothing but fog is seen, so it can be used like a level of light:
///
/// - **a colour for each face**: `color.over(fog_color, factor)`, of [`Color`](crate::color::Color); for any target, [`Flat::in_fog`](crate::shading::Flat::in_fog);
/// - **interpolated over faces**: [`ShadeTable::in_fog`](crate::shading::ShadeTable::in_fog) fades one colour into fog; for lit faces,
///   [`Gouraud::new`](crate::shading::Gouraud::new) of three [`Flat::in_fog`](crate::shading::Flat::in_fog);
/// - **edges**: [`MeshInstance::edges`](crate::draw::MeshInstance::edges), the depth cue of wireframes.
///
/// **Error.** A factor is within ½ + 384·2⁻³⁰·r/(end − start) of the exact one, where r is the largest coordinate of the eye or of the
/// object's origin, plus that of the vertex relative to this origin, in world units. Between the corners of a face the factor is
/// linear on the screen, not in space; [`Fogged`](crate::fog::Fogged) is exact there.
///
/// ```
/// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
/// use pinhole::{fog::{Fog, VertexFog}, prelude::*, Angle};
/// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(8), Angle::ZERO, Angle::ZERO);
/// let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(100))?;
/// let camera = Camera::new(&view, &lens, &viewport); // at z = 8, towards −z
/// let fog = Fog::new(Scalar::from_int(4), Scalar::from_int(20))?;
/// let fog = VertexFog::new(&fog, &camera, &Affine::identity(), 0);
/// assert_eq!(fog.factor([3, 2, 0]), 192); // 8 before the camera, a quarter of the way
/// assert_eq!(fog.factor([0, 0, -90]), 0);
/// let seen = Rgb565::BLACK.over(Rgb565::WHITE, 192);
/// assert_eq!(seen, Rgb565::new(8, 16, 8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct VertexFog {
    /// The change of the factor over one unit of the mesh along each axis, in 2^−`shift` of 2⁻³²: 30 bits.
    linear: [i32; 3],
    shift: i32,
    /// The factor of the mesh's origin, in 2⁻³².
    offset: i64,
}

impl VertexFog {
    /// The fog before a camera on an object with the transform `model` and a mesh whose vertices are in 2^`exponent` model units, as
    /// [`Mesh::exponent`](crate::Mesh::exponent) says.
    #[inline(never)] // set-up: its stack frame is gone before faces are drawn
    pub fn new(fog: &Fog, camera: &Camera, model: &Affine<Model, World>, exponent: i8) -> Self {
        let row = camera.ramp(model, fog.range(), 256);
        Self { linear: row.linear, shift: row.exponent + i32::from(exponent) + 2, offset: row.offset }
    }

    /// The factor at a vertex, in the mesh's units as [`Mesh::vertices`](crate::Mesh::vertices) has them: 256, no fog, to 0, nothing but fog.
    #[inline]
    pub fn factor(&self, vertex: [i16; 3]) -> u16 {
        let [x, y, z] = map3(vertex, i32::from);
        let [a, b, c] = self.linear;
        let sum = mul_wide(a, x) + mul_wide(b, y) + mul_wide(c, z); // below 3·2⁴⁵
        let factor = add(scale(sum, self.shift), self.offset);
        (add(factor, 1 << 31) >> 32).clamp(0, 256) as u16
    }
}
