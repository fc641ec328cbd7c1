//! The factor of fog as a table over the fog's own range of depth.

use super::linear::Fog;
use super::profile;
use crate::camera::Camera;
use crate::raster::Gradient;
use crate::shading::light_error::{LightError, LEAST_FOG_STEPS};

/// The levels of fog besides none.
pub(super) const LEVELS: usize = 32;

/// Fog by depth, in 32 levels, for [`Fogged`](crate::fog::Fogged) faces, points, labels and lines. Levels are equal steps of the
/// factor, 1/32 each, and the table has the depth at which each level begins, so all levels lie within the fog's own range of
/// depth. It takes 136 bytes and a colour, and holds as long as the camera's projection does: the camera may move and turn.
///
/// **Error.** At an exact depth, the factor is the factor at the exact distance, rounded to the nearest 1/32: off by at most
/// 1/64. Depth itself has the error that [`DepthBuffer`](crate::target::DepthBuffer) and [`Projected`](crate::camera::Projected) state; one step
/// of depth is a distance of distance²·(far − near)/(65535·near·far) in perspective, and of (far − near)/65535 in parallel
/// projections.
///
/// ```
/// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
/// use pinhole::{fog::{Fog, FogTable}, prelude::*, Angle};
/// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(8), Angle::ZERO, Angle::ZERO);
/// let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(100))?;
/// let camera = Camera::new(&view, &lens, &viewport); // 8 before the origin
/// let fog = Fog::new(Scalar::from_int(4), Scalar::from_int(20))?;
/// let table = FogTable::new(&fog, &camera, Rgb565::WHITE)?;
/// let depth = camera.project(Point3::from_ints(0, 0, 0))?.depth;
/// assert_eq!(table.factor(depth), 24); // a quarter of the way: 24 of 32 are left
/// assert_eq!(Rgb565::BLACK.mix(Rgb565::WHITE, table.factor(depth)), Rgb565::new(8, 16, 8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FogTable<C> {
    pub(super) color: C,
    /// Level l is seen from depth `bounds[l]` on and before `bounds[l + 1]`: values of [`Gradient::of_depth`], in ascending order,
    /// between 0 and `u32::MAX`, which no depth reaches.
    pub(super) bounds: [u32; LEVELS + 2],
}

impl<C> FogTable<C> {
    /// The table of a fog of this colour before this camera, whose factor is linear in the distance (`GL_LINEAR`).
    ///
    /// # Errors
    ///
    /// [`LightError::SlantedDepth`] if the projection's depth does not depend on the distance alone: only projections from matrices
    /// have such depth. [`LightError::TooFewFogSteps`] if fewer than 8 steps of depth lie between the
    /// start and the end of the fog, or in the part of it between the near and the far plane.
    ///
    /// Fog wholly beyond the far plane is never seen, and fog wholly before the near plane hides everything: neither is an error.
    #[inline(never)] // set-up: code size counts
    pub fn new(fog: &Fog, camera: &Camera, color: C) -> Result<Self, LightError> {
        Self::by_profile(fog, camera, color, profile::linear)
    }

    /// The table of fog of constant density (`GL_EXP`): over each unit of distance from the fog's start on, a colour loses an equal part
    /// of what is left of it. At the part t of the way from start to end, 64^(−t) is left. At the end and beyond, less than 1/64 is left,
    /// which is rounded to none. OpenGL's density d, with fog from the eye on, is ln 64/d = 4.159/d for the end and 0 for the start.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
    /// use pinhole::{fog::{Fog, FogTable}, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(8), Angle::ZERO, Angle::ZERO);
    /// let lens = Projection::perspective(Angle::degrees(60), viewport.size(), Scalar::from_int(1), Scalar::from_int(100))?;
    /// let camera = Camera::new(&view, &lens, &viewport);
    /// let fog = Fog::new(Scalar::ZERO, Scalar::from_int(16))?;
    /// let depth = camera.project(Point3::from_ints(0, 0, 0))?.depth; // 8 before the camera, half of the way
    /// assert_eq!(FogTable::new(&fog, &camera, Gray8::WHITE)?.factor(depth), 16);
    /// assert_eq!(FogTable::exponential(&fog, &camera, Gray8::WHITE)?.factor(depth), 4); // 32·64^(−1/2)
    /// assert_eq!(FogTable::squared(&fog, &camera, Gray8::WHITE)?.factor(depth), 11); // 32·64^(−1/4) = 11.3
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    #[inline(never)] // set-up: code size counts
    pub fn exponential(fog: &Fog, camera: &Camera, color: C) -> Result<Self, LightError> {
        Self::by_profile(fog, camera, color, profile::exponential)
    }

    /// The table of fog that is thin near its start and then grows fast (`GL_EXP2`): at the part t of the way from start to end,
    /// 64^(−t²) of a colour is left. OpenGL's density d, with fog from the eye on, is √(ln 64)/d = 2.039/d for the end and 0 for the
    /// start. [`exponential`](Self::exponential) has an example.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    #[inline(never)] // set-up: code size counts
    pub fn squared(fog: &Fog, camera: &Camera, color: C) -> Result<Self, LightError> {
        Self::by_profile(fog, camera, color, profile::squared)
    }

    /// The table by a profile of this module: a program links the profiles that it uses.
    #[inline(always)]
    fn by_profile(
        fog: &Fog,
        camera: &Camera,
        color: C,
        share: impl Fn(u32) -> u32,
    ) -> Result<Self, LightError> {
        let [start, end] = fog.range().map(i64::from);
        let depth_at = |distance| camera.depth_at(distance).ok_or(LightError::SlantedDepth);
        let (first, last) = (depth_at(start << 16)?, depth_at(end << 16)?);
        let steps = (last.saturating_sub(first) >> 16) as u16;
        // Fog that is full within a step of the near plane, or begins within a step of the far plane, needs no steps between its
        // levels.
        let (near, far) = (1 << 16, 65_534 << 16);
        if steps < LEAST_FOG_STEPS && last > near && first < far {
            return Err(LightError::TooFewFogSteps { steps });
        }
        let mut bounds = [0; LEVELS + 2];
        let mut least = 0;
        for (odd, bound) in (1_u32..).step_by(2).zip(bounds.iter_mut().skip(1).take(LEVELS)) {
            // Half-way between two levels: a share of the range. The range has 33 bits, the product with a share in 2⁻⁴⁶ has 63,
            // shifted to 2⁻³².
            let depth = depth_at((start << 16) + (((end - start) * i64::from(share(odd))) >> 14))?;
            least = depth.saturating_add(Gradient::DEPTH_BIAS).max(least);
            *bound = least;
        }
        let [.., open] = &mut bounds;
        *open = u32::MAX;
        Ok(Self { color, bounds })
    }

    /// The level at a value of [`Gradient::of_depth`]: 0, none, to 32, full.
    #[inline]
    pub(super) fn level(&self, depth: u32) -> u8 {
        let [_, bounds @ .., _] = &self.bounds;
        bounds.partition_point(|&bound| bound <= depth) as u8 // at most 32
    }

    /// The factor at a depth, such as that of a [projected point](crate::camera::Projected): 32, no fog, to 0, nothing but fog.
    pub fn factor(&self, depth: u16) -> u8 {
        LEVELS as u8 - self.level(u32::from(depth) << 16 | Gradient::DEPTH_BIAS)
    }
}

// The colours are not printed: they need not implement `Format`.
defmt_format!([C] FogTable<C>, self, "fog of levels from depths {}/2^16", self.bounds);
