//! Where fog begins, and where it is full.

use crate::math::Scalar;
use crate::shading::LightError;

/// Fog that begins at one distance from the camera, is full at another, and grows in between. Its *factor* is the part of
/// a colour that is still seen: all of it at `start` and nearer, none at `end` and beyond. (OpenGL 2.1 specification, section
/// 3.10, `GL_LINEAR`; Akenine-Möller et al., *Real-Time Rendering*, 4th ed., section 14.4.)
///
/// **Distance** is measured along the camera's axis, −n in view coordinates, in world units: fog does not change as the camera
/// turns about this axis, and all points of a plane parallel to the view plane are equally foggy.
///
/// | fog | type | work for each pixel | works with |
/// |---|---|---|---|
/// | by face or by vertex | [`VertexFog`](crate::fog::VertexFog) | none | whatever takes levels of light, and one colour a face |
/// | by pixel | [`FogTable`](crate::fog::FogTable), [`Fogged`](crate::fog::Fogged) | a mix of two colours; for faces of one colour in memory, a mix only where the level changes | every shader |
///
/// **Cost by pixel**, in instructions on a Cortex-M3 (`tools/bench/run cells S3 X1 G1 G3`), for a torus of 1000 faces that has
/// all 32 levels: with one colour a face 253 000 without fog and 670 000 in fog, which include depth at vertices and over faces;
/// with a depth buffer 540 000 and 780 000; textured, with a depth buffer, 926 000 and 1 954 000.
///
/// ```
/// use pinhole::{fog::Fog, Scalar};
/// let [near, far] = [4, 20].map(Scalar::from_int);
/// assert!(Fog::new(near, far).is_ok());
/// let error = Fog::new(far, near).unwrap_err();
/// assert_eq!(error.to_string(), "fog must begin before it is full: its start, 20, is not less than its end, 4");
/// # Ok::<(), pinhole::light::LightError>(())
/// ```
///
/// **Profiles.** A [`VertexFog`](crate::fog::VertexFog) grows linearly with the distance, a [`FogTable`](crate::fog::FogTable) linearly,
/// exponentially or by the square of the distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fog {
    start: Scalar,
    end: Scalar,
}

impl Fog {
    /// Fog between these distances, in world units. They may lie outside of the camera's near and far plane, and `start` may be
    /// negative: points there are behind the camera. [`Camera::framing`](crate::Camera::framing) with 40° puts the eye 3 radii
    /// from the centre of the sphere that it frames: fog from 2 to 4 radii goes through the object.
    ///
    /// # Errors
    ///
    /// [`LightError::EmptyFog`] if `start` is not less than `end`.
    pub const fn new(start: Scalar, end: Scalar) -> Result<Self, LightError> {
        match start.to_bits() < end.to_bits() {
            true => Ok(Self { start, end }),
            false => Err(LightError::EmptyFog { start, end }),
        }
    }

    /// Both distances in 2⁻¹⁶ world units.
    pub(super) const fn range(&self) -> [i32; 2] {
        [self.start.to_bits(), self.end.to_bits()]
    }
}

defmt_format!([] Fog, self, "fog from {} to {}", self.start, self.end);
