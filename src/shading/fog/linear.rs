//! Where fog begins, and where it is full.

use super::profile::{ExponentialFog, LinearFog, SquaredFog};
use crate::math::Scalar;
use crate::shading::LightError;
use core::marker::PhantomData;

/// Fog that begins at one distance from the camera, is full at another, and by default grows linearly in between. Its *factor* is the part of
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
/// all 32 levels: with one colour a face 252 000 without fog and 683 000 in fog, which include depth at vertices and over faces;
/// with a depth buffer 534 000 and 803 000; textured, with a depth buffer, 1 099 000 and 2 246 000.
///
/// ```
/// use pinhole::{fog::Fog, light::LightError, Scalar};
/// let [near, far] = [4, 20].map(Scalar::from_int);
/// let fog = Fog::linear(near, far)?;
/// assert_eq!([fog.start(), fog.end()], [near, far]);
/// let error = Fog::linear(far, near).unwrap_err();
/// assert_eq!(error.to_string(), "fog must begin before it is full: its start, 20, is not less than its end, 4");
/// # Ok::<(), LightError>(())
/// ```
///
/// **Other profiles.** [`exponential`](Fog::exponential) and [`squared`](Fog::squared) fog exist by pixel only. The profile is
/// part of the fog's type, `P`, so a program links only the profiles that it uses.
#[derive(Debug, PartialEq, Eq)]
pub struct Fog<P = LinearFog> {
    start: Scalar,
    end: Scalar,
    profile: PhantomData<P>,
}

impl<P> Clone for Fog<P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Fog<P> {}

impl Fog<LinearFog> {
    /// Fog between these distances, in world units. They may lie outside of the camera's near and far plane, and `start` may be
    /// negative: points there are behind the camera.
    ///
    /// # Errors
    ///
    /// [`LightError::EmptyFog`] if `start` is not less than `end`.
    pub const fn linear(start: Scalar, end: Scalar) -> Result<Self, LightError> {
        Self::between(start, end)
    }
}

impl Fog<ExponentialFog> {
    /// Fog of constant density (`GL_EXP`): over each unit of distance from `start` on, a colour loses an equal part of what is
    /// left of it. At the part t of the way from `start` to `end`, 64^(−t) is left. At `end` and beyond, less than 1/64 is left,
    /// which is rounded to none.
    ///
    /// OpenGL's density d, with fog from the eye on, is ln 64/d = 4.159/d for `end` and 0 for `start`. For a [`FogTable`](crate::fog::FogTable)
    /// only: the factor is not linear in the distance, so a [`VertexFog`](crate::fog::VertexFog) does not take it.
    ///
    /// ```
    /// use pinhole::{fog::Fog, Scalar};
    /// let density = 0.25;
    /// let haze = Fog::exponential(Scalar::ZERO, Scalar::from_f32(4.159 / density)?)?;
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`LightError::EmptyFog`] if `start` is not less than `end`.
    pub const fn exponential(start: Scalar, end: Scalar) -> Result<Self, LightError> {
        Self::between(start, end)
    }
}

impl Fog<SquaredFog> {
    /// Fog that is thin near `start` and then grows fast (`GL_EXP2`). At the part t of the way from `start` to `end`, 64^(−t²) of
    /// a colour is left. At `end` and beyond, less than 1/64 is left, which is rounded to none.
    ///
    /// OpenGL's density d, with fog from the eye on, is √(ln 64)/d = 2.039/d for `end` and 0 for `start`. For a
    /// [`FogTable`](crate::fog::FogTable) only, like [`exponential`](Fog::exponential) fog.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::{Gray8, GrayColor};
    /// use pinhole::{fog::{Fog, FogTable}, Scalar};
    /// # use pinhole::{prelude::*, Angle};
    /// # use embedded_graphics::geometry::{Point, Size};
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// # let [eye, origin] = [8, 0].map(|z| Point3::from_ints(0, 0, z));
    /// # let view = ViewTransform::look_at(eye, origin, Vector3::from_ints(0, 1, 0))?;
    /// # let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(100))?;
    /// # let camera = Camera::new(&view, &lens, &viewport);
    /// let [start, end] = [0, 16].map(Scalar::from_int);
    /// let depth = camera.project(Point3::from_ints(0, 0, 0))?.depth; // 8 before the camera, half of the way
    /// let factor = |table: FogTable<Gray8>| table.factor(depth);
    /// assert_eq!(factor(FogTable::new(&Fog::squared(start, end)?, &camera, Gray8::WHITE)?), 11); // 32·64^(−1/4) = 11.3
    /// assert_eq!(factor(FogTable::new(&Fog::exponential(start, end)?, &camera, Gray8::WHITE)?), 4); // 32·64^(−1/2)
    /// assert_eq!(factor(FogTable::new(&Fog::linear(start, end)?, &camera, Gray8::WHITE)?), 16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`LightError::EmptyFog`] if `start` is not less than `end`.
    pub const fn squared(start: Scalar, end: Scalar) -> Result<Self, LightError> {
        Self::between(start, end)
    }
}

impl<P> Fog<P> {
    const fn between(start: Scalar, end: Scalar) -> Result<Self, LightError> {
        match start.to_bits() < end.to_bits() {
            true => Ok(Self { start, end, profile: PhantomData }),
            false => Err(LightError::EmptyFog { start, end }),
        }
    }

    /// The distance at which fog begins, in world units.
    pub const fn start(&self) -> Scalar {
        self.start
    }

    /// The distance at which fog is full, in world units.
    pub const fn end(&self) -> Scalar {
        self.end
    }

    /// Both distances in 2⁻¹⁶ world units.
    pub(super) const fn range(&self) -> [i32; 2] {
        [self.start.to_bits(), self.end.to_bits()]
    }
}

defmt_format!([P] Fog<P>, self, "fog from {} to {}", self.start, self.end);
